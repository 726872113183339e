#include "support/ggx_albedo.h"

#include <cmath>
#include <numbers>

namespace prelight::test {

glm::dvec2 reflectedOnce(double cosine, double roughness, int steps) {
  const double a = roughness * roughness, a2 = a * a;
  const glm::dvec3 wo(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
  const auto lambda = [&](double c) { return 0.5 * (std::sqrt(1.0 + a2 * (1.0 / (c * c) - 1.0)) - 1.0); };
  glm::dvec2 sum(0.0);
  for (int i = 0; i < steps; ++i) {
    // tan(theta) = a sqrt(x / (1 - x)) makes D constant in x.
    const double x = (i + 0.5) / steps;
    const double tangent2 = a2 * x / (1.0 - x), c = 1.0 / std::sqrt(1.0 + tangent2),
                 s = std::sqrt(1.0 - c * c);
    for (int j = 0; j < steps; ++j) {
      const double phi = std::numbers::pi * (j + 0.5) / steps;  // The other half mirrors this one.
      const glm::dvec3 h(s * std::cos(phi), s * std::sin(phi), c);
      const double oh = glm::dot(wo, h);
      const double ci = 2.0 * oh * h.z - wo.z;
      if (oh <= 0.0 || ci <= 0.0) continue;
      // D cos(h) dh = dx dphi / (2 pi), and dwi = 4 (wo.h) dh.
      const double leaves = oh / (c * cosine) / (1.0 + lambda(cosine) + lambda(ci)),
                   rise = std::pow(1.0 - oh, 5.0);
      sum += leaves * glm::dvec2(1.0 - rise, rise);
    }
  }
  return sum / (static_cast<double>(steps) * steps);
}

double meanReflectedOnce(double roughness) {
  constexpr int cosines = 64;
  double sum = 0.0;
  for (int i = 0; i < cosines; ++i) {
    const double cosine = (i + 0.5) / cosines;
    const glm::dvec2 once = reflectedOnce(cosine, roughness, 200);
    sum += 2.0 * cosine / cosines * (once.x + once.y);
  }
  return sum;
}

glm::dvec3 reflectedAtLast(const glm::dvec3& f0, double f90, double cosine, double roughness) {
  const double leaves = meanReflectedOnce(roughness);
  const glm::dvec3 mean = f0 + (glm::dvec3(f90) - f0) / 21.0;
  const glm::dvec3 later = mean * mean * leaves / (glm::dvec3(1.0) - mean * (1.0 - leaves));
  const glm::dvec2 once = reflectedOnce(cosine, roughness);
  return f0 * once.x + f90 * once.y + later * (1.0 - once.x - once.y);
}

}  // namespace prelight::test
