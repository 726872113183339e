#include "library/library_call.h"

namespace prelight {

LibraryCall::LibraryCall(const Device* device, Progress* progress)
    : device_(device), progress_(progress != nullptr ? progress : &ignored_) {}

const Device& LibraryCall::device() {
  if (device_ == nullptr) device_ = &opened_.emplace(Device::open({.progress = progress_}));
  return *device_;
}

LitScene litScene(const LoadedScene& scene, const std::optional<std::vector<Light>>& lights,
                  const Environment* sky, double skyRotation) {
  return {scene.compiled, scene.scene.images, lights.value_or(scene.scene.lights), sky, skyRotation};
}

}  // namespace prelight
