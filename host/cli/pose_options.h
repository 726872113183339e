#pragma once

#include <CLI/CLI.hpp>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/session.h"

namespace prelight::cli {

/// A node's way from where the file has it.
struct NodeMove {
  std::string pattern;      ///< of mesh nodes' names
  glm::dvec3 by{0.0};       ///< m, world space
  double yawDegrees = 0.0;  ///< counter-clockwise seen from above, about the node's origin
};

/// "NODE:x,y,z" or "NODE:x,y,z:yaw"; the node's name may have colons. Throws UsageError.
NodeMove parseNodeMove(const std::string& text);

/// How the scene that is shown differs from the file's at rest.
struct PoseOptions {
  std::optional<double> at;     ///< seconds; none: the rest pose
  std::string animation;        ///< name or number; empty: the one that was baked, else the first
  std::vector<NodeMove> moves;  ///< after the animation, in their order
};

/// --at, --animation and --move.
void addPoseOptions(CLI::App& app, PoseOptions& options);

/// Poses a scene, and replaces its bake by what holds then: transfer of the animation's keys, and vector
/// occluders, which are moved along (with a warning and left out where they cannot be). What the file carries
/// of the rest pose alone is left out. Does nothing without a moment or a move. Throws UsageError for an
/// animation or a node that the scene lacks.
void poseScene(Session& session, const PoseOptions& options, LoadedScene& loaded, Bake& bake);

}  // namespace prelight::cli
