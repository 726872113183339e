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

  /// Replaces the suite's own values by those of the command line.
  void takeGiven();
};

/// Milliseconds of frames of a window without display, as wall time, processor time and by OpenGL's timer,
/// per shading, scene and size, while the camera, a light, the sky or a node moves and at rest; latency from
/// such inputs to the picture; bytes uploaded per frame. Needs OpenGL.
void runViewer(const Device& device, const ViewerOptions& options, SuiteRun& run);

/// Returns whether RunOptions::onlyCase leaves it a case.
bool hasViewerCase(const ViewerOptions& options);

std::unique_ptr<Suite> viewerSuite();

}  // namespace prelight::benchmarks
