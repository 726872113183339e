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

/// The scene to bake in all its forms, and its file.
struct BakeScene {
  const std::filesystem::path& path;  ///< for messages
  const GltfDocument& document;
  const Scene& scene;
  const CompiledScene& compiled;
};

/// Resources of a bake.
struct BakeMeans {
  Steps& steps;
  std::function<const Device&()> device;  ///< called once, after planning
  /// Called with the key of the state; returns the progress of the bake, which has a keeper if the state is
  /// kept.
  std::function<Progress&(const StateKey&)> progress;
};

/// A bake with the plan, report and device that it was made with.
struct BakeRun {
  Plan plan;
  Bake bake;
  BakeReport report;
  DeviceInfo device;
};

/// Plans and bakes. Throws as bake() does (prelight/bake.h).
BakeRun runBake(const BakeScene& scene, const BakeRequest& request, const BakeMeans& means);

}  // namespace prelight
