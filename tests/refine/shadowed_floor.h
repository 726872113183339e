#pragma once

#include "prelight/load.h"

namespace prelight::test {

/// A floor of two triangles, 10 m x 10 m, with a box of 2 m whose lower side is 0.3 m above it.
/// Without `box` the floor is alone.
LoadedScene shadowedFloor(bool box = true);

}  // namespace prelight::test
