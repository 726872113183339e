#pragma once

#include <string>

#include "prelight/error.h"
#include "techniques/technique.h"

/// Bakes whose receivers have views drawn instead of rays traced (Visibility::Raster).
namespace prelight {

/// Throws UsageError if something is asked for that follows rays: bounces, light through and from materials,
/// limits of distance, shadow sets and techniques that are not drawable. `plan` has the passes of techniques.
void requireDrawable(const PlanInput& input);

/// Returns the reason of the cast's pass: what is drawn, and when that is worth it.
std::string drawnCastReason(const PlanInput& input);

/// Returns the error of a bake whose views are to be drawn without a renderer.
UsageError rendererMissing();

}  // namespace prelight
