#pragma once

#include <string_view>

#include "viewer/core/layer_factors.h"

namespace prelight::viewer {

/// Sets the factor of a part of light as a text of the form NAME=FACTOR says, or of all parts, whose name is
/// "all". Throws UsageError for another text, naming the parts.
void setPartFactor(std::string_view text, LayerFactors& factors);

}  // namespace prelight::viewer
