#include "encodings/registry/registry.h"

#include <algorithm>
#include <array>

#include "encodings/ambient_cube/ambient_cube.h"
#include "encodings/sh/sh_encoding.h"

namespace prelight {

std::span<const Encoding> encodings() {
  static const auto rows = std::to_array<Encoding>({
      shEncoding(3),
      ambientCubeEncoding(),
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
