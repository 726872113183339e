#pragma once

#include <string>
#include <vector>

#include "benchmarks/suites/viewer/viewer_suite.h"
#include "viewer/core/shading.h"

namespace prelight::benchmarks {

/// A case of the suite `viewer`.
struct ViewerCase {
  std::string scene;  ///< built in, or a file
  viewer::Shading shading;
  int width = 0;
  int height = 0;

  std::string name() const;  ///< "shapes/sh/640x360"

  /// Both have the same bake.
  bool sharesStage(const ViewerCase& other) const { return scene == other.scene && shading == other.shading; }
};

/// Every shading on every scene that is asked for, or what --case names of those and of all other scenes that
/// the suite knows; those of one scene are neighbours, and among them those of one shading.
std::vector<ViewerCase> viewerCases(const ViewerOptions& options);

/// Throws UsageError saying what names cases have.
[[noreturn]] void refuseViewerCase(const ViewerOptions& options);

/// Built-in scenes that are shown under a sky; files are where they have no lights.
bool isShownUnderSky(const std::string& scene);

}  // namespace prelight::benchmarks
