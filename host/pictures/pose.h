#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "occluders/posed_occluders.h"
#include "pictures/drawing_session.h"

namespace prelight::pictures {

/// A displacement of nodes from their places in the file.
struct NodeMove {
  std::string pattern;      ///< matches names of mesh nodes
  glm::dvec3 by{0.0};       ///< m, world space
  double yawDegrees = 0.0;  ///< counter-clockwise as seen from above, about the node's origin
};

/// The differences between the scene that is shown and the file's rest pose.
struct PoseOptions {
  std::optional<double> at;     ///< seconds; none: the rest pose
  std::string animation;        ///< name or number; empty: the one that was baked, else the first
  std::vector<NodeMove> moves;  ///< applied in this order after the animation
  bool plays = false;           ///< a window plays the animation, which then needs no moment
};

/// The parts of a bake that later poses of its scene need.
struct BakedMotion {
  std::optional<AnimatedTransfer> keys;
  std::unique_ptr<const PosedOccluders> occluders;
};

/// Returns the index in Scene::animations of the animation that moments refer to: the one that is named, else
/// the one that was baked, else that of the scene's moment, else the first. Throws UsageError for one that
/// the scene does not have.
std::size_t animationMeant(const PoseOptions& options, const Scene& scene, const Bake& bake);

/// Moves nodes of a posed scene. Throws UsageError for a node that the scene does not have.
void moveNodes(Scene& scene, std::span<const NodeMove> moves);

/// Poses a scene and replaces its bake by the data for that pose: transfer from the animation's keys, and
/// vector occluders, which move along (or are left out with a warning if they cannot). Data for the rest pose
/// alone are left out. Without a moment or a move it does nothing, and the bake keeps the data for later
/// poses, which are otherwise returned. Throws UsageError for an animation or a node that the scene does not
/// have.
BakedMotion poseScene(DrawingSession& session, const PoseOptions& options, OpenedScene& loaded, Bake& bake);

}  // namespace prelight::pictures
