#pragma once

#include <span>
#include <string_view>

#include "encodings/encoding.h"

namespace prelight {

/// Returns all encodings of incident light, in the order in which lists show them.
std::span<const Encoding> encodings();

/// Returns the encoding of a name, or nullptr if there is none.
const Encoding* encodingNamed(std::string_view name);

}  // namespace prelight
