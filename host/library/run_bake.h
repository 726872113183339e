#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "bake/baker.h"
#include "library/open_scene.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/device.h"
#include "prelight/picture.h"
#include "prelight/plan.h"
#include "prelight/scene.h"
#include "prelight/techniques.h"
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
  HemisphereRendererMaker hemispheres = {};  ///< called for Visibility::Raster
};

/// A bake with the plan, report and device that it was made with.
struct BakeRun {
  Plan plan;
  Bake bake;
  BakeReport report;
  DeviceInfo device;
};

/// Returns a scene whose primitives have coordinates for the texels that a request asks for, if it does:
/// unwrapScene().
LoadedScene withCharts(LoadedScene scene, const BakeRequest& request, Steps& steps);

/// Returns whether what a request asks for, or a bake already holds, lies at the vertices of a mesh that was
/// not refined, and nowhere else.
bool staysAtVertices(const BakeRequest& request, const Bake& carried);

/// Plans and bakes. Throws as bake() does (prelight/bake.h).
BakeRun runBake(const BakeScene& scene, const BakeRequest& request, const BakeMeans& means);

/// Returns warnings about probable mistakes in the baked light of a scene's own lamps: a part that is
/// entirely black, with the reasons, or else lamps that are enclosed by surfaces. Returns none for bakes
/// without such light. `sky` is the one that was baked with; may be nullptr.
Warnings warningsOfDarkness(const Scene& scene, const CompiledScene& compiled, const Bake& bake,
                            const Environment* sky);

}  // namespace prelight
