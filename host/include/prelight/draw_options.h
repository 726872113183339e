#pragma once

#include <functional>
#include <span>

#include "prelight/draw.h"
#include "prelight/options.h"

namespace prelight {

/// An option of DrawRequest, for front ends that take options by name.
struct DrawOption {
  OptionInfo info;
  std::optional<double> usual;                    ///< its value in a request that sets nothing, if any
  std::function<void(DrawRequest&, double)> set;  ///< accepts permitted values
};

/// Returns the options of shadings, of objects and of caustics. DrawRequest also has members without a row,
/// such as its lights.
std::span<const DrawOption> drawOptions();

}  // namespace prelight
