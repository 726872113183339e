#include "encodings/registry/registry.h"

#include <algorithm>
#include <array>

#include "encodings/ahd/ahd.h"
#include "encodings/ambient_cube/ambient_cube.h"
#include "encodings/dominant_direction/dominant_direction.h"
#include "encodings/h_basis/h_basis.h"
#include "encodings/half_life_2/half_life_2.h"
#include "encodings/hemisphere/hemisphere.h"
#include "encodings/sh/sh_encoding.h"
#include "encodings/sky_and_lamp/sky_and_lamp.h"
#include "encodings/spherical_gaussians/spherical_gaussians.h"
#include "encodings/trilight/trilight.h"
#include "encodings/zh3/zh3.h"

namespace prelight {

std::span<const Encoding> encodings() {
  static const auto rows = std::to_array<Encoding>({
      shEncoding(2),
      shEncoding(3),
      skyAndLampEncoding(),
      hemisphereEncoding(),
      trilightEncoding(),
      ambientCubeEncoding(),
      sphericalGaussiansEncoding(6),
      sphericalGaussiansEncoding(9),
      sphericalGaussiansEncoding(12),
      sphericalGaussiansEncoding(24),
      hBasisEncoding(4),
      hBasisEncoding(6),
      zh3Encoding(),
      zh3HallucinatedEncoding(),
      dominantDirectionEncoding(1),
      dominantDirectionEncoding(2),
      dominantDirectionEncoding(3),
      ahdEncoding(),
      halfLife2Encoding(),
  });
  return rows;
}

const Encoding* encodingNamed(std::string_view name) {
  const std::span<const Encoding> all = encodings();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Encoding& encoding) { return encoding.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace prelight
