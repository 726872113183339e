#include "techniques/volume/occlusion_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "gpu/tracer.h"
#include "techniques/volume/volume_caster.h"

namespace prelight {

namespace {

constexpr double wholeSphere = 4.0 * std::numbers::pi;
constexpr std::uint32_t raysForInside = 16;

/// Cubes of which about `cells` fill the bounds and what lies within the radius of them.
VolumeGrid gridAround(const CompiledScene& object, double radius, std::size_t cells) {
  const glm::dvec3 lower = glm::dvec3(object.boundsMin) - radius,
                   upper = glm::dvec3(object.boundsMax) + radius;
  const glm::dvec3 sides = upper - lower;
  const double cell = std::cbrt(sides.x * sides.y * sides.z / static_cast<double>(cells));
  VolumeGrid grid;
  for (int a = 0; a < 3; ++a) grid.size[a] = std::max(2, static_cast<int>(std::ceil(sides[a] / cell)));
  const glm::dvec3 centre = object.origin + 0.5 * (lower + upper);
  grid.min = centre - 0.5 * cell * glm::dvec3(grid.size);
  grid.max = centre + 0.5 * cell * glm::dvec3(grid.size);
  return grid;
}

VolumeTransfer visibilityAround(const CompiledScene& object, Tracer& tracer, const VolumeGrid& grid,
                                const VolumeOptions& options, Progress& progress) {
  return makeVolume(object, {}, tracer, {}, grid, options, progress);
}

/// Numbers of the cells that share a face with one.
std::vector<std::size_t> neighboursOf(std::size_t cell, const glm::ivec3& size) {
  const auto x = static_cast<std::size_t>(size.x), y = static_cast<std::size_t>(size.y);
  const std::array<std::size_t, 3> strides = {1, x, x * y};
  const glm::ivec3 place(static_cast<int>(cell % x), static_cast<int>(cell / x % y),
                         static_cast<int>(cell / (x * y)));
  std::vector<std::size_t> found;
  for (int a = 0; a < 3; ++a) {
    const std::size_t stride = strides[static_cast<std::size_t>(a)];
    if (place[a] > 0) found.push_back(cell - stride);
    if (place[a] + 1 < size[a]) found.push_back(cell + stride);
  }
  return found;
}

/// Cells that are not air become the mean of their neighbours that are, ring by ring.
void fillSolids(OcclusionField& field, std::vector<std::uint8_t> known) {
  constexpr std::size_t n = OcclusionField::moments;
  for (bool filled = true; filled;) {
    filled = false;
    std::vector<std::uint8_t> next = known;
    for (std::size_t cell = 0; cell < known.size(); ++cell) {
      if (known[cell] != 0) continue;
      std::array<float, n> sum{};
      float count = 0.0f;
      for (const std::size_t other : neighboursOf(cell, field.grid.size)) {
        if (known[other] == 0) continue;
        for (std::size_t i = 0; i < n; ++i) sum[i] += field.hidden[other * n + i];
        count += 1.0f;
      }
      if (count == 0.0f) continue;
      for (std::size_t i = 0; i < n; ++i) field.hidden[cell * n + i] = sum[i] / count;
      next[cell] = 1;
      filled = true;
    }
    known = std::move(next);
  }
}

}  // namespace

OcclusionField castOcclusionField(const CompiledScene& object, const Device& device,
                                  const OcclusionFieldOptions& options, Progress& progress) {
  OcclusionField field{gridAround(object, options.radius, options.cells), {}};
  Tracer tracer(object, device);
  VolumeOptions within{OcclusionField::order, 0, false, options.rays, options.seed, {}};
  within.limits.farthest = options.radius;
  // Beyond the radius a solid's inside looks like air, so that these rays go on.
  const VolumeOptions unlimited{1, 0, false, raysForInside, options.seed, {}};
  const VolumeTransfer air = visibilityAround(object, tracer, field.grid, unlimited, progress);
  field.hidden = visibilityAround(object, tracer, field.grid, within, progress).coefficients;
  for (std::size_t i = 0; i < field.hidden.size(); ++i) {
    const double open = i % OcclusionField::moments == 0 ? std::sqrt(wholeSphere) : 0.0;
    field.hidden[i] = static_cast<float>(open - wholeSphere * double{field.hidden[i]});
  }
  fillSolids(field, air.air);
  return field;
}

}  // namespace prelight
