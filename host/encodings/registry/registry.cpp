#include "encodings/registry/registry.h"

#include <algorithm>
#include <array>

#include "encodings/encodings.h"

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
