#pragma once

#include <cmath>
#include <functional>
#include <glm/glm.hpp>

namespace prelight::test {

/// Share of unpolarised light that passes a sheet of thin glass, both faces and all reflections between them,
/// under a cosine with its normal (Fresnel).
inline double paneTransmittance(double cosine, double ior = 1.5) {
  const double sine2 = (1.0 - cosine * cosine) / (ior * ior), beyond = std::sqrt(1.0 - sine2);
  const double s = (cosine - ior * beyond) / (cosine + ior * beyond);
  const double p = (ior * cosine - beyond) / (ior * cosine + beyond);
  const double face = 0.5 * (s * s + p * p);
  return 1.0 - 2.0 * face / (1.0 + face);
}

/// Irradiance at a point that faces up, of a square of radiance 1 about `middle` that faces down, `half` wide
/// either way: by the midpoint rule, with a share of the light for each cosine of its way.
inline double irradianceOfSquare(const glm::dvec3& point, const glm::dvec3& middle, double half,
                                 const std::function<double(double)>& share, int steps = 200) {
  double sum = 0.0;
  const double size = 2.0 * half / steps;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const glm::dvec3 way =
          middle + glm::dvec3((i + 0.5) * size - half, 0.0, (j + 0.5) * size - half) - point;
      const double square = glm::dot(way, way), cosine = way.y / std::sqrt(square);
      if (cosine > 0.0) sum += share(cosine) * cosine * cosine / square * size * size;
    }
  return sum;
}

}  // namespace prelight::test
