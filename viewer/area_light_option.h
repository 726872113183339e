#pragma once

#include "prelight/scene.h"
#include "viewer/light_fields.h"

namespace prelight::viewer {

/// Most corners of a polygon.
constexpr std::size_t mostCorners = 32;

/// An area light, of the fields of `--light` (viewer/light_option.h). Throws UsageError.
Light parseAreaLight(LightFields& fields);

}  // namespace prelight::viewer
