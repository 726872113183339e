#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"
#include "radiosity/elements.h"
#include "shared/cast_types.h"

namespace prelight {

/// Low-discrepancy points on elements, which are reproducible by index.
class ElementPoints {
 public:
  /// The arguments must outlive the object.
  ElementPoints(const CompiledScene& scene, const RadiosityElements& elements, std::uint64_t seed);

  struct Place {
    SurfaceSample sample;       ///< weight 1
    device::Receiver receiver;  ///< looks along the geometric normal
  };

  /// Returns point `index` of an element, whose receiver casts `rays` rays of the element's sequence.
  Place at(std::uint32_t element, std::uint32_t triangle, std::uint32_t index, std::uint32_t rays) const;

  /// Returns points [0, perElement) of elements [first, first + count), [element][point], using all cores.
  std::vector<Place> of(const std::vector<std::uint32_t>& elements, std::size_t first, std::size_t count,
                        std::uint32_t perElement, std::uint32_t rays) const;

 private:
  const CompiledScene& scene_;
  const RadiosityElements& elements_;
  std::uint32_t seed_;
};

}  // namespace prelight
