#pragma once

#include "prelight/options.h"
#include "viewer/core/render_options.h"

namespace prelight {

template <>
std::span<const Option<viewer::ShadingOptions>> optionsOf<viewer::ShadingOptions>();
/// The options of pictures that do not change from one to the next; those of ShadingOptions are apart.
template <>
std::span<const Option<viewer::RenderOptions>> optionsOf<viewer::RenderOptions>();

}  // namespace prelight

namespace prelight::viewer {

/// Returns the options with every number in its range; NaN becomes the default.
ShadingOptions withinRanges(ShadingOptions options);

/// Returns whether time changes the picture that these options lead to.
bool areAnimated(const OccluderOptions& options);

}  // namespace prelight::viewer
