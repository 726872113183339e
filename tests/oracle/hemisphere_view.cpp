#include "oracle/hemisphere_view.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "basis/sh_evaluate.h"
#include "oracle/brute_force.h"

namespace prelight::reference {

namespace {

/// Returns two axes that are perpendicular to a normal and to each other.
std::pair<glm::dvec3, glm::dvec3> axesAcross(const glm::dvec3& normal) {
  const glm::dvec3 other = std::abs(normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 across = glm::normalize(glm::cross(normal, other));
  return {across, glm::cross(normal, across)};
}

}  // namespace

HemisphereView viewOf(const CompiledScene& scene, const HemispherePlace& place, int order, int side) {
  const glm::dvec3 normal = glm::normalize(glm::dvec3(place.normal));
  const auto [across, along] = axesAcross(normal);
  const auto count = static_cast<std::size_t>(order * order);
  double open = 0.0;
  glm::dvec3 ofOpen(0.0), ofAll(0.0);
  std::vector<double> harmonics(count, 0.0), allHarmonics(count, 0.0), values(count);
  const double each = 1.0 / (double(side) * side);
  for (int i = 0; i < side; ++i)
    for (int k = 0; k < side; ++k) {
      const double radius = std::sqrt((i + 0.5) / side), azimuth = 2.0 * std::numbers::pi * (k + 0.5) / side;
      const glm::dvec3 w = radius * (std::cos(azimuth) * across + std::sin(azimuth) * along) +
                           std::sqrt(1.0 - radius * radius) * normal;
      const bool leaves = glm::dot(w, glm::dvec3(place.geometricNormal)) > 0.0;
      const bool isOpen = leaves && !closestHit(scene, place.position, w, 1e30, place.triangle);
      open += isOpen ? each : 0.0;
      ofAll += each * w;
      ofOpen += isOpen ? each * w : glm::dvec3(0.0);
      if (order > 0) sh::evaluate(w, order, values);
      for (std::size_t c = 0; c < count; ++c) {
        allHarmonics[c] += each * values[c];
        harmonics[c] += isOpen ? each * values[c] : 0.0;
      }
    }
  HemisphereView view{static_cast<float>(open), glm::vec3(ofOpen - open * ofAll)};
  for (std::size_t c = 0; c < count; ++c)
    view.harmonics.push_back(static_cast<float>(harmonics[c] - open * allHarmonics[c]));
  return view;
}

}  // namespace prelight::reference
