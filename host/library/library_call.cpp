#include "library/library_call.h"

#include <fmt/format.h>

#include "prelight/error.h"

namespace prelight {

LibraryCall::LibraryCall(const Device* device, Progress* progress)
    : device_(device), progress_(progress != nullptr ? progress : &ignored_) {}

const Device& LibraryCall::device() {
  if (device_ == nullptr) device_ = &opened_.emplace(Device::open({.progress = progress_}));
  return *device_;
}

void requireBetween(const char* field, double value, double least, double most) {
  if (value >= least && value <= most) return;  // false for NaN
  throw UsageError(field, fmt::format("got {:g}, expected {:g} to {:g}", value, least, most));
}

LitScene litScene(const LoadedScene& scene, const std::optional<std::vector<Light>>& lights,
                  const Environment* sky, double skyRotation) {
  return {scene.compiled, scene.scene.images, lights.value_or(scene.scene.lights), sky, skyRotation};
}

}  // namespace prelight
