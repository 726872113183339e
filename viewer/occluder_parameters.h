#pragma once

#include <span>

#include "viewer/illumination.h"

namespace prelight::viewer {

/// A number of OccluderOptions, as the command line and the window offer it.
struct OccluderParameter {
  const char* option;            ///< of render and view
  const char* label;             ///< in the window
  double least, most;            ///< what is taken at all
  double usualLeast, usualMost;  ///< what is of use: the slider's ends
  const char* help;
  double (*get)(const OccluderOptions&);
  void (*set)(OccluderOptions&, double);
};

/// All of them, in the order in which they are shown.
std::span<const OccluderParameter> occluderParameters();

/// The options with every number in its range; NaN becomes the default.
OccluderOptions withinRanges(OccluderOptions options);

/// True when time changes what these options show.
bool areAnimated(const OccluderOptions& options);

}  // namespace prelight::viewer
