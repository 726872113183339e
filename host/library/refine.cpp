#include "prelight/refine.h"

#include <algorithm>
#include <string>
#include <utility>

#include "charts/chart_coords.h"
#include "gpu/tracer.h"
#include "io/baked_strip.h"
#include "io/values/value_reader.h"
#include "library/library_call.h"
#include "library/open_scene.h"
#include "library/refine_scene.h"
#include "prelight/options.h"
#include "refine/refine_meshes.h"
#include "refine/refined_document.h"

namespace prelight {

namespace {

/// Opens the refined document as the scene was opened that it comes from.
LoadedScene reopened(const LoadedScene& scene, GltfDocument document, Steps& steps) {
  LoadOptions options;
  options.variant = scene.scene.variant;
  if (scene.scene.moment) {
    options.at = scene.scene.moment->seconds;
    options.animation = std::to_string(scene.scene.moment->animation);
  }
  LoadedScene opened = openScene([&](Warnings&) { return std::move(document); }, options, steps);
  opened.warnings = scene.warnings;
  opened.sky = scene.sky;
  // Measured reflection is not in the file.
  const auto isMeasured = [](const Material& material) { return material.measured != nullptr; };
  if (!std::any_of(scene.scene.materials.begin(), scene.scene.materials.end(), isMeasured)) return opened;
  opened.scene.materials = scene.scene.materials;
  Warnings said;
  opened.compiled = compileScene(opened.scene, said);
  return opened;
}

}  // namespace

RefinedScene refineScene(const LoadedScene& scene, const RefineRequest& request,
                         const std::function<const Device&()>& device, Steps& steps) {
  requireRanges(request);
  RefinedScene refined{scene, {}};
  if (!request || scene.compiled.triangleCount() == 0) return refined;
  std::vector<RefinedPrimitive> primitives;
  steps.run("refine", [&] {
    Tracer tracer(scene.compiled, device(), BvhLayout::Automatic, BuildQuality::Balanced);
    primitives = refineMeshes(scene.scene, scene.compiled, tracer, request, steps.progress(), refined.report);
  });
  if (primitives.empty()) return refined;
  GltfDocument document = *scene.document;
  stripBake(document);
  dropExtensionName(document.json, transferExtensionName);
  writeRefined(primitives, document);
  refined.scene = reopened(scene, std::move(document), steps);
  return refined;
}

LoadedScene unwrapScene(const LoadedScene& scene, int size, Steps& steps) {
  if (size <= 0 || scene.compiled.triangleCount() == 0) return scene;
  GltfDocument document = *scene.document;
  std::size_t changed = 0;
  steps.run("unwrap", [&] { changed = writeChartCoords(scene.scene, scene.compiled, size, document); });
  if (changed == 0) return scene;
  stripBake(document);
  dropExtensionName(document.json, transferExtensionName);
  return reopened(scene, std::move(document), steps);
}

LoadedScene unwrap(const LoadedScene& scene, int size, Progress* progress) {
  Progress ignored;
  Steps steps(progress != nullptr ? *progress : ignored);
  return unwrapScene(scene, size, steps);
}

RefinedScene refine(const LoadedScene& scene, const RefineRequest& request, const Device* device,
                    Progress* progress) {
  LibraryCall call(device, progress);
  Steps steps(call.progress());
  return refineScene(
      scene, request, [&]() -> const Device& { return call.device(); }, steps);
}

}  // namespace prelight
