#pragma once

#include <span>

#include "viewer/core/occluder_options.h"
#include "viewer/options/option_parameter.h"

namespace prelight::viewer {

using OccluderParameter = OptionParameter<OccluderOptions>;

/// All numbers of OccluderOptions, in the order in which they are shown.
std::span<const OccluderParameter> occluderParameters();

/// The options with every number in its range; NaN becomes the default.
OccluderOptions withinRanges(OccluderOptions options);

/// True when time changes what these options show.
bool areAnimated(const OccluderOptions& options);

}  // namespace prelight::viewer
