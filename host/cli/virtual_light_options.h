#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "integrators/live_virtual_lights.h"
#include "prelight/device.h"

namespace prelight::cli {

class Session;
struct PictureOptions;
struct ShadedScene;

/// The options of instant shading.
void addVirtualLightOptions(CLI::App& app, VirtualLightOptions& options);

/// Virtual lights that follow what moves, and what they refer to.
struct FollowingVirtualLights {
  std::optional<Environment> sky;
  std::optional<Device> device;
  std::optional<LiveVirtualLights> lights;
};

/// Under the picture's lights.
std::unique_ptr<FollowingVirtualLights> virtualLights(Session& session, const PictureOptions& options,
                                                      const ShadedScene& shaded);

}  // namespace prelight::cli
