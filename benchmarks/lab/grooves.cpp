#include "benchmarks/lab/grooves.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace prelight::grooves {

namespace {

using std::numbers::pi;
constexpr int skyRows = 60, skySteps = 120;
constexpr double step = 0.25, farthest = 400.0;  // of the march

bool isOpen(double x, const glm::dvec3& w) {
  const double from = heightAt(x);
  for (double d = step; d * w.y < 2.0 * amplitude && d < farthest; d += step)
    if (heightAt(x + d * w.x) > from + d * w.y) return false;
  return true;
}

}  // namespace

double heightAt(double x) { return amplitude * std::cos(2.0 * pi * x / period); }

double slopeAt(double x) { return -amplitude * 2.0 * pi / period * std::sin(2.0 * pi * x / period); }

Image normals() {
  Image image{"", texels, texels, {}};
  for (int row = 0; row < texels; ++row)
    for (int x = 0; x < texels; ++x) {
      const glm::dvec3 n = glm::normalize(glm::dvec3(-slopeAt(x), 0.0, 1.0));
      for (int a = 0; a < 3; ++a)
        image.rgba.push_back(static_cast<std::uint8_t>(std::lround(127.5 * (n[a] + 1.0))));
      image.rgba.push_back(255);
    }
  return image;
}

double openAt(double x) {
  const glm::dvec3 n = glm::normalize(glm::dvec3(-slopeAt(x), 1.0, 0.0));
  double sum = 0.0;
  for (int r = 0; r < skyRows; ++r)
    for (int s = 0; s < skySteps; ++s) {
      const double y = (r + 0.5) / skyRows, turn = 2.0 * pi * (s + 0.5) / skySteps;
      const double radius = std::sqrt(1.0 - y * y);
      const glm::dvec3 w(radius * std::cos(turn), y, radius * std::sin(turn));
      if (isOpen(x, w)) sum += std::max(glm::dot(n, w), 0.0);
    }
  return sum * 2.0 / (skyRows * skySteps);
}

}  // namespace prelight::grooves
