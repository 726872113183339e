#pragma once

#include <span>

#include "images/picture_parts.h"
#include "prelight/picture.h"

namespace prelight {

/// Spreads the light of specks over the pixels around, in each channel in proportion to their own: a speck is
/// a pixel that is brighter than those around because of one of its samples. The picture's sum stays. The
/// parts of a changed pixel are scaled alike, so that their sum remains the picture. excess: [pixel]
/// luminance that the brightest sample alone brings (PathTracer::excess()).
void spreadSpecks(std::span<const float> excess, Picture& picture, std::span<PartPicture> parts);

}  // namespace prelight
