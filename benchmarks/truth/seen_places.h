#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight::benchmarks {

/// A picture whose pixels are looked through.
struct SeenView {
  Camera camera;
  int width = 0, height = 0;
};

struct SeenPlace {
  glm::dvec3 position{0.0};           ///< scene coordinates
  glm::dvec3 face{0.0}, normal{0.0};  ///< unit, on the side seen: of the triangle, and that it is shaded with
  std::uint32_t triangle = PRELIGHT_NO_TRIANGLE;
};

/// Places of the surface seen in the middle of every pixel, [row][column]; without a triangle where nothing
/// is seen. Backs of one-sided surfaces are not seen.
std::vector<SeenPlace> placesSeen(const CompiledScene& scene, Tracer& tracer, const SeenView& view);

/// How far above what is seen rays begin, m.
double seenOffset(const CompiledScene& scene);

/// From one point along a unit direction, not to meet the triangle that it begins on.
device::Ray rayFrom(const glm::dvec3& from, const glm::dvec3& to, std::uint32_t triangle, double farthest);

}  // namespace prelight::benchmarks
