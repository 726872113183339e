#pragma once

#include <memory>
#include <optional>
#include <span>

#include "occluders/posed_occluders.h"
#include "pictures/session/drawing_session.h"
#include "prelight/draw.h"
#include "techniques/registry/keyed_bake.h"

namespace prelight::pictures {

/// The differences between the scene that is shown and the file's rest pose.
struct PoseOptions : Pose {
  bool plays = false;  ///< a window plays the animation, which then needs no moment
};

/// The parts of a bake that later poses of its scene need.
struct BakedMotion {
  std::optional<AnimatedTransfer> keys;
  std::unique_ptr<const BentBake> bent;  ///< the bake as it was, if the pose bends it and has no keys
  std::unique_ptr<const PosedOccluders> occluders;
};

/// Returns the index in Scene::animations of the animation that moments refer to: the one that is named, else
/// the one that was baked, else that of the scene's moment, else the first. Throws UsageError for one that
/// the scene does not have.
std::size_t animationMeant(const PoseOptions& options, const Scene& scene, const Bake& bake);

/// Moves nodes of a posed scene. Throws UsageError for a node that the scene does not have.
void moveNodes(Scene& scene, std::span<const NodeMove> moves);

/// Poses a scene and replaces its bake by the data for that pose: transfer from the animation's keys, or
/// where skins or morphs bend and there are none, that of the baked pose, bent; and vector occluders, which
/// move along (or are left out with a warning if they cannot). Data for the rest pose alone are left out.
/// Without a moment or a move it does nothing, and the bake keeps the data for later poses, which are
/// otherwise returned. Throws UsageError for an animation or a node that the scene does not have.
BakedMotion poseScene(DrawingSession& session, const PoseOptions& options, LoadedScene& loaded, Bake& bake);

}  // namespace prelight::pictures
