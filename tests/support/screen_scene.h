#pragma once

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight::test {

constexpr float screenRadiance = 8.0f;  ///< Radiance where the screen's image is white.

/// A black screen of 2 m by 1 m that faces down around (0, 2, 0), with u along +X. It emits `image`, or
/// evenly if `image` has no texels.
Scene screenScene(const Image& image);

/// A room of 4 x 3 x 4 m with a lamp of 1 m2 below its ceiling. Both share a material whose emission is white
/// in the sixteenth of its image that the lamp shows.
Scene atlasScene();

/// An image that is white in its left quarter and black beyond.
Image leftQuarter(int width, int height);

/// An image of random colours, always the same.
Image noiseImage(int width, int height);

CompiledScene compiledOf(const Scene& scene);

}  // namespace prelight::test
