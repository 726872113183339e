#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"
#include "radiosity/elements.h"
#include "shared/cast_types.h"

namespace prelight {

/// Low-discrepancy points all over elements, the same whenever they are asked for.
class ElementPoints {
 public:
  /// Neither is kept beyond the life of the points.
  ElementPoints(const CompiledScene& scene, const RadiosityElements& elements, std::uint64_t seed);

  struct Place {
    SurfaceSample sample;       ///< weight 1
    device::Receiver receiver;  ///< looks along the geometric normal
  };

  /// Point `index` of an element, which looks along `rays` directions of the element's sequence.
  Place at(std::uint32_t element, std::uint32_t triangle, std::uint32_t index, std::uint32_t rays) const;

  /// Points [0, perElement) of elements [first, first + count), on all cores: [element][point].
  std::vector<Place> of(const std::vector<std::uint32_t>& elements, std::size_t first, std::size_t count,
                        std::uint32_t perElement, std::uint32_t rays) const;

 private:
  const CompiledScene& scene_;
  const RadiosityElements& elements_;
  std::uint32_t seed_;
};

}  // namespace prelight
