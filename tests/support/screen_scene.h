#pragma once

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight::test {

constexpr float screenRadiance = 8.0f;  ///< where its image is white

/// A screen of 2 m by 1 m that faces down, around (0, 2, 0), u along +X: black but for what it emits. An
/// image without texels: it emits evenly.
Scene screenScene(const Image& image);

/// A room of 4 x 3 x 4 m and a lamp of 1 m2 below its ceiling that share a material, whose emission is white
/// in a sixteenth of its image: that which the lamp shows.
Scene atlasScene();

/// White in its left quarter, black beyond.
Image leftQuarter(int width, int height);

/// Random colours, the same every time.
Image noiseImage(int width, int height);

CompiledScene compiledOf(const Scene& scene);

}  // namespace prelight::test
