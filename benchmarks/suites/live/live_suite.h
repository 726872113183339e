#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/run/suite.h"

namespace prelight::benchmarks {

/// Options of the suite `live`; its table says what each means.
struct LiveOptions : RunOptions {
  std::vector<int> updateCells;
  int updateFrames;
  int updateSide;
  std::uint64_t updatePhotons;
  std::vector<std::pair<std::string, std::string>> updateScenes;
  std::vector<std::pair<std::string, std::string>> followingScenes;
  int followingFrames;
  int followingEvery;
  double followingMilliseconds;
  std::uint64_t followingPhotons;
  std::uint32_t followingTexels;
  std::vector<std::string> liveLightRows;
  int liveLightCopies;
  int liveLightHeight;
  std::uint32_t liveLightRays;
  std::uint32_t liveLightTexels;
  std::uint64_t liveLightTruth;
  std::vector<std::uint64_t> liveLightPhotons;

  static const OptionTable<LiveOptions>& table();

  /// Replaces the suite's own values by those of the command line.
  void takeGiven();
};

/// Seconds of frames in which indirect light and caustics follow moving objects, per stage and beside
/// Larsen's thesis (2004, ch. 14); what a moved object affects, what is computed again, and the difference to
/// computing everything again.
void runUpdate(const Device& device, const LiveOptions& options, SuiteRun& run);

/// Error of indirect light, frame by frame, while a node moves and after it has stopped, beside light computed
/// anew and beside the light before the move; processor time until it has settled.
void runFollowing(const Device& device, const LiveOptions& options, SuiteRun& run);

/// Error of pictures of live light and cost of a frame by the number of photons, with and without lamps that
/// are thinned by distance from the viewer. Needs OpenGL.
void runLiveLight(const Device& device, const LiveOptions& options, SuiteRun& run);

std::unique_ptr<Suite> liveSuite();

}  // namespace prelight::benchmarks
