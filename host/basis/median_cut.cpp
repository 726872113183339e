#include "basis/median_cut.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/colour.h"

namespace prelight {

namespace {

// Columns; with fewer, texels are split first, because cuts run between texels.
constexpr int leastWidth = 64;

/// A rectangle of texels.
struct Part {
  int left = 0, right = 0, top = 0, bottom = 0;  ///< right and bottom are exclusive
  double energy = 0.0;
  double spread = 0.0;  ///< energy x the square of its longer side in radians
};

Environment withTexelsSplit(const Environment& sky) {
  if (sky.width >= leastWidth) return sky;
  const int factor = (leastWidth + sky.width - 1) / sky.width;
  Environment fine{factor * sky.width, factor * sky.height, {}};
  for (int row = 0; row < fine.height; ++row)
    for (int column = 0; column < fine.width; ++column)
      fine.radiance.push_back(
          sky.radiance[static_cast<std::size_t>(row / factor * sky.width + column / factor)]);
  return fine;
}

class Cutter {
 public:
  explicit Cutter(const Environment& sky) : sky_(sky) {
    for (int row = 0; row < sky.height; ++row) {
      const double top = std::cos(std::numbers::pi * row / sky.height),
                   bottom = std::cos(std::numbers::pi * (row + 1) / sky.height);
      solidAngle_.push_back((top - bottom) * 2.0 * std::numbers::pi / sky.width);
    }
  }

  std::vector<Part> cut(int count) const {
    std::vector<Part> parts = {measured({0, sky_.width, 0, sky_.height, 0.0, 0.0})};
    while (static_cast<int>(parts.size()) < count) {
      const auto widest = std::max_element(parts.begin(), parts.end(),
                                           [](const Part& a, const Part& b) { return a.spread < b.spread; });
      if (!(widest->spread > 0.0)) break;
      const Part whole = *widest;
      const bool across = cutsAcross(whole);
      const int at = median(whole, across);
      Part first = whole, second = whole;
      (across ? first.right : first.bottom) = at;
      (across ? second.left : second.top) = at;
      *widest = measured(first);
      parts.push_back(measured(second));
    }
    return parts;
  }

  SkyLight lightOf(const Part& part) const {
    SkyLight light;
    glm::dvec3 centre(0.0);
    for (int row = part.top; row < part.bottom; ++row)
      for (int column = part.left; column < part.right; ++column) {
        const glm::vec3& radiance = texel(row, column);
        const double weight = solidAngle_[static_cast<std::size_t>(row)];
        light.irradiance += weight * glm::dvec3(radiance);
        centre += weight * luminance(radiance) *
                  Environment::direction((column + 0.5) / sky_.width, (row + 0.5) / sky_.height);
      }
    const double length = glm::length(centre);
    light.direction = length > 1e-9 * std::max(part.energy, 1e-300)
                          ? centre / length
                          : Environment::direction(0.5 * (part.left + part.right) / sky_.width,
                                                   0.5 * (part.top + part.bottom) / sky_.height);
    return light;
  }

 private:
  const glm::vec3& texel(int row, int column) const {
    return sky_.radiance[static_cast<std::size_t>(row) * static_cast<std::size_t>(sky_.width) +
                         static_cast<std::size_t>(column)];
  }

  double height(const Part& p) const { return std::numbers::pi * (p.bottom - p.top) / sky_.height; }

  /// Returns the width at the part's middle latitude.
  double width(const Part& p) const {
    return 2.0 * std::numbers::pi * (p.right - p.left) / sky_.width *
           std::sin(std::numbers::pi * 0.5 * (p.top + p.bottom) / sky_.height);
  }

  double energyOf(int row, int column) const {
    return luminance(texel(row, column)) * solidAngle_[static_cast<std::size_t>(row)];
  }

  Part measured(Part part) const {
    part.energy = 0.0;
    for (int row = part.top; row < part.bottom; ++row)
      for (int column = part.left; column < part.right; ++column) part.energy += energyOf(row, column);
    const bool single = part.right - part.left < 2 && part.bottom - part.top < 2;
    const double side = std::max(width(part), height(part));
    part.spread = single ? 0.0 : part.energy * side * side;
    return part;
  }

  /// Returns true when the longer side that can be cut runs along a row.
  bool cutsAcross(const Part& part) const {
    if (part.right - part.left < 2) return false;
    return part.bottom - part.top < 2 || width(part) >= height(part);
  }

  /// Returns the column or row up to which half of the energy lies; both sides keep at least one.
  int median(const Part& part, bool across) const {
    const int first = across ? part.left : part.top, end = across ? part.right : part.bottom;
    double passed = 0.0;
    for (int line = first; line < end; ++line) {
      if (across)
        for (int row = part.top; row < part.bottom; ++row) passed += energyOf(row, line);
      else
        for (int column = part.left; column < part.right; ++column) passed += energyOf(line, column);
      if (passed >= 0.5 * part.energy) return std::clamp(line + 1, first + 1, end - 1);
    }
    return end - 1;
  }

  const Environment& sky_;
  std::vector<double> solidAngle_;  ///< [row] of a texel
};

}  // namespace

std::vector<SkyLight> medianCut(const Environment& sky, int count) {
  const Environment fine = withTexelsSplit(sky);
  const Cutter cutter(fine);
  std::vector<SkyLight> lights;
  for (const Part& part : cutter.cut(count))
    if (part.energy > 0.0) lights.push_back(cutter.lightOf(part));
  return lights;
}

}  // namespace prelight
