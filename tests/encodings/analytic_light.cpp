#include "encodings/analytic_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "basis/sh_evaluate.h"

namespace prelight::test {
namespace {

using std::numbers::pi;

glm::dvec3 tilted(double degrees, double azimuth) {
  const double t = degrees * pi / 180.0, a = azimuth * pi / 180.0;
  return {std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t)};
}

/// Radiance of a disk about `axis`: 1 within half of `degrees`, 0 outside.
double cap(const glm::dvec3& d, const glm::dvec3& axis, double degrees) {
  return glm::dot(d, axis) > std::cos(0.5 * degrees * pi / 180.0) ? 1.0 : 0.0;
}

}  // namespace

AnalyticLight constantLight(const glm::dvec3& radiance) {
  return {"constant", [radiance](const glm::dvec3&) { return radiance; }};
}

AnalyticLight lamp(double degrees, double tilt) {
  const double solidAngle = 2.0 * pi * (1.0 - std::cos(0.5 * degrees * pi / 180.0));
  return {"lamp",
          [=](const glm::dvec3& d) { return glm::dvec3(cap(d, tilted(tilt, 40.0), degrees) / solidAngle); }};
}

std::vector<AnalyticLight> surfaceLights() {
  using Vector = glm::dvec3;
  const auto above = [](auto radiance) {
    return [radiance](const Vector& d) { return d.z > 0.0 ? Vector(radiance(d)) : Vector(0.0); };
  };
  return {
      {"even sky", above([](const Vector&) { return Vector(0.3, 0.5, 1.0); })},
      {"half a sky", above([](const Vector& d) { return Vector(d.x > 0.2 ? 1.0 : 0.0); })},
      {"bright wall",
       above([](const Vector& d) { return d.z < 0.4 && d.x > 0.5 ? Vector(2, 1, 0.5) : Vector(0.1); })},
      {"three walls", above([](const Vector& d) {
         const double angle = std::atan2(d.y, d.x);
         return angle < -1.0  ? Vector(1, 0.2, 0.2)
                : angle < 1.0 ? Vector(0.2, 0.6, 0.2)
                              : Vector(0.1, 0.1, 0.3);
       })},
      {"lamp overhead in a dim room", above([](const Vector& d) {
         return Vector(0.2) + 20.0 * Vector(1.0, 0.9, 0.7) * cap(d, tilted(10, 200), 20);
       })},
      {"lamp aslant",
       above([](const Vector& d) { return 20.0 * Vector(1.0, 0.9, 0.7) * cap(d, tilted(60, 70), 20); })},
      {"sun and sky", above([](const Vector& d) {
         return Vector(0.2, 0.3, 0.6) + 100.0 * Vector(1.0, 0.9, 0.8) * cap(d, tilted(30, -50), 10);
       })},
      {"two lamps of two colours", above([](const Vector& d) {
         return 30.0 * Vector(1, 0.1, 0.1) * cap(d, tilted(45, 20), 15) +
                30.0 * Vector(0.1, 0.2, 1) * cap(d, tilted(45, 170), 15);
       })},
      {"gradient",
       above([](const Vector& d) { return Vector(1.0 + d.x, 1.0 + 0.5 * d.y, 1.0 + d.z * d.z); })},
      {"bright horizon", above([](const Vector& d) { return Vector(d.z < 0.2 ? 1.0 : 0.05); })},
      {"window", above([](const Vector& d) {
         return std::abs(d.y) < 0.3 && d.x > 0.4 && d.z > 0.3 ? Vector(3, 3.5, 4) : Vector(0.2, 0.18, 0.15);
       })},
  };
}

LightSum::LightSum(const AnalyticLight& light, const glm::dmat3& frame) {
  constexpr int rows = 240, columns = 360;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double z = 1.0 - 2.0 * (row + 0.5) / rows, radius = std::sqrt(1.0 - z * z);
      const double phi = 2.0 * pi * (column + 0.5) / columns;
      const glm::dvec3 d(radius * std::cos(phi), radius * std::sin(phi), z);
      const glm::dvec3 power = light.radiance(d) * (4.0 * pi / (rows * columns));
      if (power != glm::dvec3(0.0)) samples_.push_back({frame * d, power});
    }
}

std::vector<float> LightSum::incident() const {
  std::vector<double> sums(3 * incidentTerms), harmonics(incidentTerms);
  for (const Sample& sample : samples_) {
    sh::evaluate(sample.direction, incidentOrder, harmonics);
    for (int channel = 0; channel < 3; ++channel)
      for (std::size_t i = 0; i < incidentTerms; ++i)
        sums[static_cast<std::size_t>(channel) * incidentTerms + i] += harmonics[i] * sample.power[channel];
  }
  return {sums.begin(), sums.end()};
}

glm::dvec3 LightSum::irradiance(const glm::dvec3& normal) const {
  glm::dvec3 sum(0.0);
  for (const Sample& sample : samples_)
    sum += std::max(glm::dot(sample.direction, normal), 0.0) * sample.power;
  return sum;
}

glm::dvec3 irradianceOfBands(const std::vector<float>& incident, const glm::dvec3& normal) {
  constexpr std::array<double, 5> factors = {pi, 2.0 * pi / 3.0, pi / 4.0, 0.0, -pi / 24.0};
  std::array<double, incidentTerms> harmonics;
  sh::evaluate(normal, incidentOrder, harmonics);
  glm::dvec3 sum(0.0);
  for (int l = 0; l < 5; ++l)
    for (int i = l * l; i < (l + 1) * (l + 1); ++i)
      for (int channel = 0; channel < 3; ++channel)
        sum[channel] +=
            factors[static_cast<std::size_t>(l)] * harmonics[static_cast<std::size_t>(i)] *
            double(incident[static_cast<std::size_t>(channel) * incidentTerms + static_cast<std::size_t>(i)]);
  return sum;
}

glm::dmat3 obliqueFrame() {
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.5, -0.3, 0.7));
  const glm::dvec3 tangent = glm::normalize(glm::cross(normal, glm::dvec3(0.2, 0.9, 0.4)));
  return {tangent, glm::cross(normal, tangent), normal};
}

std::vector<glm::dvec3> normalsWithin(double degrees, const glm::dmat3& frame, int count) {
  const double lowest = std::cos(degrees * pi / 180.0), golden = pi * (3.0 - std::sqrt(5.0));
  std::vector<glm::dvec3> normals;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (1.0 - lowest) * (i + 0.5) / count, radius = std::sqrt(1.0 - z * z);
    normals.push_back(frame * glm::dvec3(radius * std::cos(golden * i), radius * std::sin(golden * i), z));
  }
  return normals;
}

}  // namespace prelight::test
