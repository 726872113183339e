#pragma once

#include <functional>

#include "viewer/core/picture_slices.h"
#include "viewer/core/sliced_work.h"

namespace prelight::viewer {

/// Draws a picture of that many samples by calls of `draw`, which scissors limit to slices of about
/// `seconds`. Between two slices the state of OpenGL may change: `draw` sets what it needs.
SlicedWork drawInSlices(int width, int height, double seconds, std::function<void(const SampleRect&)> draw);

}  // namespace prelight::viewer
