#pragma once

#include <cstddef>
#include <glm/glm.hpp>

#include "prelight/compiled_scene.h"
#include "prelight/transfer.h"

namespace prelight {

/// Distances that shells tell apart, m.
struct ShellRange {
  double nearest = 0.0, farthest = 0.0;
};

/// Of a scene: to the diagonal of its bounds, beyond which no lamp within them is from anything.
ShellRange shellRange(const CompiledScene& scene);

/// Where a shell begins, m; the last ends where shell `shells` would begin.
double shellStart(const NearLampTransfer& transfer, int shell);

/// Shells that a lamp's place lags behind: surfaces that are next to a lamp are behind it, more often than
/// not.
constexpr double shellLag = 0.5;

/// What the hemisphere, weighted by the cosine, has in band l for Legendre's polynomial of a direction's
/// cosine.
double openBand(int l);

/// How much of what a shell holds counts as in front of a lamp at `distance`, m: 0 to 1.
double shareBefore(const NearLampTransfer& transfer, int shell, double distance);

/// How much of the light of a lamp at `distance` in the unit direction `toLamp` arrives at a vertex with this
/// unit normal, 0 to 1: one less what is blocked before the lamp over what is there without blockers, both
/// cut to the bands of the transfer. What is cut is blurred: a straight edge of a shadow lies where it is a
/// half.
double lampVisibility(const NearLampTransfer& transfer, std::size_t vertex, const glm::dvec3& normal,
                      const glm::dvec3& toLamp, double distance);

/// What is drawn of an interpolated visibility: the same with steeper edges, as points cast them. The slope
/// is that of shaders/surface.frag.
double sharpened(double visibility);

}  // namespace prelight
