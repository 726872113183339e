#include "prelight/bake.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>

#include "bake/baker.h"
#include "bake/make_plan.h"
#include "library/file_checkpoint.h"
#include "library/library_call.h"
#include "scene/gltf/charts.h"

namespace prelight {

namespace {

Charts chartsOf(const LoadedScene& scene, int size, BakeReport& report) {
  if (size == 0) return {};
  Charts charts = makeCharts(*scene.document, scene.scene, scene.compiled, size, report.notes);
  if (charts.charts.empty())
    throw InputError(scene.path.string(),
                     fmt::format("no primitive has texture coordinates for a light map: {}",
                                 fmt::join(charts.leftOut, "; ")),
                     "unwrap the meshes into TEXCOORD_1, within 0..1 and without overlaps, or leave "
                     "ChartTransferRequest::size 0");
  if (!charts.leftOut.empty())
    report.notes.push_back(fmt::format("texels: left out {}", fmt::join(charts.leftOut, "; ")));
  return charts;
}

Plan planOf(const LoadedScene& scene, const BakeRequest& request) {
  requireTriangles(scene, "to bake");
  if (!request.anything()) throw UsageError("BakeRequest", "nothing is asked for", "set one of its parts");
  Plan plan = makePlan(scene.scene, scene.compiled, request);
  if (request.lightMap && !plan.runs(Pass::LightMap))
    throw InputError(scene.path.string(), "no surface reflects diffusely, so none needs a light map");
  return plan;
}

}  // namespace

Plan plan(const LoadedScene& scene, const BakeRequest& request) {
  return makePlan(scene.scene, scene.compiled, request);
}

BakeResult bake(const LoadedScene& scene, const BakeRequest& request, const BakeOptions& options) {
  const Plan plan = planOf(scene, request);
  LibraryCall call(options.device, options.progress);
  BakeResult result;
  const Charts charts = chartsOf(scene, request.chartTransfer.size, result.report);
  std::optional<FileCheckpoint> checkpoint;
  if (!options.checkpoint.empty())
    checkpoint.emplace(options.checkpoint, bakeKey(scene.compiled, request, call.device().info()));
  result.bake = bakeScene(scene.compiled, request, plan, call.device(), call.progress(), result.report,
                          checkpoint ? &*checkpoint : nullptr, &charts, &scene.scene);
  if (!checkpoint) return result;
  checkpoint->remove();
  if (!checkpoint->failure().empty())
    result.report.notes.push_back("the state of the bake could not be kept: " + checkpoint->failure());
  return result;
}

}  // namespace prelight
