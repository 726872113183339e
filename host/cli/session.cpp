#include "cli/session.h"

#include <fmt/format.h>

#include "device/cache_folder.h"
#include "device/program_cache.h"
#include "scene/gltf/loader.h"

namespace prelight::cli {

void Session::warn(const std::string& warning) {
  warnings_.push_back(warning);
  progress_.clear();
  console_.warn({warning});
}

LoadedScene Session::load(const std::filesystem::path& path) {
  LoadedScene loaded;
  loaded.path = path;
  Warnings found;
  times_.measure("load", [&] {
    loaded.document = readGltf(path, found, {context_.options.allowOutside});
    progress_.check();
    loaded.scene = loadScene(loaded.document, found);
  });
  progress_.check();
  times_.measure("compile", [&] { loaded.compiled = compileScene(loaded.scene, found); });
  progress_.check();
  console_.warn(found);
  warnings_.insert(warnings_.end(), found.begin(), found.end());
  return loaded;
}

BakeRun Session::bake(const LoadedScene& loaded, const BakeRequest& request,
                      const DeviceOptions& deviceOptions, BakeStateFile* state) {
  requireTriangles(loaded);
  BakeRun run;
  run.plan = times_.measure("plan", [&] { return makePlan(loaded.scene, loaded.compiled, request); });
  if (request.lightMap && !run.plan.runs(Pass::LightMap))
    throw InputError(loaded.path.string(), "no surface reflects diffusely, so none needs a light map",
                     "leave out --lightmap");
  const Device device = times_.measure("device", [&] { return Device::open(deviceOptions); });
  run.device = device.info();
  const Charts charts = chartsOf(loaded, request.texels.size);
  if (state != nullptr) state->setKey(bakeKey(loaded.compiled, request, run.device));
  times_.measureProcessor("bake", [&] {
    run.bake = bakeScene(loaded.compiled, request, run.plan, device, progress_, run.report, state, &charts,
                         &loaded.scene);
  });
  progress_.clear();
  if (!charts.leftOut.empty())
    run.report.notes.push_back(fmt::format("texels: left out {}", fmt::join(charts.leftOut, "; ")));
  for (const auto& [stage, seconds] : run.report.stageSeconds) times_.add(stage, seconds);
  return run;
}

Charts Session::chartsOf(const LoadedScene& loaded, int size) {
  if (size == 0) return {};
  Warnings odd;
  Charts charts = times_.measure(
      "charts", [&] { return makeCharts(loaded.document, loaded.scene, loaded.compiled, size, odd); });
  for (const std::string& warning : odd) warn(warning);
  if (charts.charts.empty())
    throw InputError(loaded.path.string(),
                     fmt::format("no primitive has texture coordinates for a light map: {}",
                                 fmt::join(charts.leftOut, "; ")),
                     "unwrap the meshes into TEXCOORD_1, within 0..1 and without overlaps, or leave out "
                     "--texels");
  constexpr std::size_t shown = 4;
  for (std::size_t i = 0; i < std::min(shown, charts.leftOut.size()); ++i)
    warn("--texels: left out " + charts.leftOut[i]);
  if (charts.leftOut.size() > shown)
    warn(fmt::format("--texels: {} more primitives are left out", charts.leftOut.size() - shown));
  return charts;
}

DeviceOptions Session::deviceOptions() {
  if (const std::optional<std::string> refusal = refusalOfCache(ProgramCache::defaultFolder());
      refusal && !warnedOfCache_) {
    warn(*refusal + ": the kernels there are not used, and none are kept");
    warnedOfCache_ = true;
  }
  DeviceOptions deviceOptions;
  deviceOptions.selector = context_.options.device;
  return deviceOptions;
}

void requireTriangles(const LoadedScene& loaded) {
  if (loaded.compiled.triangleCount() > 0) return;
  const std::string dropped = loaded.compiled.droppedTriangles == 0
                                  ? ""
                                  : fmt::format(", only {} of zero area", loaded.compiled.droppedTriangles);
  throw InputError(loaded.path.string(),
                   fmt::format("the scene has no triangles{}; there is nothing to bake", dropped),
                   "export meshes along with it, or look at it with prelight info");
}

}  // namespace prelight::cli
