#pragma once

#include "base/state_file.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/device.h"
#include "prelight/plan.h"
#include "prelight/progress.h"
#include "scene/gltf/charts.h"

namespace prelight {

/// What a bake's state depends on: scene, options, seed and device.
StateKey bakeKey(const CompiledScene& scene, const BakeRequest& request, const DeviceInfo& device);

/// Bakes what the plan says. Values are finite for every vertex, also for those that no triangle uses.
/// Same scene, request and seed give the same bytes on the same device, whatever the thread count.
/// However often it was interrupted and continued in between, too, unless it bakes against time: where the
/// progress has a keeper, it keeps the bake's parts. Transfer of texels is made of `charts`, and a light map
/// of `source`, whose scene it is; without any, none are. Throws Error (a scene without triangles, device
/// failure, out of memory) and Interrupted.
Bake bakeScene(const CompiledScene& scene, const BakeRequest& request, const Plan& plan, const Device& device,
               Progress& progress, BakeReport& report, const Charts* charts = nullptr,
               const Scene* source = nullptr);

}  // namespace prelight
