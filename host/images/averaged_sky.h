#pragma once

#include "prelight/picture.h"

namespace prelight {

/// Returns a sky of means of two by two texels, halved until it is at most `width` texels wide or a side is
/// odd.
Environment averagedTo(Environment sky, int width);

}  // namespace prelight
