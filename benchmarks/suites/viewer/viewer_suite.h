#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/run/suite.h"

namespace prelight::benchmarks {

/// Options of the suite `viewer`; its table says what each means.
struct ViewerOptions : RunOptions {
  std::vector<std::string> scenes;
  std::vector<std::pair<int, int>> sizes;
  int frames;
  int inputs;
  int order;
  std::uint64_t rays;

  static const OptionTable<ViewerOptions>& table();

  /// Replaces the suite's own values by those that the command line gives.
  void takeGiven();
};

/// Milliseconds of the frames of a window, drawn without a display, by the clock, of all processors and of
/// OpenGL's own timer, of every shading on every scene at every size, while the camera, a light, the sky or a
/// node moves and when nothing does; latency from such an input to the picture; bytes that frames upload.
/// Needs OpenGL.
void runViewer(const Device& device, const ViewerOptions& options, SuiteRun& run);

/// Whether RunOptions::onlyCase leaves it a case.
bool hasViewerCase(const ViewerOptions& options);

std::unique_ptr<Suite> viewerSuite();

}  // namespace prelight::benchmarks
