#include "images/sky_sun.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "base/colour.h"

namespace prelight {
namespace {

// Angle from the brightest texel within which texels may belong to the sun, rad.
constexpr double reach = 2.5 * std::numbers::pi / 180.0;
constexpr double ringReach = 1.6 * reach;                       // rad, outer radius of the surroundings
constexpr double largestRadius = 1.5 * std::numbers::pi / 180;  // rad, largest disk that counts as a sun
constexpr double leastShare = 0.1;                              // least share of the sky's light

/// A texel near the sun.
struct Near {
  std::size_t index = 0;
  glm::dvec3 direction{0.0};
  double solidAngle = 0.0;
  double angle = 0.0;  ///< angle from the brightest texel, rad
};

double solidAngleOf(const Environment& sky, int row) {
  return 2.0 * std::numbers::pi / sky.width *
         (std::cos(std::numbers::pi * row / sky.height) -
          std::cos(std::numbers::pi * (row + 1) / sky.height));
}

glm::dvec3 directionOf(const Environment& sky, int row, int column) {
  return Environment::direction((column + 0.5) / sky.width, (row + 0.5) / sky.height);
}

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

struct Survey {
  int row = 0, column = 0;  ///< brightest texel
  double flux = 0.0;        ///< luminance times solid angle, over the sky
};

Survey surveyOf(const Environment& sky) {
  Survey survey;
  double brightest = -1.0;
  for (int row = 0; row < sky.height; ++row) {
    double sum = 0.0;
    for (int column = 0; column < sky.width; ++column) {
      const double shine = luminance(sky.radiance[static_cast<std::size_t>(row) * sky.width + column]);
      sum += shine;
      if (shine <= brightest) continue;
      brightest = shine;
      survey.row = row;
      survey.column = column;
    }
    survey.flux += sum * solidAngleOf(sky, row);
  }
  return survey;
}

std::vector<Near> texelsNear(const Environment& sky, const Survey& survey) {
  const glm::dvec3 middle = directionOf(sky, survey.row, survey.column);
  const auto rows = static_cast<int>(std::ceil(ringReach / std::numbers::pi * sky.height));
  std::vector<Near> near;
  for (int row = std::max(survey.row - rows, 0); row <= std::min(survey.row + rows, sky.height - 1); ++row)
    for (int column = 0; column < sky.width; ++column) {
      Near texel{static_cast<std::size_t>(row) * sky.width + column, directionOf(sky, row, column),
                 solidAngleOf(sky, row)};
      texel.angle = angleBetween(texel.direction, middle);
      if (texel.angle <= ringReach) near.push_back(texel);
    }
  return near;
}

/// Returns the mean radiance around the sun, or nothing for maps too coarse to resolve it.
std::optional<glm::vec3> surroundings(const Environment& sky, std::span<const Near> near) {
  glm::dvec3 sum(0.0);
  double whole = 0.0;
  for (const Near& texel : near) {
    if (texel.angle <= reach) continue;
    sum += texel.solidAngle * glm::dvec3(sky.radiance[texel.index]);
    whole += texel.solidAngle;
  }
  if (!(whole > 0.0)) return std::nullopt;
  return glm::vec3(sum / whole);
}

}  // namespace

std::optional<SunAndSky> takeSunOut(const Environment& sky) {
  const Survey survey = surveyOf(sky);
  const std::vector<Near> near = texelsNear(sky, survey);
  const std::optional<glm::vec3> around = surroundings(sky, near);
  if (!around) return std::nullopt;
  const glm::vec3 level = *around;
  SkySun sun;
  glm::dvec3 way(0.0);
  double flux = 0.0;
  for (const Near& texel : near) {
    if (texel.angle > reach) continue;
    const glm::vec3& radiance = sky.radiance[texel.index];
    const glm::dvec3 above = texel.solidAngle * glm::dvec3(radiance - glm::min(radiance, level));
    sun.irradiance += above;
    way += luminance(above) * texel.direction;
    flux += luminance(above);
  }
  if (!(flux > leastShare * survey.flux)) return std::nullopt;
  sun.direction = glm::normalize(way);
  double spread = 0.0;
  for (const Near& texel : near) {
    if (texel.angle > reach) continue;
    const glm::vec3& radiance = sky.radiance[texel.index];
    const double above = texel.solidAngle * luminance(glm::dvec3(radiance - glm::min(radiance, level)));
    spread += above / flux * std::pow(angleBetween(texel.direction, sun.direction), 2);
  }
  sun.radius = std::sqrt(2.0 * spread);  // the mean squared distance in a uniform disk is radius^2 / 2
  if (sun.radius > largestRadius) return std::nullopt;
  SunAndSky parts{sun, sky};
  for (const Near& texel : near)
    if (texel.angle <= reach) parts.rest.radiance[texel.index] = glm::min(sky.radiance[texel.index], level);
  return parts;
}

}  // namespace prelight
