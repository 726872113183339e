#pragma once

#include <prelight/prelight.h>

/// A grey plane of 20 m x 20 m around the origin at y = 0. It reflects half of the light diffusely. A point
/// light of 10 W/sr is a metre above its centre.
prelight::LoadedScene plane();
