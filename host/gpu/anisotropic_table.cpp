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
              heightCount = PRELIGHT_ANISOTROPIC_HEIGHTS, reachCount = PRELIGHT_ANISOTROPIC_REACHES;
constexpr std::size_t texelCount = PRELIGHT_ANISOTROPIC_TEXELS;
constexpr double leastWidth = 0.0025;  ///< square of PRELIGHT_SMOOTH_BELOW in kernels/transport/lobe_funcs.cl

/// Widths of the microfacet distribution along two axes; the first is the larger one.
struct Widths {
  double along, across;

  double term(const glm::dvec3& w) const {
    return std::sqrt(w.z * w.z + along * along * w.x * w.x + across * across * w.y * w.y);
  }
};

/// Returns the widths of a row of the table.
Widths widthsAt(int across, int stretch) {
  const double step = double(across) / (acrossCount - 1), narrow = std::max(step * step * step, leastWidth);
  const double added = double(stretch) / (stretchCount - 1);
  return {narrow + (1.0 - narrow) * added * added, narrow};
}

template <std::size_t steps>
std::array<glm::dvec2, steps> unitCircle() {
  std::array<glm::dvec2, steps> points;
  for (std::size_t i = 0; i < steps; ++i) {
    const double turn = 2.0 * std::numbers::pi * (double(i) + 0.5) / double(steps);
    points[i] = {std::cos(turn), std::sin(turn)};
  }
  return points;
}

/// Returns the share of light that leaves, G2 / G1, averaged over the normals visible along a direction
/// (Dupuy and Benyoub 2023): the constant part of Schlick's reflectance, and the rise. v is the direction
/// stretched by the widths; `steps` is the number of heights and of turns.
template <std::size_t steps>
glm::dvec2 leavesOnce(const glm::dvec3& v, const Widths& widths) {
  static const std::array<glm::dvec2, steps> turns = unitCircle<steps>();
  const glm::dvec3 wo = glm::normalize(glm::dvec3(v.x / widths.along, v.y / widths.across, v.z));
  const double from = widths.term(wo);
  glm::dvec2 sum(0.0);
  for (std::size_t y = 0; y < steps; ++y) {
    const double step = (double(y) + 0.5) / double(steps);
    const double z = 1.0 - (1.0 - step * step * step) * (1.0 + v.z);
    const double radius = std::sqrt(std::max(1.0 - z * z, 0.0));
    for (const glm::dvec2& turn : turns) {
      const glm::dvec3 c = glm::dvec3(radius * turn, z) + v;
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
  return sum / double(steps * steps);
}

/// Values for one pair of widths, [height][texel].
using WidthTexels = std::array<glm::vec4, texelCount * heightCount>;

/// Returns the greatest excess of the cosine at the effective facet, for which Schlick's formula gives the
/// outgoing light, over the cosine of a direction.
double mostAbove(const Widths& widths, double reach) {
  return std::sqrt(reach * reach + widths.across * widths.across * (1.0 - reach * reach));
}

/// Returns the actual excess as a share of mostAbove(), for the direction's reach in the plane of the larger
/// width and its height there.
double aboveShare(const Widths& widths, double reach, double height) {
  const glm::dvec3 w(reach * std::sqrt(1.0 - height * height), std::sqrt(1.0 - reach * reach),
                     std::max(reach * height, 1e-4));
  const glm::dvec3 v = glm::normalize(glm::dvec3(widths.along * w.x, widths.across * w.y, w.z));
  const glm::dvec2 leaves = leavesOnce<16>(v, widths);
  const double grazing = std::pow(std::clamp(leaves.y / std::max(leaves.x + leaves.y, 1e-9), 0.0, 1.0), 0.2);
  return (1.0 - grazing - reach * height) / mostAbove(widths, reach);
}

double allThatLeaves(const Widths& widths, const glm::dvec3& v) {
  const glm::dvec2 leaves = leavesOnce<32>(v, widths);
  return leaves.x + leaves.y;
}

WidthTexels rowOfWidths(const Widths& widths) {
  WidthTexels row;
  for (std::size_t h = 0; h < heightCount; ++h) {
    const double step = double(h) / (heightCount - 1);
    const double up = std::clamp(std::pow(std::sin(0.5 * std::numbers::pi * step), 2.0), 1e-3, 1.0),
                 out = std::sqrt(1.0 - up * up), half = out * std::numbers::sqrt2 / 2.0;
    row[texelCount * h] =
        glm::vec4(allThatLeaves(widths, {out, 0.0, up}), allThatLeaves(widths, {half, half, up}),
                  allThatLeaves(widths, {0.0, out, up}), 0.0f);
    const double height = std::clamp(step * step, 2e-3, 1.0);
    std::array<double, reachCount> shares{};
    for (int r = 0; r < reachCount; ++r) {
      const double root = double(r) / (reachCount - 1);
      shares[std::size_t(r)] = aboveShare(widths, root * root, height);
    }
    for (std::size_t t = 0; t + 1 < texelCount; ++t)
      row[texelCount * h + 1 + t] =
          glm::vec4(shares[3 * t], shares[3 * t + 1], shares[3 * t + 2], shares[3 * t + 3]);
  }
  return row;
}

glm::dvec4 betweenHeights(const WidthTexels& row, double step, std::size_t texel) {
  const double height = step * (heightCount - 1);
  const auto h = std::min(static_cast<std::size_t>(height), std::size_t{heightCount - 2});
  return glm::mix(glm::dvec4(row[texelCount * h + texel]), glm::dvec4(row[texelCount * (h + 1) + texel]),
                  height - double(h));
}

/// Returns the looked-up value along a direction, as kernels/transport/anisotropic_albedo_funcs.cl does.
glm::dvec2 lookUpWidths(const WidthTexels& row, const Widths& widths, const glm::dvec3& w) {
  const glm::dvec3 v(widths.along * w.x, widths.across * w.y, w.z);
  const double square = v.x * v.x + v.y * v.y;
  const double turn = square > 1e-20 ? (v.x * v.x - v.y * v.y) / square : 0.0;
  const double up = std::clamp(v.z / glm::length(v), 0.0, 1.0);
  const glm::dvec4 sums = betweenHeights(row, std::asin(std::sqrt(up)) * 2.0 / std::numbers::pi, 0);
  const double all = sums.x * (0.5 * turn * (turn + 1.0)) + sums.y * (1.0 - turn * turn) +
                     sums.z * (0.5 * turn * (turn - 1.0));
  const double reach = std::min(std::hypot(w.x, w.z), 1.0), place = std::sqrt(reach) * (reachCount - 1);
  const auto step = std::min(static_cast<std::size_t>(place), std::size_t{reachCount - 2});
  const glm::dvec4 shares = betweenHeights(row, std::sqrt(std::min(w.z / reach, 1.0)), 1 + step / 3);
  const auto first = static_cast<int>(step % 3);
  const double share = glm::mix(shares[first], shares[first + 1], place - double(step));
  const double grazing = 1.0 - w.z - share * mostAbove(widths, reach);
  const double rise = std::pow(std::clamp(grazing, 0.0, 1.0), 5.0);
  return {all * (1.0 - rise), all * rise};
}

/// Returns the cosine-weighted mean over directions of the looked-up values, which the compensation for later
/// bounces is based on.
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
  std::vector<glm::vec4> table(rows * (texelCount * heightCount + 1));
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
