#include "library/run_bake.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "bake/drawn_hemispheres.h"
#include "bake/make_plan.h"
#include "base/machine_memory.h"
#include "library/open_scene.h"
#include "library/refine_scene.h"
#include "plan/cast_orders.h"
#include "scene/dark_lamps.h"
#include "scene/gltf/charts.h"
#include "scene/light_sources.h"

namespace prelight {

namespace {

/// Throws if the plan needs more memory than allowed, before anything is allocated.
void requireMemory(const Plan& plan, const BakeRequest& request) {
  const std::uint64_t needed = plan.hostBytes + plan.deviceBytes, machine = machineMemory();
  if (request.maxMemory && needed > *request.maxMemory)
    throw Error(ExitCode::OutOfMemory, "BakeRequest::maxMemory",
                fmt::format("the bake takes at least about {} MB, {} MB are allowed", (needed >> 20) + 1,
                            *request.maxMemory >> 20),
                "allow that much, or ask for less at a time");
  if (needed > machine)
    throw Error(ExitCode::OutOfMemory, "memory",
                fmt::format("the bake takes at least about {} MB, there are {} MB", (needed >> 20) + 1,
                            machine >> 20),
                "ask for less at a time");
}

Plan planOf(const BakeScene& scene, const BakeRequest& request) {
  Plan plan = makePlan(scene.scene, scene.compiled, request);
  if (request.lightMap && !plan.runs(Pass::LightMap))
    throw InputError(scene.path.string(), "no surface reflects diffusely, so none needs a light map",
                     "give materials that are not metal a metallicFactor of 0, which is 1 where a file has "
                     "none; or leave out BakeRequest::lightMap");
  requireMemory(plan, request);
  return plan;
}

Charts chartsOf(const BakeScene& scene, int size, BakeReport& report) {
  Charts charts = makeCharts(scene.scene, scene.compiled, size);
  if (charts.charts.empty())
    throw InputError(scene.path.string(),
                     fmt::format("no primitive has texture coordinates for a light map: {}",
                                 fmt::join(charts.leftOut, "; ")),
                     "call unwrap(), which writes such coordinates, or leave out ChartTransferRequest::size");
  if (!charts.leftOut.empty())
    report.notes.push_back(fmt::format("texels: left out {}", fmt::join(charts.leftOut, "; ")));
  return charts;
}

/// Returns what draws the views of receivers, or nullptr if rays are traced.
std::unique_ptr<HemisphereRenderer> rendererOf(const BakeScene& scene, const BakeRequest& request,
                                               const BakeMeans& means) {
  if (request.visibility != Visibility::Raster) return nullptr;
  if (!means.hemispheres) throw rendererMissing();
  std::unique_ptr<HemisphereRenderer> renderer;
  means.steps.run("opengl", [&] { renderer = means.hemispheres(scene.compiled); });
  return renderer;
}

/// Returns the key of a bake's state.
StateKey keyOf(const BakeScene& scene, const BakeRequest& request, const DeviceInfo& device,
               const HemisphereRenderer* hemispheres) {
  StateKey key = bakeKey(scene.compiled, withChoices(request, scene.compiled), device);
  if (hemispheres != nullptr)
    key.emplace_back("renderer", StateHash().text(hemispheres->description()).result());
  return key;
}

/// Warns where specular transport runs and lamps shine within the scene. Transfer knows light by its
/// direction alone, and glass and mirrors pass on none of theirs.
void warnOfLampsWithin(const CompiledScene& scene, const BakeRequest& request, BakeRun& run) {
  if (!run.plan.runs(Pass::SpecularTransport) || transferOrder(request) == 0) return;
  const std::string lamps = lampsWithin(scene);
  if (lamps.empty()) return;
  run.report.warnings.push_back(
      fmt::format("specular transport carries the light of the sky, but not that of {} within the scene; "
                  "light groups have the latter after a bounce, and a light map with caustics all of it",
                  lamps));
}

}  // namespace

LoadedScene withCharts(LoadedScene scene, const BakeRequest& request, Steps& steps) {
  if (request.chartTransfer.size == 0) return scene;
  return unwrapScene(std::move(scene), request.chartTransfer.size, steps);
}

bool staysAtVertices(const BakeRequest& request, const Bake& carried) {
  return request.castsReceivers() && request.chartTransfer.size == 0 && !carried.chartTransfer &&
         carried.info.refined == 0.0;
}

BakeRun runBake(const BakeScene& scene, const BakeRequest& request, const BakeMeans& means) {
  requireTriangles(scene.path, scene.compiled, "to bake");
  if (!request.anything()) throw UsageError("BakeRequest", "nothing is asked for", "set one of its parts");
  BakeRun run;
  const Device* device = nullptr;
  Charts charts;
  means.steps.run("plan", [&] { run.plan = planOf(scene, request); });
  means.steps.run("device", [&] { device = &means.device(); });
  run.device = device->info();
  if (request.chartTransfer.size > 0)
    means.steps.run("charts", [&] { charts = chartsOf(scene, request.chartTransfer.size, run.report); });
  const std::unique_ptr<HemisphereRenderer> hemispheres = rendererOf(scene, request, means);
  Progress& progress = means.progress(keyOf(scene, request, run.device, hemispheres.get()));
  run.bake = bakeScene(scene.compiled, request, run.plan, *device, progress, run.report, &charts,
                       &scene.scene, hemispheres.get());
  run.report.warnings =
      warningsOfDarkness(scene.scene, scene.compiled, run.bake, request.radiosity.environment.get());
  warnOfLampsWithin(scene.compiled, request, run);
  run.bake.info.moment = scene.scene.moment;
  run.bake.info.variant = scene.scene.variant;
  if (scene.scene.scenes.size() > 1) run.bake.info.scene = scene.scene.chosen;
  return run;
}

namespace {

bool isBlack(const std::vector<glm::vec3>& values) {
  return std::none_of(values.begin(), values.end(), shines);
}

bool isBlack(const std::vector<float>& values) {
  return std::all_of(values.begin(), values.end(), [](float value) { return value == 0.0f; });
}

/// Returns the name of a black part, or nullptr if there is none.
const char* blackPart(const Bake& bake) {
  if (bake.lightMap && isBlack(bake.lightMap->values)) return "the light map";
  if (bake.irradiance && isBlack(*bake.irradiance)) return "the irradiance of vertices";
  if (bake.lightGroups && isBlack(bake.lightGroups->coefficients)) return "the light of the light groups";
  return nullptr;
}

}  // namespace

Warnings warningsOfDarkness(const Scene& scene, const CompiledScene& compiled, const Bake& bake,
                            const Environment* sky) {
  if (!bake.lightMap && !bake.irradiance && !bake.lightGroups) return {};
  if (const char* black = blackPart(bake)) return {darknessWarning(black, compiled, compiled.lights, sky)};
  return scene.sides.shutInLamps;
}

}  // namespace prelight
