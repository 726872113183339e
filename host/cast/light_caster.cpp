#include "cast/light_caster.h"

#include <algorithm>

#include "base/span_of.h"
#include "basis/incident_values.h"
#include "device/packed_arrays.h"
#include "receivers/surface_sampler.h"

namespace prelight {

namespace {

using namespace device;

std::span<const float> floatsOf(const std::vector<glm::vec3>& vectors) {
  return {&vectors[0].x, 3 * vectors.size()};
}

/// Fronts as the file means them: emission leaves there.
std::vector<float> frontNormals(const CompiledScene& scene) {
  std::vector<float> normals;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const glm::vec3 n(glm::normalize(geometricNormal(scene, t)));
    normals.insert(normals.end(), {n.x, n.y, n.z});
  }
  return normals;
}

/// Emitters that a set leaves out are black for its receivers.
std::vector<GroupEmitter> emittersOf(const GroupedLights& lights, const ShadowSets::Occluders& set) {
  std::vector<GroupEmitter> emitters = lights.emitters;
  for (GroupEmitter& emitter : emitters)
    if (!std::binary_search(set.triangles.begin(), set.triangles.end(), emitter.triangle))
      for (float& factor : emitter.factor) factor = 0.0f;
  return emitters;
}

}  // namespace

LightCaster::LightCaster(const CompiledScene& scene, const GroupedLights& lights, const ShadowSets* sets,
                         const Tracer& tracer, std::uint32_t blockSize, int incidentOrder)
    : device_(tracer.context()),
      valueCount_(static_cast<std::uint32_t>(incidentOrder > 0 ? incidentValueCount(incidentOrder) : 1)),
      hasEmitters_(!lights.emitters.empty()) {
  PackedArrays<LightGroupLine> pack;
  layout_.groupCount = static_cast<std::uint32_t>(lights.groups.size());
  layout_.rayCount = static_cast<std::uint32_t>(lights.rays.size());
  layout_.rays = pack.add(spanOf(lights.rays));
  layout_.punctual = pack.add(spanOf(lights.punctual));
  layout_.factors = pack.add(spanOf(lights.factors));
  layout_.emitterOfTriangle = pack.add(spanOf(lights.emitterOfTriangle));
  layout_.samplesOfGroup = pack.add(spanOf(lights.samplesOfGroup));
  layout_.positions = pack.add(floatsOf(scene.positions));
  layout_.normals = pack.add(frontNormals(scene));
  lines_ = pack.upload(device_);
  const std::size_t rays = std::size_t{blockSize} * layout_.rayCount;
  rays_ = Buffer<Ray>(device_, rays);
  hits_ = Buffer<Hit>(device_, rays);
  rayValues_ = Buffer<float>(device_, 3 * rays);
  values_ = Buffer<float>(device_, std::size_t{blockSize} * layout_.groupCount * 3 * valueCount_);
  emitters_.emplace_back(device_, spanOf(lights.emitters));
  if (sets != nullptr)
    for (const auto& set : sets->sets) emitters_.emplace_back(device_, spanOf(emittersOf(lights, set)));
  auto options = tracer.surfaceOptions()
                     .defineIf(hasEmitters_, "PRELIGHT_EMITTERS")
                     .defineIf(incidentOrder > 0, "PRELIGHT_INCIDENT");
  addIncidentOrder(options, incidentOrder);
  generate_ = {device_, "cast/light_kernels.cl", options, "generateLightRays"};
  project_ = {device_, "cast/light_kernels.cl", options, "projectLights"};
}

void LightCaster::cast(const CastBlockBuffers& block, std::uint32_t receivers, Tracer& tracer,
                       std::uint32_t set, std::vector<float>& values) {
  const std::size_t rayCount = std::size_t{receivers} * layout_.rayCount;
  generate_.launch(rayCount, block.parameters, layout_, lines_, emitters_[set], tracer.scene().layoutBuffer(),
                   tracer.scene().surface(), block.receivers, rays_, rayValues_);
  tracer.traceAny(rays_, hits_, rayCount);
  project_.launch(receivers, block.parameters, layout_, lines_, emitters_[set], block.receivers, rays_, hits_,
                  rayValues_, block.rays, block.hits, values_);
  values.resize(std::size_t{receivers} * layout_.groupCount * 3 * valueCount_);
  values_.read(std::span(values));
}

}  // namespace prelight
