#include "benchmarks/lab/ball_shadow.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "basis/sh.h"

namespace prelight::ball_shadow {
namespace {

using std::numbers::pi;

constexpr double radius = 0.4;  ///< m
constexpr double height = 1.0;  ///< m
constexpr int places = 151;
constexpr int rings = 4000;  ///< rings of a light, of equal irradiance

/// The ball as a point sees it.
struct SeenBall {
  glm::dvec3 direction{0.0, 0.0, 1.0};
  double halfAngle = 0.0;
};

SeenBall ballFrom(double distance) {
  const double away = std::hypot(distance, height);
  return {glm::dvec3(distance, 0.0, height) / away, std::asin(radius / away)};
}

/// Returns Y_l0 along the vertical.
double verticalValue(int band) { return std::sqrt((2.0 * band + 1.0) / (4.0 * pi)); }

/// Returns the factor of Y_(l+1)0 in z Y_l0.
double raised(int band) { return (band + 1.0) / std::sqrt((2.0 * band + 1.0) * (2.0 * band + 3.0)); }

/// Returns the coefficients of radiance of a light of irradiance 1.
std::vector<double> lightCoefficients(double lightAngle, int order) {
  std::vector<double> light(static_cast<std::size_t>(order));
  const double sine = std::sin(0.5 * lightAngle);
  if (lightAngle > 0.0) sh::capZonal(0.5 * lightAngle, light);
  for (int l = 0; l < order; ++l)
    light[l] = lightAngle > 0.0 ? light[l] / (pi * sine * sine) : verticalValue(l);
  return light;
}

}  // namespace

std::vector<double> transfer(double distance, int order) {
  const SeenBall ball = ballFrom(distance);
  std::vector<double> cap(static_cast<std::size_t>(order) + 1), turned(cap.size() * cap.size());
  sh::capZonal(ball.halfAngle, cap);
  sh::turnZonal(cap, ball.direction, turned);
  const auto overBall = [&](int l) { return turned[static_cast<std::size_t>(l * (l + 1))]; };
  std::vector<double> result(static_cast<std::size_t>(order));
  for (int l = 0; l < order; ++l) {
    const double blocked = raised(l) * overBall(l + 1) + (l > 0 ? raised(l - 1) * overBall(l - 1) : 0.0);
    result[l] = pi * sh::clampedCosine(l) * verticalValue(l) - blocked;
  }
  return result;
}

double bySh(double distance, double lightAngle, int order) {
  const std::vector<double> light = lightCoefficients(lightAngle, order), open = transfer(distance, order);
  double sum = 0.0;
  for (int l = 0; l < order; ++l) sum += light[l] * open[l];
  return sum;
}

double exact(double distance, double lightAngle) {
  const SeenBall ball = ballFrom(distance);
  const double least = std::cos(ball.halfAngle), slant = std::hypot(ball.direction.x, ball.direction.y);
  const double sine = std::sin(0.5 * lightAngle);
  double sum = 0.0;
  for (int i = 0; i < rings; ++i) {
    const double squared = sine * sine * (i + 0.5) / rings;  // sine of the ring's polar angle
    const double needed = least - std::sqrt(1.0 - squared) * ball.direction.z;
    const double reach = std::sqrt(squared) * slant;
    const double cosine = reach > 1e-12 ? std::clamp(needed / reach, -1.0, 1.0) : (needed > 0.0 ? 1.0 : -1.0);
    sum += 1.0 - std::acos(cosine) / pi;
  }
  return sum / rings;
}

double error(double lightAngle, int order) {
  double sum = 0.0;
  for (int i = 0; i < places; ++i) {
    const double distance = farthest * i / (places - 1);
    const double difference = bySh(distance, lightAngle, order) - exact(distance, lightAngle);
    sum += difference * difference;
  }
  return std::sqrt(sum / places);
}

}  // namespace prelight::ball_shadow
