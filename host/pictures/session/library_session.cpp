#include "pictures/session/library_session.h"

#include <utility>

#include "prelight/draw.h"

namespace prelight::pictures {

LibrarySession::LibrarySession(const DrawOptions& options)
    : DrawingSession(options.device), progress_(options.progress != nullptr ? options.progress : &ignored_) {}

LoadedScene LibrarySession::load(const std::filesystem::path& path, const LoadOptions& options) {
  Steps steps(*progress_);
  LoadedScene loaded =
      openScene([&](Warnings& odd) { return readGltf(path, odd, {.allowOutside = options.allowOutside}); },
                options, steps);
  warnings_.insert(warnings_.end(), loaded.warnings.begin(), loaded.warnings.end());
  return loaded;
}

BakeRun LibrarySession::bake(const LoadedScene& loaded, const BakeRequest& request,
                             const DeviceOptions& deviceOptions) {
  Steps steps(*progress_);
  const std::shared_ptr<const Device> device = openDevice(deviceOptions);
  return runBake({loaded.path, *loaded.document, loaded.scene, loaded.compiled}, request,
                 {steps, [&]() -> const Device& { return *device; },
                  [&](const StateKey&) -> Progress& { return *progress_; }, openGlHemispheres()});
}

RefinedScene LibrarySession::refine(LoadedScene loaded, const RefineRequest& request,
                                    const DeviceOptions& deviceOptions) {
  Steps steps(*progress_);
  const std::shared_ptr<const Device> device = openDevice(deviceOptions);
  return refineScene(
      std::move(loaded), request, [&]() -> const Device& { return *device; }, steps);
}

void LibrarySession::runStage(const char* stage, const std::function<void()>& work) {
  progress_->report(stage, 0.0);
  work();
  progress_->check();
}

}  // namespace prelight::pictures
