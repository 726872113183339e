#pragma once

#include <optional>
#include <vector>

#include "gpu/transport_scene.h"
#include "prelight/device.h"
#include "prelight/load.h"
#include "prelight/progress.h"

namespace prelight {

/// Device and progress of a library call: those that it was given, or defaults.
class LibraryCall {
 public:
  explicit LibraryCall(const Device* device, Progress* progress = nullptr);
  LibraryCall(const LibraryCall&) = delete;
  LibraryCall& operator=(const LibraryCall&) = delete;

  /// Returns the device, which is opened at the first call if none was given.
  const Device& device();
  Progress& progress() { return *progress_; }

 private:
  std::optional<Device> opened_;
  Progress ignored_;
  const Device* device_;
  Progress* progress_;
};

/// Returns a scene with the lights of the options. The arguments must outlive it.
LitScene litScene(const LoadedScene& scene, const std::optional<std::vector<Light>>& lights,
                  const Environment* sky, double skyRotation);

}  // namespace prelight
