#include "benchmarks/lab/tabulated_brdf.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "prelight/error.h"
#include "scene/measured_brdf.h"

namespace prelight {

namespace {

using std::numbers::pi;

/// Value in the middle of a cell; below the surface nothing is measured.
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
