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

/// A node's way from where the file has it.
struct NodeMove {
  std::string pattern;      ///< of mesh nodes' names
  glm::dvec3 by{0.0};       ///< m, world space
  double yawDegrees = 0.0;  ///< counter-clockwise seen from above, about the node's origin
};

/// How the scene that is shown differs from the file's at rest.
struct PoseOptions {
  std::optional<double> at;     ///< seconds; none: the rest pose
  std::string animation;        ///< name or number; empty: the one that was baked, else the first
  std::vector<NodeMove> moves;  ///< after the animation, in their order
  bool plays = false;           ///< a window plays it: an animation needs no moment
};

/// What a bake has for further poses of its scene.
struct BakedMotion {
  std::optional<AnimatedTransfer> keys;
  std::unique_ptr<const PosedOccluders> occluders;
};

/// The animation that moments are of, into Scene::animations: the one that is named, else the one that was
/// baked, else that of the scene's moment, else the first. Throws UsageError for one that the scene lacks.
std::size_t animationMeant(const PoseOptions& options, const Scene& scene, const Bake& bake);

/// Moves nodes of a posed scene. Throws UsageError for a node that the scene lacks.
void moveNodes(Scene& scene, std::span<const NodeMove> moves);

/// Poses a scene, and replaces its bake by what holds then: transfer of the animation's keys, and vector
/// occluders, which are moved along (with a warning and left out where they cannot be). What the file carries
/// of the rest pose alone is left out. Does nothing without a moment or a move: then the bake keeps what
/// further poses need, which is given back otherwise. Throws UsageError for an animation or a node that the
/// scene lacks.
BakedMotion poseScene(DrawingSession& session, const PoseOptions& options, OpenedScene& loaded, Bake& bake);

}  // namespace prelight::pictures
