#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "prelight/picture.h"

namespace prelight {
namespace {

/// Share of the pixels that must be below white.
constexpr double whiteShare = 0.98, white = 0.8;
/// Bounds of the picture's log-average luminance, within the keys 0.09 to 0.72 of [1].
constexpr double darkest = 0.13, lightest = 0.5;

// [1] Reinhard et al., "Photographic Tone Reproduction for Digital Images", 2002.

double luminanceOf(const glm::vec3& c) {
  const double y = 0.2126 * double(c.x) + 0.7152 * double(c.y) + 0.0722 * double(c.z);
  return std::isfinite(y) ? y : 0.0;
}

/// Rounds to three digits, so that the printed number gives the same picture.
double roundedFactor(double factor) {
  const double unit = std::pow(10.0, std::floor(std::log10(factor)) - 2.0);
  return std::round(factor / unit) * unit;
}

}  // namespace

double meteredExposure(const Picture& picture) {
  std::vector<double> luminances;
  for (const glm::vec3& pixel : picture.pixels)
    if (const double y = luminanceOf(pixel); y > 0.0) luminances.push_back(y);
  if (luminances.empty()) return 1.0;
  double sum = 0.0;
  for (const double y : luminances) sum += std::log(y);
  const double mean = std::exp(sum / static_cast<double>(luminances.size()));
  const auto place =
      luminances.begin() + static_cast<std::ptrdiff_t>(whiteShare * double(luminances.size() - 1));
  std::nth_element(luminances.begin(), place, luminances.end());
  const double factor = std::clamp(white / *place, darkest / mean, lightest / mean);
  return std::isfinite(factor) && factor > 0.0
             ? std::clamp(roundedFactor(factor), leastExposure, mostExposure)
             : 1.0;
}

Picture exposed(Picture picture, double exposure) {
  if (exposure == 1.0) return picture;
  for (glm::vec3& pixel : picture.pixels) pixel *= static_cast<float>(exposure);
  return picture;
}

}  // namespace prelight
