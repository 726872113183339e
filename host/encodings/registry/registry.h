#pragma once

#include <span>
#include <string_view>

#include "encodings/encoding.h"

namespace prelight {

/// All encodings of incident light, in the order in which lists show them.
std::span<const Encoding> encodings();

/// nullptr: there is none of that name.
const Encoding* encodingNamed(std::string_view name);

}  // namespace prelight
