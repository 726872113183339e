#include "benchmarks/truth/picture_error.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "benchmarks/plot/python.h"
#include "benchmarks/run/measure.h"

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

/// Let the differences be d + e and d + f, with noise e and f. The sum of (d + e) (d + f) varies by d (e + f)
/// + e f. Half of (d + e)^2 - (d + f)^2 varies as much and has the mean 0, so its scatter yields the
/// variance.
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
  // The slope of the root, or, if noise hides the square, the root of its uncertainty.
  return {rmse, std::min(ofSquare / std::max(2.0 * rmse, 1e-30), std::sqrt(ofSquare))};
}

bool differ(const MeasuredError& a, const MeasuredError& b) {
  return std::abs(a.rmse - b.rmse) > leastCertainty * std::hypot(a.standardError, b.standardError);
}

namespace {

constexpr const char* flipLibrary = "flip_evaluator";

}  // namespace

bool canMeasureFlip() { return !pythonWith(flipLibrary).empty(); }

std::vector<double> measureFlip(std::span<const DisplayedPair> pairs, int width, int height) {
  const std::string python = pythonWith(flipLibrary);
  if (python.empty()) return {};
  const WorkFolder folder;
  const std::string file = folder / "pictures";
  {
    std::ofstream out(file, std::ios::binary);
    for (const DisplayedPair& pair : pairs)
      for (const std::span<const glm::vec3> picture : {pair.reference, pair.test}) {
        const std::span<const std::byte> bytes = std::as_bytes(picture);
        out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
      }
  }
  std::istringstream printed(
      runScript(python, "flip.py", {file, std::to_string(width), std::to_string(height)}));
  std::vector<double> values;
  for (double value = 0.0; printed >> value;) values.push_back(value);
  return values;
}

}  // namespace prelight::benchmarks
