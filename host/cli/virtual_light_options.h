#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "cli/drawn_global_illumination.h"
#include "integrators/live_virtual_lights.h"

namespace prelight::cli {

class Session;
struct PictureOptions;
struct ShadedScene;

/// The options of instant shading.
void addVirtualLightOptions(CLI::App& app, VirtualLightOptions& options);

/// Virtual lights that follow what moves.
struct FollowingVirtualLights : FollowedScene {
  std::optional<LiveVirtualLights> lights;
};

/// Under the picture's lights.
std::unique_ptr<FollowingVirtualLights> virtualLights(Session& session, const PictureOptions& options,
                                                      const ShadedScene& shaded);

}  // namespace prelight::cli
