#pragma once

#include <cstddef>
#include <utility>

#include "prelight/picture.h"
#include "python/result_arrays.h"

namespace prelight::python {

/// Returns a picture as an array [row, column, rgb] without copying it.
inline Result<float, 3> pixelsOf(Picture picture) {
  const auto height = static_cast<std::size_t>(picture.height),
             width = static_cast<std::size_t>(picture.width);
  return arrayFrom<float, 3>(std::move(picture.pixels), {height, width, 3});
}

}  // namespace prelight::python
