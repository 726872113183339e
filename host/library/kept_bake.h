#pragma once

#include <functional>

#include "base/state_file.h"
#include "prelight/bake.h"

namespace prelight {

/// Adds to a bake, on a device, with a progress that keeps what takes long.
using AddToBake = std::function<void(BakeResult& baked, const Device& device, Progress& progress)>;

/// Does as bake(), and then what `add` does, in one run that a checkpoint keeps. `key`: what the state
/// depends on besides what that of bake() does.
BakeResult bakeKeeping(const LoadedScene& scene, const BakeRequest& request, const BakeOptions& options,
                       const StateKey& key = {}, const AddToBake& add = {});

}  // namespace prelight
