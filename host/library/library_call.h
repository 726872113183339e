#pragma once

#include <optional>
#include <vector>

#include "gpu/transport_scene.h"
#include "prelight/device.h"
#include "prelight/load.h"
#include "prelight/progress.h"

namespace prelight {

/// What a call of the library works with: the device and the progress that it was given, or those that it
/// gets where it was given none.
class LibraryCall {
 public:
  explicit LibraryCall(const Device* device, Progress* progress = nullptr);
  LibraryCall(const LibraryCall&) = delete;
  LibraryCall& operator=(const LibraryCall&) = delete;

  /// Opens it when it is asked for first.
  const Device& device();
  Progress& progress() { return *progress_; }

 private:
  std::optional<Device> opened_;
  Progress ignored_;
  const Device* device_;
  Progress* progress_;
};

/// A scene with the lights that options ask for. The arguments outlive it.
LitScene litScene(const LoadedScene& scene, const std::optional<std::vector<Light>>& lights,
                  const Environment* sky, double skyRotation);

}  // namespace prelight
