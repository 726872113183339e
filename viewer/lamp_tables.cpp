#include "viewer/lamp_tables.h"

#include "scene/light_profile.h"
#include "scene/light_shape.h"

namespace prelight::viewer {
namespace {

/// What tables are made of.
Light tabledPart(const Light& light) {
  Light part;
  part.profile = light.profile;
  part.shape = light.shape;
  if (light.shape == nullptr) return part;
  part.direction = light.direction;
  part.side = light.side;
  return part;
}

std::size_t addShape(const Light& light, std::vector<glm::vec4>& texels) {
  const LightShape& shape = *light.shape;
  const std::size_t entry = texels.size();
  texels.emplace_back(static_cast<float>(shape.kind), static_cast<float>(shape.corners.size()),
                      static_cast<float>(shape.radius), shape.twoSided ? 1.0f : 0.0f);
  for (const glm::dvec3& corner : cornersOf(light))
    texels.emplace_back(glm::vec3(corner - light.position), 0.0f);
  return entry;
}

}  // namespace

void LampTables::set(std::span<const Light> lights) {
  std::vector<Light> parts;
  for (const Light& light : lights) parts.push_back(tabledPart(light));
  if (parts == lights_) return;
  lights_ = std::move(parts);
  entries_.assign(lights_.size(), 0);
  PackedProfiles profiles;
  for (std::size_t i = 0; i < lights_.size(); ++i)
    if (lights_[i].profile != nullptr) entries_[i] = profiles.add(lights_[i]);
  texels_ = profiles.texels();
  for (std::size_t i = 0; i < lights_.size(); ++i)
    if (lights_[i].shape != nullptr) entries_[i] = addShape(lights_[i], texels_);
  ++version_;
}

void LampTables::enter(std::span<ShadedLight> lights) const {
  for (std::size_t i = 0; i < lights.size(); ++i) lights[i].entry = entries_[i];
}

}  // namespace prelight::viewer
