#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "occluders/occluder_body.h"
#include "occluders/occluder_motion.h"
#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// Greatest deviation, per entry, of a rigid motion's rotation from orthonormality.
constexpr double rigidTolerance = 1e-5;

/// Returns the motion from one transform to another, or nothing if it is not rigid within rigidTolerance.
/// Equal transforms give exactly the identity.
std::optional<RigidMotion> motionBetween(const glm::dmat4& before, const glm::dmat4& after);

/// Returns the motions of a scene's vertices and occluders between two poses of its mesh nodes, given as
/// transforms [meshNode][instance]. `compiled` is the scene in either pose. Throws InputError when a node
/// with triangles is scaled or sheared and when parts of one occluder move differently.
OccluderMotions motionsBetween(const Scene& scene, const CompiledScene& compiled,
                               const OccluderMembers& members,
                               const std::vector<std::vector<glm::dmat4>>& before,
                               const std::vector<std::vector<glm::dmat4>>& after,
                               const std::vector<std::string>& occluderNames);

}  // namespace prelight
