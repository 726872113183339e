#include "charts/spread_caster.h"

#include <algorithm>
#include <utility>

#include "receivers/sampling.h"

namespace prelight {

namespace {

constexpr std::uint32_t leastReceiverRays = 16, mostReceiverRays = 256;  // per receiver

CastOptions spread(CastOptions options, std::uint32_t rays) {
  options.raysPerReceiver =
      std::clamp(rays / SpreadCaster::receiversOf(rays), leastReceiverRays, mostReceiverRays);
  options.marksInside = true;
  return options;
}

}  // namespace

std::uint32_t SpreadCaster::receiversOf(std::uint32_t rays) {
  const std::uint32_t spread = std::min<std::uint32_t>(TexelCells::placeCount, rays / leastReceiverRays);
  return std::max({1u, spread, rays / mostReceiverRays});
}

SpreadCaster::SpreadCaster(const CompiledScene& scene, Tracer& tracer, CastOptions options,
                           std::vector<Column*> columns, std::uint32_t rays, std::uint64_t seed)
    : scene_(scene),
      perTexel_(receiversOf(rays)),
      caster_(scene, tracer, spread(options, rays), std::move(columns)),
      seed_(sampling::hashInteger(static_cast<std::uint32_t>(seed) ^
                                  sampling::hashInteger(static_cast<std::uint32_t>(seed >> 32) + 0x11647u))) {
}

void SpreadCaster::castBlock(std::span<const LightMapTexel> texels, const TexelCells* cells,
                             std::uint32_t set) {
  spreadReceivers(scene_, texels, cells, perTexel_, receivers_);
  for (std::size_t r = 0; r < receivers_.size(); ++r) {
    receivers_[r].seed = seed_ ^ sampling::hashInteger(texels[r / perTexel_].texel);
    receivers_[r].firstSample = static_cast<std::uint32_t>(r % perTexel_) * caster_.raysPerReceiver();
  }
  caster_.cast(receivers_, rows_, {Side::Front, set});
  cast_ += receivers_.size();
}

void SpreadCaster::cast(std::span<const LightMapTexel> texels, const TexelCells* cells, std::uint32_t set,
                        std::span<std::uint8_t> hidden, const Visit& visit) {
  const std::size_t perBlock = std::max<std::size_t>(1, caster_.blockSize() / perTexel_);
  for (std::size_t first = 0; first < texels.size(); first += perBlock) {
    const auto block = texels.subspan(first, std::min(perBlock, texels.size() - first));
    castBlock(block, cells, set);
    for (std::size_t t = 0; t < block.size(); ++t) {
      const std::uint8_t* inside = &rows_.inside[t * perTexel_];
      const auto outside = static_cast<std::uint32_t>(std::count(inside, inside + perTexel_, 0));
      if (outside == 0) hidden[first + t] = 1;
      // Receivers at one place are either all inside or all outside.
      const bool apart = cells != nullptr && block[t].whole && outside > 0;
      const float share = 1.0f / static_cast<float>(apart ? outside : perTexel_);
      for (std::size_t r = 0; r < perTexel_; ++r)
        if (!apart || inside[r] == 0) visit(first + t, t * perTexel_ + r, share, rows_);
    }
  }
}

}  // namespace prelight
