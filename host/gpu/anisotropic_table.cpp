#include "gpu/anisotropic_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/parallel.h"
#include "shared/albedo_types.h"

namespace prelight {

namespace {

constexpr int acrossCount = PRELIGHT_ANISOTROPIC_ACROSS, stretchCount = PRELIGHT_ANISOTROPIC_STRETCHES,
              heightCount = PRELIGHT_ANISOTROPIC_HEIGHTS;
constexpr double leastWidth = 0.0025;  ///< PRELIGHT_SMOOTH_BELOW squared, in kernels/transport/lobe_funcs.cl

/// Widths of microfacets along two directions; the first is the larger one.
struct Widths {
  double along, across;

  double term(const glm::dvec3& w) const {
    return std::sqrt(w.z * w.z + along * along * w.x * w.x + across * across * w.y * w.y);
  }
};

/// Those of a row of the table.
Widths widthsAt(int across, int stretch) {
  const double root = double(across) / (acrossCount - 1), narrow = std::max(root * root, leastWidth);
  return {narrow + (1.0 - narrow) * stretch / (stretchCount - 1), narrow};
}

/// Over the normals that are visible along the direction that becomes v when it is stretched by the widths
/// (Dupuy and Benyoub 2023), the share that leaves: G2 / G1. Constant part of Schlick's reflectance, and
/// rise.
glm::dvec2 leavesOnce(const glm::dvec3& v, const Widths& widths) {
  constexpr int heights = 32, turns = 32;
  const glm::dvec3 wo = glm::normalize(glm::dvec3(v.x / widths.along, v.y / widths.across, v.z));
  const double from = widths.term(wo);
  glm::dvec2 sum(0.0);
  for (int y = 0; y < heights; ++y) {
    const double step = (y + 0.5) / heights;
    const double z = 1.0 - (1.0 - step * step * step) * (1.0 + v.z);
    const double radius = std::sqrt(std::max(1.0 - z * z, 0.0));
    for (int x = 0; x < turns; ++x) {
      const double turn = 2.0 * std::numbers::pi * (x + 0.5) / turns;
      const glm::dvec3 c = glm::dvec3(radius * std::cos(turn), radius * std::sin(turn), z) + v;
      const glm::dvec3 h =
          glm::normalize(glm::dvec3(widths.along * c.x, widths.across * c.y, std::max(c.z, 1e-9)));
      const double along = glm::dot(wo, h);
      const glm::dvec3 wi = 2.0 * along * h - wo;
      if (wi.z <= 0.0) continue;
      const double to = widths.term(wi), leaves = wi.z * (wo.z + from) / (wo.z * to + wi.z * from);
      const double k = std::clamp(1.0 - along, 0.0, 1.0), rise = k * k * k * k * k;
      sum += 3.0 * step * step * leaves * glm::dvec2(1.0 - rise, rise);
    }
  }
  return sum / double(heights * turns);
}

/// Of one pair of widths: two texels a height.
using WidthTexels = std::array<glm::vec4, 2 * heightCount>;

/// All that leaves, and the rise by the cosine with a facet that would show it.
glm::dvec2 wholeAndGrazing(const glm::dvec2& leaves) {
  const double all = leaves.x + leaves.y;
  return {all, std::pow(std::clamp(leaves.y / std::max(all, 1e-9), 0.0, 1.0), 0.2)};
}

/// What leaves along a direction that is not stretched, `grazing` less that of the surface.
double lowerOf(const Widths& widths, double cosine, double degrees) {
  const double sine = std::sqrt(1.0 - cosine * cosine), azimuth = degrees * std::numbers::pi / 180.0;
  const glm::dvec3 w(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine);
  const glm::dvec3 v = glm::normalize(glm::dvec3(widths.along * w.x, widths.across * w.y, w.z));
  return wholeAndGrazing(leavesOnce(v, widths)).y - (1.0 - cosine);
}

WidthTexels rowOfWidths(const Widths& widths) {
  WidthTexels row;
  for (int h = 0; h < heightCount; ++h) {
    const double step = double(h) / (heightCount - 1);
    const double up = std::clamp(std::pow(std::sin(0.5 * std::numbers::pi * step), 2.0), 1e-3, 1.0),
                 out = std::sqrt(1.0 - up * up), half = out * std::numbers::sqrt2 / 2.0;
    row[2 * std::size_t(h)] = glm::vec4(wholeAndGrazing(leavesOnce({out, 0.0, up}, widths)).x,
                                        wholeAndGrazing(leavesOnce({half, half, up}, widths)).x,
                                        wholeAndGrazing(leavesOnce({0.0, out, up}, widths)).x, 0.0f);
    const double cosine = std::clamp(step * step, 2e-3, 1.0);
    row[2 * std::size_t(h) + 1] = glm::vec4(lowerOf(widths, cosine, 0.0), lowerOf(widths, cosine, 45.0),
                                            lowerOf(widths, cosine, 70.0), lowerOf(widths, cosine, 90.0));
  }
  return row;
}

glm::dvec4 betweenHeights(const WidthTexels& row, double step, std::size_t texel) {
  const double height = step * (heightCount - 1);
  const auto h = std::min(static_cast<std::size_t>(height), std::size_t{heightCount - 2});
  return glm::mix(glm::dvec4(row[2 * h + texel]), glm::dvec4(row[2 * h + 2 + texel]), height - double(h));
}

/// What is looked up along a direction.
glm::dvec2 lookUpWidths(const WidthTexels& row, const Widths& widths, const glm::dvec3& w) {
  const glm::dvec3 v(widths.along * w.x, widths.across * w.y, w.z);
  const double square = v.x * v.x + v.y * v.y, flat = w.x * w.x + w.y * w.y;
  const double turn = square > 1e-20 ? (v.x * v.x - v.y * v.y) / square : 0.0;
  const double up = std::clamp(v.z / glm::length(v), 0.0, 1.0);
  const glm::dvec4 sums = betweenHeights(row, std::asin(std::sqrt(up)) * 2.0 / std::numbers::pi, 0);
  const double all = sums.x * (0.5 * turn * (turn + 1.0)) + sums.y * (1.0 - turn * turn) +
                     sums.z * (0.5 * turn * (turn - 1.0));
  const glm::dvec4 lower = betweenHeights(row, std::sqrt(w.z), 1);
  const double c = flat > 1e-20 ? (w.x * w.x - w.y * w.y) / flat : 0.0;
  const std::array<double, 4> nodes{1.0, 0.0, std::cos(7.0 / 9.0 * std::numbers::pi), -1.0};
  double grazing = 1.0 - w.z;
  for (int i = 0; i < 4; ++i) {
    double weight = 1.0;
    for (int k = 0; k < 4; ++k)
      if (k != i) weight *= (c - nodes[std::size_t(k)]) / (nodes[std::size_t(i)] - nodes[std::size_t(k)]);
    grazing += weight * lower[i];
  }
  const double rise = std::pow(std::clamp(grazing, 0.0, 1.0), 5.0);
  return {all * (1.0 - rise), all * rise};
}

/// Mean over directions, weighted by the cosine, of what is looked up, so that what is added for later
/// bounces makes up for just that.
glm::dvec2 meanOfWidths(const WidthTexels& row, const Widths& widths) {
  constexpr int cosines = 64, azimuths = 32;
  glm::dvec2 sum(0.0);
  for (int i = 0; i < cosines; ++i) {
    const double cosine = std::sqrt((i + 0.5) / cosines), sine = std::sqrt(1.0 - cosine * cosine);
    for (int k = 0; k < azimuths; ++k) {
      const double azimuth = 0.5 * std::numbers::pi * (k + 0.5) / azimuths;
      sum += lookUpWidths(row, widths, {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine});
    }
  }
  return sum / double(cosines * azimuths);
}

}  // namespace

std::vector<glm::vec4> makeAnisotropicTable() {
  constexpr std::size_t rows = std::size_t{acrossCount} * stretchCount;
  std::vector<glm::vec4> table(rows * (2 * heightCount + 1));
  parallelRanges(rows, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      const Widths widths = widthsAt(static_cast<int>(r) / stretchCount, static_cast<int>(r) % stretchCount);
      const WidthTexels row = rowOfWidths(widths);
      std::copy(row.begin(), row.end(), table.begin() + static_cast<std::ptrdiff_t>(r * row.size()));
      table[rows * row.size() + r] = glm::vec4(glm::vec2(meanOfWidths(row, widths)), 0.0f, 0.0f);
    }
  });
  return table;
}

}  // namespace prelight
