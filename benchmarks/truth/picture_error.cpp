#include "benchmarks/truth/picture_error.h"

#include <algorithm>
#include <cmath>

namespace prelight::benchmarks {

namespace {

constexpr double leastCertainty = 2.0;  // standard errors

glm::dvec3 bounded(const glm::vec3& radiance) { return glm::min(glm::dvec3(radiance), glm::dvec3(1.0)); }

}  // namespace

double pictureRmse(const Picture& first, const Picture& second) {
  double sum = 0.0;
  for (std::size_t i = 0; i < first.pixels.size(); ++i) {
    const glm::dvec3 difference = bounded(first.pixels[i]) - bounded(second.pixels[i]);
    sum += glm::dot(difference, difference);
  }
  return std::sqrt(sum / (3.0 * static_cast<double>(first.pixels.size())));
}

/// With differences d + e and d + f, of noise e and f, the sum of (d + e) (d + f) varies by d (e + f) + e f,
/// as half of (d + e)^2 - (d + f)^2 does, whose mean is 0: so its scatter tells the variance.
MeasuredError errorBetween(const Picture& picture, const Picture& first, const Picture& second) {
  double sum = 0.0, scatter = 0.0;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const glm::dvec3 shown = bounded(picture.pixels[i]);
    const glm::dvec3 a = shown - bounded(first.pixels[i]), b = shown - bounded(second.pixels[i]);
    const double half = 0.5 * (glm::dot(a, a) - glm::dot(b, b));
    sum += glm::dot(a, b);
    scatter += half * half;
  }
  const double count = 3.0 * static_cast<double>(picture.pixels.size());
  const double square = std::max(sum, 0.0) / count, ofSquare = std::sqrt(scatter) / count;
  const double rmse = std::sqrt(square);
  // The root's slope, or where the square is lost in noise, the root of what it could be.
  return {rmse, std::min(ofSquare / std::max(2.0 * rmse, 1e-30), std::sqrt(ofSquare))};
}

bool differ(const MeasuredError& a, const MeasuredError& b) {
  return std::abs(a.rmse - b.rmse) > leastCertainty * std::hypot(a.standardError, b.standardError);
}

}  // namespace prelight::benchmarks
