#include "images/sky_lamps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "base/colour.h"
#include "images/averaged_sky.h"

namespace prelight {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
// A lamp reaches so far around its middle, rad.
constexpr std::array reaches = {2.5 * degree, 5.0 * degree, 10.0 * degree};
// Its surroundings reach so many times as far.
constexpr double ofRing = 1.6;
// A larger reach is a lamp's where the lamp has at least so many times the light in it.
constexpr double leastGrowth = 1.15;
// A disk as spread out as a lamp has this angular radius at most, rad.
constexpr double largestRadius = 9.0 * degree;
// A lamp has at least this share of the sky's light.
constexpr double leastShare = 1.0 / 30.0;
// A lamp is looked for around texels that are so many times as bright as the sky's mean.
constexpr double leastBrightness = 5.0;
constexpr std::size_t mostLamps = 6;
// Skies are searched with so many texels side by side at most.
constexpr int mostWidth = 1024;
// So many places are tried, of lamps and of none.
constexpr int mostTries = 48;
// The middle is found anew so many times, as the brightest texel may lie at the rim of a lamp.
constexpr int centerings = 2;

/// A texel near the middle of a bright place that may be a lamp.
struct Near {
  std::size_t index = 0;
  glm::dvec3 direction{0.0};
  double solidAngle = 0.0;
  double cosine = 0.0;  ///< of the angle from the middle
};

/// A bright place that may be a lamp.
struct Found {
  SkyLamp lamp;
  double cosine = 1.0;     ///< of its reach
  glm::vec3 around{0.0f};  ///< mean radiance of its surroundings
  double flux = 0.0;       ///< luminance times solid angle
};

double solidAngleOf(const Environment& sky, int row) {
  return 2.0 * std::numbers::pi / sky.width *
         (std::cos(std::numbers::pi * row / sky.height) -
          std::cos(std::numbers::pi * (row + 1) / sky.height));
}

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Returns luminance times solid angle over the sky.
double fluxOf(const Environment& sky, std::span<const float> shine) {
  double flux = 0.0;
  for (int row = 0; row < sky.height; ++row) {
    double sum = 0.0;
    for (int column = 0; column < sky.width; ++column)
      sum += shine[static_cast<std::size_t>(row) * sky.width + column];
    flux += sum * solidAngleOf(sky, row);
  }
  return flux;
}

/// Returns the smallest reach that a map resolves, two rows.
double leastReach(const Environment& sky) { return 2.0 * std::numbers::pi / sky.height; }

glm::dvec3 directionOf(const Environment& sky, std::size_t texel) {
  const auto width = static_cast<std::size_t>(sky.width);
  const auto column = static_cast<double>(texel % width), row = static_cast<double>(texel / width);
  return Environment::direction((column + 0.5) / sky.width, (row + 0.5) / sky.height);
}

/// Returns how many columns of a row on either side of a direction's own may lie within an angle of a cosine;
/// less than 0: none.
int columnsBeside(const Environment& sky, int row, const glm::dvec3& middle, double least) {
  const double polar = std::numbers::pi * (row + 0.5) / sky.height;
  const double height = std::cos(polar) * middle.y, flat = std::sin(polar) * std::hypot(middle.x, middle.z);
  if (height + flat < least) return -1;
  if (height - flat >= least) return sky.width;
  return static_cast<int>(std::acos((least - height) / flat) / (2.0 * std::numbers::pi) * sky.width) + 2;
}

/// Returns the texels within the ring of the largest reach around a direction.
std::vector<Near> texelsNear(const Environment& sky, const glm::dvec3& middle) {
  const double reach = ofRing * reaches.back(), least = std::cos(reach);
  const auto column = static_cast<int>(Environment::coordinates(middle).x * sky.width);
  std::vector<Near> near;
  for (int y = 0; y < sky.height; ++y) {
    const int beside = columnsBeside(sky, y, middle, least);
    const bool isWhole = 2 * beside + 1 >= sky.width;
    const int first = isWhole ? 0 : column - beside, last = isWhole ? sky.width - 1 : column + beside;
    for (int x = first; x <= last; ++x) {
      const std::size_t texel = static_cast<std::size_t>(y) * sky.width + (x + sky.width) % sky.width;
      const glm::dvec3 direction = directionOf(sky, texel);
      const double cosine = glm::dot(direction, middle);
      if (cosine >= least) near.push_back({texel, direction, solidAngleOf(sky, y), cosine});
    }
  }
  return near;
}

/// Returns the mean radiance of a ring, or nothing for maps too coarse to resolve it.
std::optional<glm::vec3> surroundings(const Environment& sky, std::span<const Near> near, double reach) {
  const double inner = std::cos(reach), outer = std::cos(ofRing * reach);
  glm::dvec3 sum(0.0);
  double whole = 0.0;
  for (const Near& texel : near) {
    if (texel.cosine >= inner || texel.cosine < outer) continue;
    sum += texel.solidAngle * glm::dvec3(sky.radiance[texel.index]);
    whole += texel.solidAngle;
  }
  if (!(whole > 0.0)) return std::nullopt;
  return glm::vec3(sum / whole);
}

/// Returns what shines within a reach more than the surroundings.
std::optional<Found> foundWithin(const Environment& sky, std::span<const Near> near, double reach) {
  const std::optional<glm::vec3> around = surroundings(sky, near, reach);
  if (!around) return std::nullopt;
  Found found;
  found.cosine = std::cos(reach);
  found.around = *around;
  const auto above = [&](const Near& texel) {
    const glm::vec3& radiance = sky.radiance[texel.index];
    return texel.solidAngle * glm::dvec3(radiance - glm::min(radiance, found.around));
  };
  glm::dvec3 way(0.0);
  for (const Near& texel : near) {
    if (texel.cosine < found.cosine) continue;
    const double flux = luminance(above(texel));
    way += flux * texel.direction;
    found.flux += flux;
  }
  if (!(found.flux > 0.0)) return std::nullopt;
  SkyLamp& lamp = found.lamp;
  lamp.direction = glm::normalize(way);
  double spread = 0.0;
  for (const Near& texel : near) {
    if (texel.cosine < found.cosine) continue;
    lamp.irradiance += above(texel) * glm::dot(texel.direction, lamp.direction);
    spread +=
        luminance(above(texel)) / found.flux * std::pow(angleBetween(texel.direction, lamp.direction), 2);
  }
  lamp.radius = std::sqrt(2.0 * spread);  // the mean squared distance in a uniform disk is radius^2 / 2
  return found;
}

/// Returns what shines around the middle of `near`, in the smallest reach that has nearly all of its light.
std::optional<Found> foundAt(const Environment& sky, std::span<const Near> near) {
  std::optional<Found> best;
  for (const double reach : reaches) {
    if (reach < leastReach(sky)) continue;
    const std::optional<Found> found = foundWithin(sky, near, reach);
    if (found && (!best || found->flux > leastGrowth * best->flux)) best = found;
  }
  return best;
}

/// Sets what shines within a reach to nothing.
void hide(std::span<float> shine, std::span<const Near> near, double cosineOfReach) {
  for (const Near& texel : near)
    if (texel.cosine >= cosineOfReach) shine[texel.index] = 0.0f;
}

}  // namespace

