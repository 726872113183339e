#pragma once

#include <string>
#include <vector>

namespace prelight {

/// Light that arrives at vertices, or at the texels of a light map, as an encoding of host/encodings stores
/// it.
struct EncodedLight {
  std::string encoding;       ///< its name
  std::vector<float> values;  ///< [vertex][value], or [y][x][value] of texels, 0 where there is no surface
};

}  // namespace prelight
