#pragma once

#include <span>

#include "viewer/core/occlusion_options.h"
#include "viewer/options/option_parameter.h"

namespace prelight::viewer {

using ScreenOcclusionParameter = OptionParameter<ScreenOcclusionOptions>;

/// All numbers of ScreenOcclusionOptions, in the order in which they are shown.
std::span<const ScreenOcclusionParameter> screenOcclusionParameters();

}  // namespace prelight::viewer
