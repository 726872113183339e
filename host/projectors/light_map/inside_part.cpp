#include "projectors/light_map/inside_part.h"

#include <algorithm>

#include "receivers/sampling.h"
#include "receivers/texel_receiver.h"

namespace prelight {

namespace {

constexpr std::uint32_t raysPerTexel = 16;

CastOptions insideCastOptions() {
  CastOptions options;
  options.raysPerReceiver = raysPerTexel;
  options.marksInside = true;
  return options;
}

}  // namespace

InsidePart::InsidePart(const CompiledScene& scene, Tracer& tracer, std::uint64_t seed)
    : scene_(scene),
      caster_(scene, tracer, insideCastOptions()),
      seed_(sampling::hashInteger(static_cast<std::uint32_t>(seed) ^
                                  sampling::hashInteger(static_cast<std::uint32_t>(seed >> 32) + 0x1d5e7u))) {
}

void InsidePart::add(std::span<const LightMapTexel> texels, int, std::span<float>,
                     std::span<std::uint8_t> hidden) {
  for (std::size_t first = 0; first < texels.size(); first += caster_.blockSize()) {
    const auto block =
        texels.subspan(first, std::min<std::size_t>(caster_.blockSize(), texels.size() - first));
    receivers_.clear();
    for (const LightMapTexel& texel : block) {
      receivers_.push_back(receiverAt(scene_, texel));
      receivers_.back().seed = seed_ ^ sampling::hashInteger(texel.texel);
    }
    caster_.cast(receivers_, cast_, {});
    rays_ += block.size() * raysPerTexel;
    for (std::size_t i = 0; i < block.size(); ++i)
      if (cast_.inside[i] != 0) hidden[first + i] = 1;
  }
}

}  // namespace prelight
