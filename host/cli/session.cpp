#include "cli/session.h"

#include <utility>

#include "device/program_cache.h"
#include "io/baked_file.h"
#include "prelight/draw.h"
#include "refine/refine_meshes.h"

namespace prelight::cli {

void Session::warn(const std::string& warning) {
  warnings_.push_back(warning);
  progress_.clear();
  console_.warn({warning});
}

LoadedScene Session::load(const std::filesystem::path& path, LoadOptions options, bool tellOddities) {
  options.allowOutside = context_.options.allowOutside;
  const ReadOptions read{options.allowOutside, tellOddities};
  LoadedScene loaded = openScene([&](Warnings& odd) { return readGltf(path, odd, read); }, options, steps_);
  console_.warn(loaded.warnings);
  warnings_.insert(warnings_.end(), loaded.warnings.begin(), loaded.warnings.end());
  return loaded;
}

BakeRun Session::bake(const LoadedScene& loaded, const BakeRequest& request,
                      const DeviceOptions& deviceOptions, KeptState* state, const StateKey& key) {
  std::optional<Device> device;
  const auto open = [&]() -> const Device& { return device.emplace(Device::open(deviceOptions)); };
  const auto keyed = [&](StateKey whole) -> Progress& {
    whole.insert(whole.end(), key.begin(), key.end());
    return state != nullptr ? state->begin(whole, progress_) : progress_;
  };
  BakeRun run;
  times_.measureProcessor("bake", [&] {
    run = runBake({loaded.path, *loaded.document, loaded.scene, loaded.compiled}, request,
                  {steps_, open, keyed, openGlHemispheres()});
  });
  progress_.clear();
  for (const auto& [stage, seconds] : run.report.stageSeconds) times_.add(stage, seconds);
  return run;
}

RefinedScene Session::refine(LoadedScene loaded, const RefineRequest& request,
                             const DeviceOptions& deviceOptions) {
  std::optional<Device> device;
  RefinedScene refined;
  times_.measureProcessor("refine", [&] {
    refined = refineScene(
        std::move(loaded), request,
        [&]() -> const Device& { return device.emplace(Device::open(deviceOptions)); }, steps_);
  });
  progress_.clear();
  console_.line("refined", textOf(refined.report));
  return refined;
}

DeviceOptions Session::deviceOptions() {
  if (const std::optional<std::string> refusal = refusalOfCache(ProgramCache::defaultFolder());
      refusal && !warnedOfCache_) {
    warn(*refusal + ": no kernels are read from there or kept");
    warnedOfCache_ = true;
  }
  DeviceOptions deviceOptions;
  deviceOptions.selector = context_.options.device;
  deviceOptions.progress = &deviceProgress_;
  return deviceOptions;
}

Bake requireBake(Session& session, const LoadedScene& loaded) {
  std::optional<Bake> bake = readBake(*loaded.document, loaded.compiled);
  session.progress().check();
  if (!bake) throw InputError(loaded.path.string(), "carries no bake", "make one with prelight bake");
  return std::move(*bake);
}

}  // namespace prelight::cli
