#include "viewer/lights/lamp_tables.h"

#include <cmath>
#include <utility>

#include "scene/light_profile.h"
#include "scene/light_shape.h"

namespace prelight::viewer {
namespace {

/// The inputs of a lamp's table.
Light tabledPart(const Light& light) {
  Light part;
  part.profile = light.profile;
  part.shape = light.shape;
  part.cookie = light.cookie;
  part.innerConeAngle = light.innerConeAngle;
  part.outerConeAngle = light.outerConeAngle;
  if (light.shape == nullptr && light.cookie == nullptr) return part;
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

std::size_t addCookie(const Light& light, const ShadedLight& shaded, std::vector<glm::vec4>& texels) {
  const Picture& cookie = *light.cookie;
  const std::size_t entry = texels.size();
  texels.emplace_back(static_cast<float>(cookie.width), static_cast<float>(cookie.height), shaded.coneScale,
                      shaded.coneOffset);
  texels.emplace_back(glm::vec3(light.side),
                      static_cast<float>(1.0 / std::tan(double(light.outerConeAngle))));
  for (const glm::vec3& texel : cookie.pixels) texels.emplace_back(texel, 0.0f);
  return entry;
}

}  // namespace

void LampTables::set(std::span<const Light> lights, std::span<ShadedLight> shaded) {
  std::vector<Light> parts;
  for (const Light& light : lights) parts.push_back(tabledPart(light));
  if (parts != lights_) fill(std::move(parts), shaded);
  for (std::size_t i = 0; i < shaded.size(); ++i) shaded[i].entry = entries_[i];
}

void LampTables::fill(std::vector<Light> parts, std::span<const ShadedLight> shaded) {
  lights_ = std::move(parts);
  entries_.assign(lights_.size(), 0);
  PackedProfiles profiles;
  for (std::size_t i = 0; i < lights_.size(); ++i)
    if (lights_[i].profile != nullptr) entries_[i] = profiles.add(lights_[i]);
  texels_ = profiles.texels();
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    if (lights_[i].shape != nullptr) entries_[i] = addShape(lights_[i], texels_);
    if (lights_[i].cookie != nullptr) entries_[i] = addCookie(lights_[i], shaded[i], texels_);
  }
  ++version_;
}

}  // namespace prelight::viewer
