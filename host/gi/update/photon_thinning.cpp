#include "gi/update/photon_thinning.h"

#include <algorithm>
#include <cmath>

namespace prelight {

namespace {

constexpr std::size_t mostBoxes = 64;
constexpr float widening = 1e-5f;  // relative to the largest coordinate; more than a hit's rounding

void widen(Box& box) {
  const glm::vec3 size = glm::max(glm::abs(box.lower), glm::abs(box.upper));
  const glm::vec3 by(widening * std::max({size.x, size.y, size.z}));
  box.lower -= by;
  box.upper += by;
}

}  // namespace

std::vector<Box> boxesAround(const CompiledScene& scene, std::span<const std::uint32_t> triangles) {
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const bool goesOn = i > 0 && triangles[i] == triangles[i - 1] + 1;
    if (!goesOn && boxes.size() < mostBoxes) boxes.emplace_back();
    for (int k = 0; k < 3; ++k) boxes.back().grow(scene.positions[scene.triangles[triangles[i]][k]]);
  }
  for (Box& box : boxes) widen(box);
  return boxes;
}

bool mayMeet(const device::Ray& ray, const Box& box) {
  float near = 0.0f, far = ray.tMax;
  for (int k = 0; k < 3; ++k) {
    const float inverse = 1.0f / ray.direction[k];
    float a = (box.lower[k] - ray.origin[k]) * inverse, b = (box.upper[k] - ray.origin[k]) * inverse;
    if (std::isnan(a) || std::isnan(b)) continue;  // in the plane of a side
    if (a > b) std::swap(a, b);
    near = std::max(near, a * (1.0f - 1e-6f));
    far = std::min(far, b * (1.0f + 1e-6f));
  }
  return near <= far;
}

namespace {

constexpr double octaveMargin = 0.25;

double distanceTo(const Box& box, const glm::dvec3& point) {
  const glm::dvec3 nearest = glm::clamp(point, glm::dvec3(box.lower), glm::dvec3(box.upper));
  return glm::length(point - nearest);
}

}  // namespace

std::optional<Box> placeOfSource(const device::PhotonSource& source, const LightTables& lights,
                                 const CompiledScene& scene) {
  Box place;
  if (source.kind == PRELIGHT_SOURCE_PUNCTUAL) {
    const device::PunctualLight& light = lights.punctual[source.light];
    if (light.kind == PRELIGHT_DIRECTIONAL_LIGHT) return std::nullopt;
    place.grow(glm::vec3(light.position[0], light.position[1], light.position[2]));
    return place;
  }
  if (source.kind != PRELIGHT_SOURCE_EMITTERS) return std::nullopt;
  for (std::size_t e = 0; e < lights.emitters.size(); ++e)
    if (source.light == PRELIGHT_ALL_EMITTERS || e - source.light < source.emitters)
      for (int corner = 0; corner < 3; ++corner)
        place.grow(scene.positions[scene.triangles[lights.emitters[e]][corner]]);
  return place;
}

std::uint32_t thinningOctaves(const PhotonThinning& thinning, const std::optional<Box>& place,
                              std::uint32_t before) {
  if (!(thinning.beyond > 0.0) || !thinning.eye || !place) return 0;
  const double distance = distanceTo(*place, *thinning.eye);
  const double octaves = 2.0 * std::log2(std::max(distance / thinning.beyond, 1.0));
  const double away = octaves - static_cast<double>(before);
  if (away >= -octaveMargin && away <= 1.0 + octaveMargin) return before;
  return static_cast<std::uint32_t>(std::min<double>(octaves, PhotonThinning::mostOctaves));
}

std::uint32_t thinnable(std::uint32_t photons) {
  constexpr std::uint32_t whole = 1u << PhotonThinning::mostOctaves;
  return (photons + whole - 1) / whole * whole;
}

}  // namespace prelight
