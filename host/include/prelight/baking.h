#pragma once

#include <filesystem>

#include "prelight/bake.h"
#include "prelight/request.h"

namespace prelight {

class Device;
class Progress;
struct LoadedScene;

/// What a bake works with besides the scene and the request.
struct BakeOptions {
  const Device* device = nullptr;  ///< nullptr: the default one, opened for the call
  Progress* progress = nullptr;    ///< nullptr: nobody is told, nothing interrupts
  /// File in which the state of the bake is kept, at least every half a minute and when it is interrupted,
  /// and from which an interrupted bake of the same scene, request, seed and device goes on. It is gone when
  /// the bake is done. Empty: no state is kept.
  std::filesystem::path checkpoint = {};
};

struct BakeResult {
  Bake bake;
  BakeReport report;
};

/// Bakes what is asked for. Values are finite for every vertex. The same scene, request and seed give the
/// same bytes on the same device, however often the bake was interrupted, unless it bakes against time.
/// Throws
///
///   UsageError   a request that makes no sense, a checkpoint of another bake
///   InputError   a scene without triangles, or without texture coordinates or surfaces for what is asked
///   Error        the device fails (RuntimeFailure), none is there (NoDevice), memory ends (OutOfMemory)
///   Interrupted  `progress` asks to stop
BakeResult bake(const LoadedScene& scene, const BakeRequest& request, const BakeOptions& options = {});

/// Which passes bake() would run, which it would skip and why, and how much memory they would take.
Plan plan(const LoadedScene& scene, const BakeRequest& request);

}  // namespace prelight
