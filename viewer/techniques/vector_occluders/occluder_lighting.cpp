#include "viewer/techniques/vector_occluders/occluder_lighting.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include "occluders/occluder_record.h"
#include "occluders/wave_table.h"
#include "techniques/vector_occluders/occluder_relighter.h"
#include "techniques/vector_occluders/vector_occluders.h"
#include "viewer/programs/drawn_shading.h"
#include "viewer/techniques/vector_occluders/vertex_gloss.h"

namespace prelight::viewer {
namespace {

bool anyOf(const std::vector<glm::vec4>& gloss) {
  return std::any_of(gloss.begin(), gloss.end(), [](const glm::vec4& g) {
    return std::max({g.x, g.y, g.z}) > 0.0f;
  });
}

/// An attribute within the lit vertices.
void attachPart(Attribute attribute, GLint components, std::size_t offset) {
  glEnableVertexAttribArray(static_cast<GLuint>(attribute));
  glVertexAttribPointer(static_cast<GLuint>(attribute), components, GL_FLOAT, GL_FALSE,
                        sizeof(device::LitVertex), reinterpret_cast<const void*>(offset));
}

}  // namespace

std::vector<float> occluderAccessibility(const OccluderTransfer& transfer) {
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

OccluderLighting::OccluderLighting(const RenderInputs& inputs)
    : inputs_(inputs),
      gloss_{vertexGloss(inputs, false), vertexGloss(inputs, true)},
      anyGloss_{anyOf(gloss_[0]), anyOf(gloss_[1])},
      stored_(inputs.bake->occluders->stored),
      transfer_(&*inputs.bake->occluders),
      origin_(inputs.compiled.origin),
      pass_(*transfer_, origin_, receivers()),
      accessibility_(Attribute::Accessibility,
                     std::span<const float>(occluderAccessibility(*inputs.bake->occluders))) {}

std::vector<device::OccluderReceiverPoint> OccluderLighting::receivers() const {
  const CompiledScene& scene = inputs_.compiled;
  return OccluderReceivers{scene.positions, scene.normals, scene.origin, gloss_[allHighlights_ ? 1 : 0]}
      .points();
}

bool OccluderLighting::verticesMoved() {
  receiversMoved_ = true;
  return true;
}

bool OccluderLighting::materialsChanged() {
  gloss_ = {vertexGloss(inputs_, false), vertexGloss(inputs_, true)};
  anyGloss_ = {anyOf(gloss_[0]), anyOf(gloss_[1])};
  receiversMoved_ = true;
  return true;
}

bool OccluderLighting::takeBake(const Bake& bake) {
  if (!bake.occluders || bake.occluders->stored != stored_) return false;
  transfer_ = &*bake.occluders;
  recordsChanged_ = true;
  return true;
}

/// Uploads what has changed since pictures were last lit.
void OccluderLighting::followScene(bool allHighlights) {
  if (recordsChanged_ || origin_ != inputs_.compiled.origin) {
    origin_ = inputs_.compiled.origin;
    pass_.setTransfer(*transfer_, origin_);
    accessibility_.fill(std::span<const float>(occluderAccessibility(*transfer_)));
  }
  if (receiversMoved_ || allHighlights_ != allHighlights) {
    allHighlights_ = allHighlights;
    pass_.setReceivers(receivers());
  }
  recordsChanged_ = receiversMoved_ = false;
}

std::vector<device::OccluderLight> OccluderLighting::allLights(const Illumination& light) {
  std::vector<device::OccluderLight> lights;
  for (const ShadedLight& source : light.lights) lights.push_back(occluderLight(source));
  if (light.skyMap == nullptr) return lights;
  if (cutSky_ != light.skyMap || cutCount_ != light.occluders.skyLights) {
    skyLights_ = medianCut(*light.skyMap, light.occluders.skyLights);
    cutSky_ = light.skyMap;
    cutCount_ = light.occluders.skyLights;
  }
  const glm::dmat3 turn = skyTurn(light.skyRotation);
  for (const SkyLight& part : skyLights_) {
    lights.push_back(occluderFarLight(turn * part.direction, part.irradiance));
    lights.back().highlight = 0.0f;  // surface.frag mirrors the map itself
  }
  return lights;
}

OccluderShading OccluderLighting::shadingOf(const OccluderOptions& options) const {
  OccluderShading shading = options.shading;
  const double radius =
      0.5 * glm::length(glm::dvec3(inputs_.compiled.boundsMax) - glm::dvec3(inputs_.compiled.boundsMin));
  const double length = options.waveLength > 0.0 ? options.waveLength : 0.5 * radius;
  shading.effects.length = std::max(length, 1e-6);
  shading.effects.moment = effectMoment(options.seconds);
  return shading;
}

bool OccluderLighting::dependsOnEye(const Illumination& light) const {
  return anyGloss_[light.occluders.allHighlights ? 1 : 0] ||
         light.occluders.shading.receiver == DiffuseReceiver::OrenNayar;
}

void OccluderLighting::light(const Illumination& light) {
  followScene(light.occluders.allHighlights);
  pass_.light(allLights(light), shadingOf(light.occluders), light.eye);
}

void OccluderLighting::bind(const gl::Program&) const {
  accessibility_.attach();
  glBindBuffer(GL_ARRAY_BUFFER, pass_.lit().name());
  attachPart(Attribute::Radiance, 3, offsetof(device::LitVertex, diffuse));
  attachPart(Attribute::Highlight, 1, offsetof(device::LitVertex, highlight));
  attachPart(Attribute::Reflected, 3, offsetof(device::LitVertex, reflected));
}

void OccluderLighting::describe(const Illumination& light, Warnings& notes) const {
  if (std::any_of(light.lights.begin(), light.lights.end(), [](const ShadedLight& source) {
        return source.profile != nullptr || source.cookie != nullptr;
      }))
    notes.push_back(
        "vector occluders treat lights with profiles (EXT_lights_ies) as even ones of the same power, and "
        "cookies as their mean");
  if (light.skyMap != nullptr)
    notes.push_back("vector occluders represent the sky by " + std::to_string(light.occluders.skyLights) +
                    " lights (--sky-lights)");
}

extern const DrawnShading drawnVo = {
    .info = &occluderShading,
    .make = [](const TechniqueInputs& of) -> std::unique_ptr<DrawnTransfer> {
      return std::make_unique<OccluderLighting>(of.inputs);
    },
    .vary =
        [](const View& view, Lobe, ShaderVariant& variant) {
          if (view.occluders.allHighlights) variant.rules.reflection = Reflection::Everywhere;
        },
};

}  // namespace prelight::viewer
