#include "benchmarks/lab/made_materials.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "prelight/error.h"
#include "scene/measured_brdf.h"

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

namespace prelight {

namespace {

using std::numbers::pi;

/// Returns the value in the middle of a cell; 0 for directions below the surface.
glm::vec3 valueOf(const BrdfModel& model, int half, int difference, int turn) {
  const double root = (half + 0.5) / MeasuredBrdf::halves, theta = 0.5 * pi * root * root;
  const double apart = 0.5 * pi * (difference + 0.5) / MeasuredBrdf::differences,
               azimuth = pi * (turn + 0.5) / MeasuredBrdf::turns;
  const glm::dvec3 h(std::sin(theta), 0.0, std::cos(theta));
  const glm::dvec3 across(std::cos(theta), 0.0, -std::sin(theta)), beside(0.0, 1.0, 0.0);
  const glm::dvec3 wi =
      std::cos(apart) * h + std::sin(apart) * (std::cos(azimuth) * across + std::sin(azimuth) * beside);
  const glm::dvec3 wo = 2.0 * std::cos(apart) * h - wi;
  return wi.z > 0.0 && wo.z > 0.0 ? glm::vec3(model(wo, wi)) : glm::vec3(-1.0f);
}

}  // namespace

MeasuredBrdf tabulatedBrdf(const BrdfModel& model, const std::string& name) {
  std::vector<glm::vec3> values;
  values.reserve(MeasuredBrdf::cells);
  for (int i = 0; i < MeasuredBrdf::halves; ++i)
    for (int j = 0; j < MeasuredBrdf::differences; ++j)
      for (int k = 0; k < MeasuredBrdf::turns; ++k) values.push_back(valueOf(model, i, j, k));
  Warnings warnings;
  return makeMeasuredBrdf(std::move(values), name, warnings);
}

BrdfModel ggxModel(const glm::dvec3& f0, double roughness) {
  return [=](const glm::dvec3& wo, const glm::dvec3& wi) {
    const glm::dvec3 h = glm::normalize(wo + wi);
    const double a2 = std::pow(roughness, 4.0), q = h.x * h.x + h.y * h.y + a2 * h.z * h.z;
    const auto smith = [&](double c) { return std::sqrt(a2 + (1.0 - a2) * c * c); };
    return f0 * (a2 / (pi * q * q) * 0.5 / (wo.z * smith(wi.z) + wi.z * smith(wo.z)));
  };
}

}  // namespace prelight
