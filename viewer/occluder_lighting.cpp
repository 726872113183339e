#include "viewer/occluder_lighting.h"

#include <algorithm>
#include <string>

#include "base/parallel.h"
#include "occluders/occluder_light.h"
#include "occluders/occluder_places.h"

namespace prelight::viewer {
namespace {

/// [vertex], what occluders leave of an even sky.
std::vector<float> accessibilityOf(const OccluderTransfer& transfer) {
  std::vector<float> result;
  const std::size_t place = placeOf(transfer, OccluderVector::Occlusion);
  for (std::size_t v = 0; v + 1 < transfer.offsets.size(); ++v) {
    float open = 1.0f;
    for (std::uint32_t r = transfer.offsets[v]; r < transfer.offsets[v + 1]; ++r)
      open -= transfer.vectors[r * transfer.stored.size() + place].w;
    result.push_back(std::clamp(open, 0.0f, 1.0f));
  }
  return result;
}

}  // namespace

OccluderLighting::OccluderLighting(const OccluderTransfer& transfer, const CompiledScene& scene)
    : transfer_(transfer),
      scene_(scene),
      accessibility_(Attribute::Accessibility, std::span<const float>(accessibilityOf(transfer))),
      radiance_(Attribute::Radiance, std::span<const glm::vec3>()) {}

std::vector<ShadedLight> OccluderLighting::allLights(const Illumination& light) {
  std::vector<ShadedLight> lights = light.lights;
  if (light.skyMap == nullptr) return lights;
  if (cutSky_ != light.skyMap || cutCount_ != light.occluders.skyLights) {
    skyLights_ = medianCut(*light.skyMap, light.occluders.skyLights);
    cutSky_ = light.skyMap;
    cutCount_ = light.occluders.skyLights;
  }
  const glm::dmat3 turn = skyTurn(light.skyRotation);
  for (const SkyLight& part : skyLights_) {
    ShadedLight far;
    far.kind = LightKind::Directional;
    far.direction = glm::vec3(-(turn * part.direction));
    far.intensity = glm::vec3(part.irradiance);
    lights.push_back(far);
  }
  return lights;
}

void OccluderLighting::light(const Illumination& light) {
  const std::vector<ShadedLight> lights = allLights(light);
  std::vector<LightAt> sources;
  for (const ShadedLight& source : lights)
    sources.push_back(
        [&source, this](const glm::dvec3& point) { return incidentFrom(source, point - scene_.origin); });
  std::vector<glm::vec3> radiance(scene_.vertexCount());
  parallelRanges(radiance.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const OccluderReceiver receiver{static_cast<std::uint32_t>(v),
                                      scene_.origin + glm::dvec3(scene_.positions[v]),
                                      glm::dvec3(scene_.normals[v])};
      radiance[v] = glm::vec3(lightThroughOccluders(transfer_, receiver, sources, light.occluders.shading));
    }
  });
  radiance_.fill(std::span<const glm::vec3>(radiance));
}

void OccluderLighting::bind(const gl::Program& program) const {
  program.set("transferForm", static_cast<int>(TransferForm::Radiance));
  accessibility_.attach();
  radiance_.attach();
}

void OccluderLighting::describe(const Illumination& light, Warnings& notes) const {
  if (light.skyMap != nullptr)
    notes.push_back("vector occluders take the sky for " + std::to_string(light.occluders.skyLights) +
                    " lights (--sky-lights)");
}

}  // namespace prelight::viewer
