#pragma once

#include "base/state_file.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/device.h"
#include "prelight/plan.h"
#include "prelight/progress.h"
#include "scene/gltf/charts.h"

namespace prelight {

/// Key of a bake's state: scene, options, seed and device.
StateKey bakeKey(const CompiledScene& scene, const BakeRequest& request, const DeviceInfo& device);

/// Bakes what the plan says. Values are finite for every vertex, including those that no triangle uses. The
/// bytes depend on scene, request, seed and device alone, not on the thread count, nor (unless the bake has a
/// time limit) on interruptions: where the progress has a keeper, it keeps the bake's parts. `charts` are
/// needed for transfer per texel and `source`, the scene before it was compiled, for a light map; without
/// them these are not baked; `hemispheres` draw for Visibility::Raster. Throws UsageError where these are
/// missing, Error (a scene without triangles, device failure, out of memory) and
/// Interrupted.
Bake bakeScene(const CompiledScene& scene, const BakeRequest& request, const Plan& plan, const Device& device,
               Progress& progress, BakeReport& report, const Charts* charts = nullptr,
               const Scene* source = nullptr, HemisphereRenderer* hemispheres = nullptr);

}  // namespace prelight
