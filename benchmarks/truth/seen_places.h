#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight::benchmarks {

/// A camera and the size of its picture.
struct SeenView {
  Camera camera;
  int width = 0, height = 0;
};

struct SeenPlace {
  glm::dvec3 position{0.0};  ///< scene coordinates
  glm::dvec3 face{0.0},
      normal{0.0};  ///< unit normals of the triangle and of its shading, on the visible side
  std::uint32_t triangle = PRELIGHT_NO_TRIANGLE;
};

/// Returns the place of the surface that is visible in the middle of every pixel, [row][column]; without a
/// triangle if there is none. Backs of one-sided surfaces are invisible.
std::vector<SeenPlace> placesSeen(const CompiledScene& scene, Tracer& tracer, const SeenView& view);

/// Returns the distance above the visible surface at which rays begin, m.
double seenOffset(const CompiledScene& scene);

}  // namespace prelight::benchmarks
