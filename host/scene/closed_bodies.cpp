#include "scene/closed_bodies.h"

#include <algorithm>
#include <cmath>

#include "scene/light_sources.h"

namespace prelight {
namespace {

/// Least ratio of volume to area^(3/2), which is 0.094 for a ball. The sides of flatter bodies are not
/// decided.
constexpr double leastVolume = 0.004;

bool contain(const ClosedPart& bounds, const glm::dvec3& p) {
  return glm::all(glm::greaterThan(p, bounds.lower)) && glm::all(glm::lessThan(p, bounds.upper));
}

glm::dvec3 centreOf(const ClosedPart& part) { return 0.5 * (part.lower + part.upper); }

bool glowsOnBothSides(const CompiledScene& scene, const PrimitiveRange& range) {
  for (std::uint32_t t = 0; t < range.triangleCount; ++t) {
    const CompiledMaterial& material = scene.materials[scene.triangleMaterials[range.firstTriangle + t]];
    if (!material.doubleSided || !shines(material.emission)) return false;
  }
  return range.triangleCount > 0;
}

}  // namespace

BodySide sideOfBodies(const CompiledScene& scene, const PrimitiveRange& range) {
  const auto parts = closedParts(scene, range);
  if (!parts || parts->empty() || parts->size() > mostClosedBodies) return BodySide::Unclear;
  const double sign = parts->front().volume < 0.0 ? -1.0 : 1.0;
  for (const ClosedPart& part : *parts) {
    if (!(sign * part.volume > leastVolume * std::pow(part.area, 1.5))) return BodySide::Unclear;
    for (const ClosedPart& other : *parts)
      if (&other != &part && contain(part, centreOf(other))) return BodySide::Unclear;
  }
  return sign < 0.0 ? BodySide::Inside : BodySide::Outside;
}

ClosedPart asClosed(const CompiledScene& scene, const PrimitiveRange& range) {
  ClosedPart whole;
  for (std::uint32_t v = 0; v < range.vertexCount; ++v) {
    const glm::dvec3 p(scene.positions[range.firstVertex + v]);
    whole.lower = glm::min(whole.lower, p);
    whole.upper = glm::max(whole.upper, p);
  }
  for (std::uint32_t t = 0; t < range.triangleCount; ++t) {
    const glm::dvec3 face = 0.5 * geometricNormal(scene, range.firstTriangle + t);
    const glm::dvec3 corner(scene.positions[scene.triangles[range.firstTriangle + t].x]);
    whole.area += glm::length(face);
    whole.volume += glm::dot(corner - centreOf(whole), face) / 3.0;
  }
  return whole;
}

BodyCentres::BodyCentres(std::span<const ClosedPart> bodies) {
  for (std::uint32_t i = 0; i < bodies.size(); ++i) centres_.emplace_back(centreOf(bodies[i]), i);
  std::sort(centres_.begin(), centres_.end(),
            [](const auto& a, const auto& b) { return a.first.x < b.first.x; });
}

bool BodyCentres::anyWithin(const ClosedPart& bounds, std::uint32_t butNot) const {
  auto centre = std::upper_bound(centres_.begin(), centres_.end(), bounds.lower.x,
                                 [](double x, const auto& other) { return x < other.first.x; });
  for (; centre != centres_.end() && centre->first.x < bounds.upper.x; ++centre)
    if (centre->second != butNot && contain(bounds, centre->first)) return true;
  return false;
}

std::vector<BodySide> glowingBodies(const CompiledScene& scene) {
  std::vector<BodySide> sides(scene.primitives.size(), BodySide::Unclear);
  std::vector<std::uint32_t> glowing;
  for (std::uint32_t i = 0; i < scene.primitives.size(); ++i)
    if (glowsOnBothSides(scene, scene.primitives[i])) glowing.push_back(i);
  if (glowing.empty() || glowing.size() > mostClosedBodies) return sides;
  std::vector<ClosedPart> wholes;
  for (const PrimitiveRange& range : scene.primitives) wholes.push_back(asClosed(scene, range));
  const BodyCentres centres(wholes);
  for (const std::uint32_t i : glowing)
    if (!centres.anyWithin(wholes[i], i)) sides[i] = sideOfBodies(scene, scene.primitives[i]);
  return sides;
}

}  // namespace prelight
