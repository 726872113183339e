#pragma once

#include <cstddef>
#include <glm/glm.hpp>

#include "prelight/compiled_scene.h"
#include "prelight/request.h"
#include "prelight/transfer.h"

namespace prelight {

/// Range of distances that shells divide, m.
struct ShellRange {
  double nearest = 0.0, farthest = 0.0;
};

/// Returns the range for a scene: as requested, or else up to the diagonal of its bounds, the greatest
/// distance of lamps inside them.
ShellRange shellRange(const CompiledScene& scene, const NearLampsRequest& request = {});

/// Returns the distance at which a shell begins, m, or for `shells` where the last one ends.
double shellStart(const NearLampTransfer& transfer, int shell);

/// Offset in shells that is subtracted from a lamp's place, since surfaces next to a lamp are more often
/// behind it than in front.
constexpr double shellLag = 0.5;

/// Returns the share, 0 to 1, of a shell that counts as in front of a lamp at `distance`, m.
double shareBefore(const NearLampTransfer& transfer, int shell, double distance);

/// Returns the share, 0 to 1, of the light of a lamp at `distance` in the unit direction `toLamp` that
/// arrives at a vertex with this unit normal: 1 minus the blocked over the unblocked light, both truncated to
/// the bands of the transfer. Truncation blurs: the straight edge of a shadow lies where the share is a half.
double lampVisibility(const NearLampTransfer& transfer, std::size_t vertex, const glm::dvec3& normal,
                      const glm::dvec3& toLamp, double distance);

/// Returns an interpolated visibility with steeper edges, like the shadows of point lights, for drawing. The
/// slope is that of shaders/surface.frag.
double sharpened(double visibility);

}  // namespace prelight
