#pragma once

#include "prelight/picture.h"
#include "python/result_arrays.h"

namespace prelight::python {

/// [row, column, rgb] of a picture, which is not copied.
Result<float, 3> pixelsOf(Picture picture);

}  // namespace prelight::python
