#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/transfer.h"

namespace prelight {

/// How the surface has changed at each vertex between two poses of a scene.
struct SurfaceBend {
  std::vector<glm::dmat3> turns;       ///< [vertex], vertexTurns()
  std::vector<glm::vec3> normals;      ///< [vertex], unit, in the first pose
  std::vector<glm::vec3> bentNormals;  ///< [vertex], in the second
  std::vector<bool> changed;           ///< [vertex], false where neither turn nor normal has changed
};

SurfaceBend bendBetween(const CompiledScene& from, const CompiledScene& to);

/// Returns functions of the first pose for the second: the mean of the function that turns with its vertex
/// and the one that stays in the world. Vertices that have not changed keep theirs bit for bit.
HarmonicTransfer halfTurned(const HarmonicTransfer& functions, const SurfaceBend& bend);

/// Returns the SH transfer of the first pose for the second, without rays. What an open surface would receive
/// follows the normal exactly. What occlusion and bounces change of it is halfTurned(): half of it is taken
/// to move along, as the body's own folds do, and half to stay, as the floor does (docs/notes/animation.md).
HarmonicTransfer bentTransfer(const HarmonicTransfer& transfer, const SurfaceBend& bend);

}  // namespace prelight
