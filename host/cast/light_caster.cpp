#include "cast/light_caster.h"

#include <algorithm>

#include "base/span_of.h"
#include "receivers/surface_sampler.h"

namespace prelight {

namespace {

using namespace device;

constexpr std::size_t groupSize = 64;

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
                         DeviceContext& device, std::uint32_t blockSize, bool incident)
    : device_(device),
      groupCount_(static_cast<std::uint32_t>(lights.groups.size())),
      slotCount_(static_cast<std::uint32_t>(lights.slots.size())),
      valueCount_(incident ? 5 : 1),
      hasEmitters_(!lights.emitters.empty()),
      slots_(device_, spanOf(lights.slots)),
      lights_(device_, spanOf(lights.punctual)),
      factors_(device_, spanOf(lights.factors)),
      emitterOfTriangle_(device_, spanOf(lights.emitterOfTriangle)),
      samplesOfGroup_(device_, spanOf(lights.samplesOfGroup)),
      positions_(device_, floatsOf(scene.positions)),
      geometricNormals_(device_, spanOf(frontNormals(scene))),
      rays_(device_, std::size_t{blockSize} * slotCount_),
      hits_(device_, std::size_t{blockSize} * slotCount_),
      rayValues_(device_, std::size_t{blockSize} * slotCount_ * 3),
      values_(device_, std::size_t{blockSize} * groupCount_ * 3 * valueCount_) {
  emitters_.emplace_back(device_, spanOf(lights.emitters));
  if (sets != nullptr)
    for (const auto& set : sets->sets) emitters_.emplace_back(device_, spanOf(emittersOf(lights, set)));
  const auto& program = device_.program(
      "cast/light_kernels.cl",
      BuildOptions().defineIf(hasEmitters_, "PRELIGHT_EMITTERS").defineIf(incident, "PRELIGHT_INCIDENT"));
  generate_ = cl::Kernel(program, "generateLightRays");
  project_ = cl::Kernel(program, "projectLights");
}

void LightCaster::cast(const CastBlockBuffers& block, std::uint32_t receivers, Tracer& tracer,
                       std::uint32_t set, std::vector<float>& values) {
  const std::size_t rayCount = std::size_t{receivers} * slotCount_;
  setArguments(generate_, block.parameters.get(), slotCount_, block.receivers.get(), slots_.get(),
               lights_.get(), factors_.get(), emitters_[set].get(), tracer.surfaceTriangles().get(),
               positions_.get(), geometricNormals_.get(), rays_.get(), rayValues_.get());
  device_.launch(generate_, rayCount, groupSize);
  tracer.traceAny(rays_, hits_, rayCount);
  setArguments(project_, block.parameters.get(), slotCount_, groupCount_, block.receivers.get(), slots_.get(),
               rays_.get(), hits_.get(), rayValues_.get(), block.rays.get(), block.hits.get(),
               emitterOfTriangle_.get(), emitters_[set].get(), samplesOfGroup_.get(), geometricNormals_.get(),
               values_.get());
  device_.launch(project_, receivers, groupSize);
  values.resize(std::size_t{receivers} * groupCount_ * 3 * valueCount_);
  values_.read(std::span(values));
}

}  // namespace prelight
