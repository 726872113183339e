#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/magnitudes.h"
#include "images/pixels.h"
#include "prelight/error.h"
#include "prelight/picture.h"

namespace prelight {

glm::dvec3 Environment::direction(double u, double v) {
  const double azimuth = 2.0 * std::numbers::pi * (u - 0.5);  // from -Z towards +X
  const double polar = std::numbers::pi * v;                  // from +Y
  return {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
}

glm::dvec2 Environment::coordinates(const glm::dvec3& direction) {
  const double azimuth = std::atan2(direction.x, -direction.z);
  // Near the poles atan2() is precise and acos(y) is not.
  const double polar = std::atan2(std::hypot(direction.x, direction.z), direction.y);
  return {azimuth / (2.0 * std::numbers::pi) + 0.5, polar * std::numbers::inv_pi};
}

namespace {

/// Negative radiance up to this share of the map's mean counts as rounding, as maps may be lossily
/// compressed.
constexpr double roundingShare = 0.01;

void checkRadiance(const Pixels& pixels, const std::filesystem::path& path) {
  double sum = 0.0;
  for (const glm::vec3& texel : pixels.rgb)
    for (int c = 0; c < 3; ++c) sum += std::isfinite(texel[c]) && texel[c] > 0.0f ? texel[c] : 0.0;
  const double least = -roundingShare * sum / (3.0 * static_cast<double>(pixels.rgb.size()));
  for (std::size_t i = 0; i < pixels.rgb.size(); ++i) {
    const glm::vec3 texel = pixels.rgb[i];
    bool good = true;
    for (int c = 0; c < 3; ++c) good = good && texel[c] <= largestInput && texel[c] >= least;
    if (good) continue;
    const auto width = static_cast<std::size_t>(pixels.width);
    throw InputError(
        path.string(),
        fmt::format("the texel in column {}, row {} is ({:g}, {:g}, {:g}), expected radiance of 0 to {:g}",
                    i % width, i / width, texel.x, texel.y, texel.z, largestInput),
        "repair the map, as with oiiotool and its options fixnan and clamp");
  }
}

}  // namespace

Environment readEnvironment(const std::filesystem::path& path) {
  const std::string extension = lowerExtension(path);
  if (extension != ".hdr" && extension != ".exr") {
    throw InputError(path.string(), "an environment map is an .hdr or .exr file, got '" + extension + "'");
  }
  Pixels pixels = readPixels(path);
  checkRadiance(pixels, path);
  // Removes the small negative values of lossy compression.
  for (glm::vec3& texel : pixels.rgb) texel = glm::max(texel, glm::vec3(0.0f));
  return {pixels.width, pixels.height, std::move(pixels.rgb)};
}

Environment constantEnvironment(const glm::vec3& radiance) { return {1, 1, {radiance}}; }

namespace {

constexpr int studioHeight = 256;
constexpr int studioWidth = 2 * studioHeight;

/// A rectangular light seen from the middle of the studio, on the plane at distance 1 perpendicular to its
/// direction.
struct SoftBox {
  glm::dvec3 towards;
  double halfWidth, halfHeight;
  double edge;  ///< width of the rim over which the light fades
  glm::dvec3 radiance;
};

/// The lights suit a view from the front, slightly from the right and above: a main light from the left, a
/// large one above, a weak one on the right and a narrow one behind for the outline.
const std::array<SoftBox, 4> softBoxes = {{
    {{-0.75, 0.85, 0.75}, 0.45, 0.45, 0.15, {6.0, 5.85, 5.6}},
    {{0.1, 1.0, 0.0}, 0.75, 0.75, 0.35, {1.5, 1.5, 1.5}},
    {{1.0, 0.3, 0.25}, 0.55, 0.75, 0.25, {0.95, 1.0, 1.05}},
    {{-0.35, 0.55, -1.0}, 0.75, 0.22, 0.12, {3.0, 3.0, 3.0}},
}};

double smoothRise(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// Returns the share of a box's radiance that is visible in a direction.
double shareOf(const SoftBox& box, const glm::dvec3& direction) {
  const glm::dvec3 axis = glm::normalize(box.towards);
  const double depth = glm::dot(direction, axis);
  if (depth <= 0.0) return 0.0;
  const glm::dvec3 up(0.0, 1.0, 0.0), ahead(0.0, 0.0, -1.0);
  const glm::dvec3 across = glm::normalize(glm::cross(std::abs(axis.y) < 0.95 ? up : ahead, axis));
  const double x = std::abs(glm::dot(direction, across)) / depth;
  const double y = std::abs(glm::dot(direction, glm::cross(axis, across))) / depth;
  return (1.0 - smoothRise(box.halfWidth - box.edge, box.halfWidth, x)) *
         (1.0 - smoothRise(box.halfHeight - box.edge, box.halfHeight, y));
}

/// Returns the radiance of the walls: brightest a little above the horizon, darker above and on the floor.
double wallAt(double height) {
  constexpr double brightest = 0.45, ceiling = 0.3, floor = 0.12;
  return height > 0.1 ? std::lerp(brightest, ceiling, smoothRise(0.1, 1.0, height))
                      : std::lerp(floor, brightest, smoothRise(-0.8, 0.1, height));
}

}  // namespace

Environment studioEnvironment() {
  Environment sky{studioWidth, studioHeight, {}};
  sky.radiance.reserve(static_cast<std::size_t>(studioWidth) * studioHeight);
  for (int row = 0; row < studioHeight; ++row) {
    for (int column = 0; column < studioWidth; ++column) {
      const glm::dvec3 direction =
          Environment::direction((column + 0.5) / studioWidth, (row + 0.5) / studioHeight);
      glm::dvec3 radiance(wallAt(direction.y));
      for (const SoftBox& box : softBoxes) radiance += shareOf(box, direction) * box.radiance;
      sky.radiance.emplace_back(radiance);
    }
  }
  return sky;
}

}  // namespace prelight
