#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "library/open_scene.h"
#include "library/refine_scene.h"
#include "library/run_bake.h"
#include "pictures/session/bake_settings.h"
#include "prelight/device.h"
#include "prelight/progress.h"

namespace prelight::pictures {

/// The caller's side of work on pictures, a command or a module of another language: it loads and bakes in
/// its own way, names the device, and is told what was decided.
class DrawingSession {
 public:
  /// `device`: the caller's, which outlives the session; nullptr: one is opened when it is needed.
  explicit DrawingSession(const Device* device = nullptr) : device_(device, [](const Device*) {}) {}
  virtual ~DrawingSession() = default;

  /// Tells of something that was decided without being asked for.
  virtual void note(const std::string& text) = 0;
  virtual void warn(const std::string& warning) = 0;

  virtual Progress& progress() = 0;

  /// Throws as openScene().
  virtual LoadedScene load(const std::filesystem::path& path, const LoadOptions& options) = 0;

  /// Throws as runBake().
  virtual BakeRun bake(const LoadedScene& loaded, const BakeRequest& request,
                       const DeviceOptions& deviceOptions) = 0;

  /// Throws as refineScene().
  virtual RefinedScene refine(LoadedScene loaded, const RefineRequest& request,
                              const DeviceOptions& deviceOptions) = 0;

  /// Throws as withCharts().
  LoadedScene withCharts(LoadedScene loaded, const BakeRequest& request) {
    Steps steps(progress());
    return prelight::withCharts(std::move(loaded), request, steps);
  }

  virtual DeviceOptions deviceOptions() = 0;

  /// Opens a device of options of deviceOptions(), or returns the one that the caller has or that was opened
  /// before. It may be called from another thread.
  std::shared_ptr<const Device> openDevice(const DeviceOptions& options) {
    const std::lock_guard lock(opening_);
    if (device_ == nullptr) device_ = std::make_shared<const Device>(Device::open(options));
    return device_;
  }

  /// The device's options with those of kernels that a bake is asked for with.
  DeviceOptions deviceOptions(const BakeSettings& bake) {
    DeviceOptions options = deviceOptions();
    bake.addTo(options);
    return options;
  }

  /// Runs `work` as a stage of this name, whose time the session may keep, and returns its result.
  template <typename Work>
  std::invoke_result_t<Work> measure(const char* stage, Work&& work) {
    using Result = std::invoke_result_t<Work>;
    if constexpr (std::is_void_v<Result>) {
      runStage(stage, std::forward<Work>(work));
    } else {
      std::optional<Result> result;
      runStage(stage, [&] { result.emplace(work()); });
      return *std::move(result);
    }
  }

 private:
  virtual void runStage(const char* stage, const std::function<void()>& work) = 0;

  std::mutex opening_;
  std::shared_ptr<const Device> device_;  ///< nullptr until it is needed
};

/// Throws InputError for a scene without triangles to bake.
inline void requireTriangles(const LoadedScene& loaded) {
  prelight::requireTriangles(loaded.path, loaded.compiled, "to bake");
}

}  // namespace prelight::pictures
