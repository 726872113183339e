#pragma once

#include <filesystem>
#include <functional>

#include "bake/baker.h"
#include "library/steps.h"
#include "prelight/bake.h"
#include "prelight/device.h"
#include "prelight/plan.h"
#include "prelight/request.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// What is baked: a scene in its forms, and the file that it is of.
struct BakeScene {
  const std::filesystem::path& path;  ///< for messages
  const GltfDocument& document;
  const Scene& scene;
  const CompiledScene& compiled;
};

/// What a bake works with.
struct BakeMeans {
  Steps& steps;
  std::function<const Device&()> device;  ///< asked for once, when the plan stands
  /// Gets the key that a state must have, and returns the progress that the bake reports to: one with a
  /// keeper, where its state is kept.
  std::function<Progress&(const StateKey&)> progress;
};

/// A bake with all that is known of how it was made.
struct BakeRun {
  Plan plan;
  Bake bake;
  BakeReport report;
  DeviceInfo device;
};

/// Plans and bakes; throws as bake() (prelight/bake.h).
BakeRun runBake(const BakeScene& scene, const BakeRequest& request, const BakeMeans& means);

}  // namespace prelight
