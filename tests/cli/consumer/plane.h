#pragma once

#include <prelight/prelight.h>

/// A grey plane of 20 m x 20 m, y = 0, around the origin, that reflects half of the light evenly, under a point
/// light of 10 W/sr a metre above its centre.
prelight::LoadedScene plane();
