#pragma once

#include "prelight/compiled_scene.h"
#include "viewer/core/view_state.h"

namespace prelight::viewer {

/// Metres beyond which nothing occludes: as asked for, or a share of the scene's size.
double occlusionRadius(const ScreenOcclusionOptions& options, const CompiledScene& scene);

/// Pixels around a tile within which what occludes its pixels is looked for: as many as the radius covers in
/// front of the nearest that may be seen, within bounds. The same for all tiles of a picture.
int occlusionMargin(const View& view, int samplesPerAxis, double radius, const CompiledScene& scene);

}  // namespace prelight::viewer