LampsAndSky takeLampsOut(const Environment& map) {
  const Environment sky = averagedTo(map, mostWidth);
  LampsAndSky parts{{}, sky};
  if (reaches.back() < leastReach(sky)) return parts;
  std::vector<float> shine;
  for (const glm::vec3& radiance : sky.radiance) shine.push_back(static_cast<float>(luminance(radiance)));
  const double whole = fluxOf(sky, shine), least = leastBrightness * whole / (4.0 * std::numbers::pi);
  for (int i = 0; i < mostTries && parts.lamps.size() < mostLamps; ++i) {
    const auto brightest = std::ranges::max_element(shine);
    if (!(*brightest > least)) break;
    const auto texel = static_cast<std::size_t>(brightest - shine.begin());
    const std::vector<Near> first = texelsNear(sky, directionOf(sky, texel));
    std::vector<Near> near = first;
    std::optional<Found> found = foundAt(parts.rest, near);
    for (int step = 0; found && step < centerings; ++step) {
      near = texelsNear(sky, found->lamp.direction);
      found = foundAt(parts.rest, near);
    }
    shine[texel] = 0.0f;  // it is not tried again, even where the light's middle lies elsewhere
    const bool isLamp = found && found->flux > leastShare * whole && found->lamp.radius <= largestRadius;
    if (!isLamp) {  // none lies within the largest reach, in which its light would have been found
      hide(shine, first, std::cos(reaches.back()));
      hide(shine, near, std::cos(reaches.back()));
      continue;
    }
    hide(shine, near, found->cosine);
    for (const Near& texel : near) {
      glm::vec3& radiance = parts.rest.radiance[texel.index];
      if (texel.cosine >= found->cosine) radiance = glm::min(radiance, found->around);
    }
    parts.lamps.push_back(found->lamp);
  }
  return parts;
}

}  // namespace prelight
