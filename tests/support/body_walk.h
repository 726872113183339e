#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>
#include <random>

namespace prelight::test {

/// Share of light that enters a ball of radius 1 evenly from all sides and comes out again, by random walks
/// in double. Walks start at a point of the surface, scatter by the Henyey-Greenstein phase function with
/// mean cosine g, and are absorbed at random. The standard error is at most 0.5 over the square root of
/// `walks`.
inline double shareThroughBall(double extinction, double scattering, double g, std::uint32_t walks) {
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> uniform;
  std::uint32_t out = 0;
  for (std::uint32_t k = 0; k < walks; ++k) {
    glm::dvec3 place(0.0, 0.0, -1.0);
    const double cosine = std::sqrt(uniform(engine)), turn = 2.0 * std::numbers::pi * uniform(engine);
    const double sine = std::sqrt(1.0 - cosine * cosine);
    glm::dvec3 way(sine * std::cos(turn), sine * std::sin(turn), cosine);
    for (;;) {
      place += way * (-std::log(1.0 - uniform(engine)) / extinction);
      if (glm::dot(place, place) >= 1.0) {
        ++out;
        break;
      }
      if (uniform(engine) >= scattering) break;
      double mu = 1.0 - 2.0 * uniform(engine);
      if (g != 0.0) {
        const double root = (1.0 - g * g) / (1.0 + g * mu);
        mu = (1.0 + g * g - root * root) / (2.0 * g);
      }
      const glm::dvec3 helper = std::abs(way.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
      const glm::dvec3 x = glm::normalize(glm::cross(helper, way)), y = glm::cross(way, x);
      const double around = 2.0 * std::numbers::pi * uniform(engine),
                   s = std::sqrt(std::max(0.0, 1.0 - mu * mu));
      way = glm::normalize(s * std::cos(around) * x + s * std::sin(around) * y + mu * way);
    }
  }
  return double(out) / walks;
}

}  // namespace prelight::test
