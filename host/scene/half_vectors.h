#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <vector>

#include "prelight/measured_brdf.h"

namespace prelight {

/// A half vector and the solid angle around it that it represents.
struct HalfVector {
  glm::dvec3 direction;
  double weight;
};

/// Returns half vectors over the hemisphere of +Z, two per angle of MeasuredBrdf's cells: dense where the
/// cells are narrow, as lobes may be there.
inline std::vector<HalfVector> halfVectors() {
  using std::numbers::pi;
  constexpr int steps = 2 * MeasuredBrdf::halves, azimuths = 64;
  std::vector<HalfVector> samples;
  for (int i = 0; i < steps; ++i) {
    const double root = (i + 0.5) / steps, theta = 0.5 * pi * root * root;
    const double weight = pi * root / steps * std::sin(theta) * 2.0 * pi / azimuths;
    for (int k = 0; k < azimuths; ++k) {
      const double turn = 2.0 * pi * (k + 0.5) / azimuths;
      samples.push_back(
          {{std::sin(theta) * std::cos(turn), std::sin(theta) * std::sin(turn), std::cos(theta)}, weight});
    }
  }
  return samples;
}

/// Returns a direction of this cosine with +Z, and y = 0.
inline glm::dvec3 directionOfCosine(double cosine) { return {std::sqrt(1.0 - cosine * cosine), 0.0, cosine}; }

/// Calls use(wi, half vector, solid angle of wi) for directions above the surface that reflect to wo.
template <typename Use>
void forReflected(const std::vector<HalfVector>& samples, const glm::dvec3& wo, const Use& use) {
  for (const HalfVector& h : samples) {
    const double along = glm::dot(wo, h.direction);
    const glm::dvec3 wi = 2.0 * along * h.direction - wo;
    if (along > 0.0 && wi.z > 0.0) use(wi, h.direction, h.weight * 4.0 * along);
  }
}

}  // namespace prelight
