#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "gpu/tracer.h"
#include "radiosity/elements.h"

namespace prelight {

/// A pixel of a hemicube around +Z.
struct HemicubePixel {
  glm::dvec3 direction;  ///< unit, through the pixel's centre
  double share;          ///< delta form factor; all of a hemicube sum to 1
};

/// Returns the pixels of half a cube: `size` x `size` on top and half as many on each side (Cohen and
/// Greenberg 1985), 3 size^2 together. `size` is even, >= 2.
std::vector<HemicubePixel> makeHemicube(int size);

/// Form factors of elements by hemicubes at points of the elements, with one traced ray per pixel. The cast
/// of cosine-distributed rays is checked against them.
class HemicubeCast {
 public:
  /// All arguments must outlive this object.
  HemicubeCast(const CompiledScene& scene, const RadiosityElements& elements, Tracer& tracer, int size);

  /// Returns (element, form factor) pairs, ascending, from hemicubes at the first `count` points of an
  /// element. Rays that escape are left out.
  std::vector<std::pair<std::uint32_t, double>> row(const ElementPoints& points, std::uint32_t element,
                                                    std::uint32_t count);

 private:
  const CompiledScene& scene_;
  const RadiosityElements& elements_;
  Tracer& tracer_;
  std::vector<HemicubePixel> pixels_;
};

}  // namespace prelight
