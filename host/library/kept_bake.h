#pragma once

#include <functional>

#include "base/state_file.h"
#include "prelight/bake.h"

namespace prelight {

/// A step that adds to a bake, on a device, with a progress that keeps unfinished work.
using AddToBake = std::function<void(BakeResult& baked, const Device& device, Progress& progress)>;

/// Does bake() and then `add` in one run with one checkpoint. `key` holds what the state depends on in
/// addition to the key of bake().
BakeResult bakeKeeping(const LoadedScene& scene, const BakeRequest& request, const BakeOptions& options,
                       const StateKey& key = {}, const AddToBake& add = {});

}  // namespace prelight
