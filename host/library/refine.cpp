#include "prelight/refine.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "charts/chart_coords.h"
#include "gpu/tracer.h"
#include "io/baked_strip.h"
#include "io/values/value_reader.h"
#include "library/library_call.h"
#include "library/open_scene.h"
#include "library/refine_scene.h"
#include "prelight/options.h"
#include "prelight/techniques.h"
#include "refine/refine_meshes.h"
#include "refine/refined_document.h"
#include "scene/gltf/document_references.h"

namespace prelight {

namespace {

/// Members of a scene that survive when its document is read anew.
struct KeptOfScene {
  LoadOptions options;
  Warnings warnings;
  std::shared_ptr<const Environment> sky;
  std::vector<Material> measured;  ///< all materials, if reflection of any was measured; else empty
  double refined = 0.0;
};

KeptOfScene keptOf(const LoadedScene& scene) {
  KeptOfScene kept{{}, scene.warnings, scene.sky, {}, scene.refined};
  kept.options.variant = scene.scene.variant;
  if (scene.scene.moment) {
    kept.options.at = scene.scene.moment->seconds;
    kept.options.animation = std::to_string(scene.scene.moment->animation);
  }
  // Measured reflection is not in the file.
  const std::vector<Material>& materials = scene.scene.materials;
  if (std::any_of(materials.begin(), materials.end(),
                  [](const Material& material) { return material.measured != nullptr; }))
    kept.measured = materials;
  return kept;
}

/// Opens a changed document as the scene was opened that it comes from, without its bake.
LoadedScene reopened(KeptOfScene kept, GltfDocument document, Steps& steps) {
  stripBake(document);
  dropExtensionName(document.json, transferExtensionName);
  removeUnused(document);
  LoadedScene opened = openScene([&](Warnings&) { return std::move(document); }, kept.options, steps);
  opened.warnings = std::move(kept.warnings);
  opened.sky = std::move(kept.sky);
  opened.refined = kept.refined;
  if (kept.measured.empty()) return opened;
  opened.scene.materials = std::move(kept.measured);
  Warnings said;
  opened.compiled = compileScene(opened.scene, said);
  return opened;
}

/// Returns the scene's document with refined meshes; none if nothing changes.
std::optional<GltfDocument> refinedDocument(const LoadedScene& scene, const RefineRequest& request,
                                            const std::function<const Device&()>& device, Steps& steps,
                                            RefineReport& report) {
  requireRanges(request);
  if (!request || scene.compiled.triangleCount() == 0) return std::nullopt;
  std::vector<RefinedPrimitive> primitives;
  steps.run("refine", [&] {
    Tracer tracer(scene.compiled, device(), BvhLayout::Automatic, BuildQuality::Balanced);
    primitives = refineMeshes(scene.scene, scene.compiled, tracer, request, steps.progress(), report);
  });
  if (primitives.empty()) return std::nullopt;
  GltfDocument document = *scene.document;
  writeRefined(primitives, document);
  return document;
}

/// Returns the scene's document with charts of this size; none if nothing changes.
std::optional<GltfDocument> unwrappedDocument(const LoadedScene& scene, int size, Steps& steps) {
  if (scene.compiled.triangleCount() == 0) return std::nullopt;
  std::optional<GltfDocument> document;
  steps.run("unwrap", [&] {
    document = withChartCoords(scene.scene, scene.compiled, size, *scene.document, steps.progress());
  });
  return document;
}

/// Frees a scene before its document is read anew.
KeptOfScene takeKept(LoadedScene& scene) {
  KeptOfScene kept = keptOf(scene);
  scene = {};
  return kept;
}

/// A scene is refined as asked for even if nothing had to change.
double errorAfter(const RefineRequest& request, double before) { return request ? request.error : before; }

}  // namespace

RefinedScene refineScene(LoadedScene scene, const RefineRequest& request,
                         const std::function<const Device&()>& device, Steps& steps) {
  RefinedScene refined;
  std::optional<GltfDocument> document = refinedDocument(scene, request, device, steps, refined.report);
  scene.refined = errorAfter(request, scene.refined);
  refined.scene = document ? reopened(takeKept(scene), *std::move(document), steps) : std::move(scene);
  return refined;
}

LoadedScene unwrapScene(LoadedScene scene, int size, Steps& steps) {
  std::optional<GltfDocument> document = unwrappedDocument(scene, size, steps);
  if (!document) return scene;
  return reopened(takeKept(scene), *std::move(document), steps);
}

LoadedScene unwrap(const LoadedScene& scene, int size, Progress* progress) {
  if (size < 1 || size > BakeRequest::maxChartSize)
    throw UsageError("unwrap()", fmt::format("got a size of {} texels, expected 1 to {}", size,
                                             BakeRequest::maxChartSize));
  Progress ignored;
  Steps steps(progress != nullptr ? *progress : ignored);
  std::optional<GltfDocument> document = unwrappedDocument(scene, size, steps);
  if (!document) return scene;
  return reopened(keptOf(scene), *std::move(document), steps);
}

RefinedScene refine(const LoadedScene& scene, const RefineRequest& request, const Device* device,
                    Progress* progress) {
  LibraryCall call(device, progress);
  Steps steps(call.progress());
  RefinedScene refined;
  std::optional<GltfDocument> document = refinedDocument(
      scene, request, [&]() -> const Device& { return call.device(); }, steps, refined.report);
  refined.scene = document ? reopened(keptOf(scene), *std::move(document), steps) : scene;
  refined.scene.refined = errorAfter(request, scene.refined);
  return refined;
}

}  // namespace prelight
