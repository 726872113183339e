#include "cast/point_light_caster.h"

#include <algorithm>

#include "cast/caster.h"

namespace prelight {

namespace {

constexpr std::uint32_t leastRays = 8;  // that a receiver counts as when blocks are sized

}  // namespace

PointLightCaster::PointLightCaster(const CompiledScene& scene, const GroupedLights& lights, Tracer& tracer,
                                   int incidentOrder)
    : tracer_(tracer),
      vertexCount_(scene.vertexCount()),
      blockSize_(receiversPerBlock(tracer.context().info(),
                                   std::max(leastRays, static_cast<std::uint32_t>(lights.rays.size())))),
      lights_(scene, lights, nullptr, tracer, blockSize_, incidentOrder),
      parameters_(tracer.context(), 1),
      receivers_(tracer.context(), blockSize_) {}

void PointLightCaster::cast(std::span<const device::Receiver> receivers, std::vector<float>& values) {
  values.clear();
  for (std::size_t first = 0; first < receivers.size(); first += blockSize_) {
    const auto block = receivers.subspan(first, std::min<std::size_t>(blockSize_, receivers.size() - first));
    const auto count = static_cast<std::uint32_t>(block.size());
    const device::CastParameters parameters{count, leastRays, 0, vertexCount_, 0, 0.0f, 0.0f, 0.0f};
    parameters_.write(std::span(&parameters, 1));
    receivers_.write(block);
    lights_.cast({parameters_, receivers_, noRays_, noHits_}, count, tracer_, 0, block_);
    values.insert(values.end(), block_.begin(), block_.end());
    rays_ += std::uint64_t{count} * lights_.raysPerReceiver();
  }
}

}  // namespace prelight
