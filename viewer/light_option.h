#pragma once

#include <string_view>

#include "prelight/scene.h"

namespace prelight::viewer {

/// Reads a light as `--light` takes it (numbers are decimal, separated by commas; world space, metres):
///   point:x,y,z:r,g,b                           W/sr
///   directional:dx,dy,dz:r,g,b                  W/m2, the way the light travels, any length > 0
///   spot:x,y,z:dx,dy,dz:inner,outer:r,g,b       W/sr, half angles in degrees, 0 <= inner <= outer <= 90
/// Throws UsageError that names the faulty part and shows an example.
Light parseLight(std::string_view text);

}  // namespace prelight::viewer
