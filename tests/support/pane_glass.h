#pragma once

#include <cmath>
#include <functional>
#include <glm/glm.hpp>

namespace prelight::test {

/// Share of unpolarised light that passes a sheet of thin glass at the given cosine (Fresnel), including all
/// reflections between its faces.
inline double paneTransmittance(double cosine, double ior = 1.5) {
  const double sine2 = (1.0 - cosine * cosine) / (ior * ior), beyond = std::sqrt(1.0 - sine2);
  const double s = (cosine - ior * beyond) / (cosine + ior * beyond);
  const double p = (ior * cosine - beyond) / (ior * cosine + beyond);
  const double face = 0.5 * (s * s + p * p);
  return 1.0 - 2.0 * face / (1.0 + face);
}

/// Irradiance at a point that faces up, from a square of radiance 1 around `middle` that faces down and
/// extends `half` either way. It uses the midpoint rule; `share` is the transmitted share of light per
/// cosine.
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
