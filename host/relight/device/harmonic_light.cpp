#include "relight/device/harmonic_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "basis/lights/sh_lights.h"
#include "basis/sh_evaluate.h"
#include "basis/sh_projection.h"
#include "basis/sh_rotation.h"
#include "prelight/error.h"

namespace prelight {

namespace {

bool isFinite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void checkDistantLight(const DistantLight& light, std::size_t index) {
  const std::string where = fmt::format("RelighterLight::lights {}", index);
  if (!isFinite(light.towards) || !(glm::length(light.towards) > 0.0))
    throw UsageError(where, fmt::format("got the direction ({}, {}, {}), expected finite numbers, not all 0",
                                        light.towards.x, light.towards.y, light.towards.z));
  if (!isFinite(light.irradiance) || glm::any(glm::lessThan(light.irradiance, glm::dvec3(0.0))))
    throw UsageError(where,
                     fmt::format("got an irradiance of ({}, {}, {}) W/m2, expected finite numbers >= 0",
                                 light.irradiance.x, light.irradiance.y, light.irradiance.z));
  if (!(light.halfAngle >= 0.0 && light.halfAngle < std::numbers::pi / 2.0))
    throw UsageError(
        where, fmt::format("got a half angle of {} radians, expected 0 to below pi / 2", light.halfAngle));
}

/// Returns the order of three channels of coefficients.
int orderOf(std::span<const double> coefficients) {
  const auto order = static_cast<int>(std::lround(std::sqrt(double(coefficients.size()) / 3.0)));
  if (coefficients.size() % 3 != 0 || static_cast<std::size_t>(3 * order * order) != coefficients.size())
    throw UsageError("RelighterLight::coefficients",
                     fmt::format("got {}, expected 3 x order^2", coefficients.size()));
  return order;
}

/// Adds the coefficients of a light to three channels.
void addLight(const DistantLight& light, const glm::dmat3& rotation, int order, std::vector<double>& sum) {
  const glm::dvec3 towards = glm::normalize(rotation * light.towards);
  std::vector<double> values(sum.size() / 3);
  glm::dvec3 strength = light.irradiance;
  if (hasSize(light)) {
    sh::capLight(towards, light.halfAngle, order, values);
    strength = radianceOf(light);
  } else {
    sh::directionalLight(towards, order, values);
  }
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < values.size(); ++i)
      sum[c * values.size() + i] += strength[static_cast<int>(c)] * values[i];
}

/// Adds the turned coefficients' bands that the sum has. A turn does not mix bands.
void addCoefficients(std::span<const double> coefficients, const glm::dmat3& rotation, int order,
                     std::vector<double>& sum) {
  const int shared = std::min(orderOf(coefficients), order);
  const auto count = static_cast<std::size_t>(sh::coefficientCount(shared));
  for (std::size_t c = 0; c < 3; ++c) {
    const std::span<const double> channel = coefficients.subspan(c * (coefficients.size() / 3), count);
    std::vector<double> turned(channel.begin(), channel.end());
    sh::turn(turned, shared, rotation);
    for (std::size_t i = 0; i < count; ++i) sum[c * (sum.size() / 3) + i] += turned[i];
  }
}

}  // namespace

void checkRelighterLight(const RelighterLight& light) {
  sh::checkRotation(light.rotation);
  for (std::size_t i = 0; i < light.lights.size(); ++i) checkDistantLight(light.lights[i], i);
  if (!light.coefficients.empty())
    sh::checkCoefficients(light.coefficients, light.coefficients.size(), "RelighterLight::coefficients");
  for (const glm::vec3& color : light.groups)
    if (!isFinite(glm::dvec3(color)))
      throw UsageError("RelighterLight::groups", "got a colour that is not finite");
}

bool hasSize(const DistantLight& light) { return light.halfAngle >= 1e-6; }

glm::dvec3 radianceOf(const DistantLight& light) {
  const double sine = std::sin(light.halfAngle);
  return light.irradiance / (std::numbers::pi * sine * sine);
}

std::vector<float> HarmonicLight::skyOf(const Environment& sky, const glm::dmat3& rotation) {
  if (!projector_ || width_ != sky.width || height_ != sky.height) {
    sh::checkEnvironment(sky);
    projector_.emplace(device_, sky.width, sky.height, order_);
    width_ = sky.width;
    height_ = sky.height;
  }
  projector_->setSky(sky);
  projector_->setRotation(rotation);
  return projector_->projectSh();
}

std::vector<double> HarmonicLight::coefficientsOf(const RelighterLight& light) {
  std::vector<double> sum(3 * static_cast<std::size_t>(order_ * order_), 0.0);
  if (light.sky != nullptr) {
    const std::vector<float> sky = skyOf(*light.sky, light.rotation);
    std::copy(sky.begin(), sky.end(), sum.begin());
  }
  for (const DistantLight& one : light.lights) addLight(one, light.rotation, order_, sum);
  if (!light.coefficients.empty()) addCoefficients(light.coefficients, light.rotation, order_, sum);
  return sum;
}

}  // namespace prelight
