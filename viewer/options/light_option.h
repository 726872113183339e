#pragma once

#include <string_view>

#include "prelight/scene.h"

namespace prelight::viewer {

/// Reads a light as `--light` takes it (numbers are decimal, separated by commas; world space, metres):
///   point:x,y,z:r,g,b                           W/sr
///   directional:dx,dy,dz:r,g,b                  W/m2, the way the light travels, any length > 0
///   spot:x,y,z:dx,dy,dz:inner,outer:r,g,b       W/sr, half angles in degrees, 0 <= inner <= outer <= 90
///   area:sphere:x,y,z:radius:r,g,b              W/(m2 sr), as all areas
///   area:disk:x,y,z:dx,dy,dz:radius:r,g,b       shines in the direction; two-sided: backwards, too
///   area:quad:x,y,z:dx,dy,dz:w,h:r,g,b          centre; turn=DEG about the direction
///   area:polygon:x,y,z:x,y,z:x,y,z:...:r,g,b    convex and flat, counter-clockwise where it shines to
/// Behind a point light: profile=FILE (LM-63, multiplies the colour), aim=x,y,z (default: down), turn=DEG;
/// behind a spot light: cookie=FILE, a picture that it projects, turn=DEG; behind either radius=M, behind a
/// directional light angle=DEG, of the disk that it is seen as. The files are read. Of areas,
/// fields `exitance` and `power` make the colour W/m2 of a side, or W of all of it. Throws UsageError that
/// names the faulty part and shows an example.
Light parseLight(std::string_view text);

class LightFields;

/// The area light of such fields. Throws UsageError.
Light parseAreaLight(LightFields& fields);

}  // namespace prelight::viewer
