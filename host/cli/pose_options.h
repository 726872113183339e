#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "cli/session.h"

namespace prelight::cli {

/// The moment of an animation that is shown.
struct PoseOptions {
  std::optional<double> at;  ///< seconds; none: the rest pose
  std::string animation;     ///< name or number; empty: the one that was baked, else the first
};

/// --at and --animation.
void addPoseOptions(CLI::App& app, PoseOptions& options);

/// Moves a scene to the moment, and replaces its bake by what the keys say of it. What the file carries of
/// the rest pose alone does not hold then and is left out. Does nothing without a moment. Throws UsageError
/// for an animation that the scene lacks.
void poseScene(Session& session, const PoseOptions& options, LoadedScene& loaded, Bake& bake);

}  // namespace prelight::cli
