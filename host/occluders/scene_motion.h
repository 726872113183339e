#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "occluders/occluder_body.h"
#include "occluders/occluder_motion.h"
#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// How far from orthonormal a motion's rotation may be, in each entry.
constexpr double rigidTolerance = 1e-5;

/// The motion that takes one transform to another; none where that is not rigid, within rigidTolerance.
/// Equal transforms give the identity, to the bit.
std::optional<RigidMotion> motionBetween(const glm::dmat4& before, const glm::dmat4& after);

/// The motions of a scene's vertices and occluders between two poses of its mesh nodes, transforms
/// [meshNode][instance]. `compiled` is the scene in either. Throws InputError when a node with triangles is
/// scaled or sheared, and when parts of one occluder go different ways.
OccluderMotions motionsBetween(const Scene& scene, const CompiledScene& compiled,
                               const OccluderMembers& members,
                               const std::vector<std::vector<glm::dmat4>>& before,
                               const std::vector<std::vector<glm::dmat4>>& after,
                               const std::vector<std::string>& occluderNames);

}  // namespace prelight
