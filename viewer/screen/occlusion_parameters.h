#pragma once

#include <span>

#include "viewer/option_parameter.h"
#include "viewer/screen/occlusion_options.h"

namespace prelight::viewer {

using ScreenOcclusionParameter = OptionParameter<ScreenOcclusionOptions>;

/// All numbers of ScreenOcclusionOptions, in the order in which they are shown.
std::span<const ScreenOcclusionParameter> screenOcclusionParameters();

}  // namespace prelight::viewer
