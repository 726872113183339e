#pragma once

#include <cstddef>
#include <cstdint>

namespace prelight {

/// What the rays of one side of the surface are turned into.
struct Projections {
  int shOrder = 0;            ///< 0: none
  bool bentNormal = false;    ///< fitted for fronts only
  std::uint32_t groups = 0;   ///< of lights
  std::size_t texelRows = 0;  ///< receivers whose rays are kept texel by texel, fronts only
  bool receivers = false;     ///< keep the receivers of stored rows, fronts only
};

}  // namespace prelight
