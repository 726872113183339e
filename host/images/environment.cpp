#include "prelight/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/magnitudes.h"
#include "images/pixels.h"
#include "prelight/error.h"

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

}  // namespace prelight
