#pragma once

#include <string>
#include <vector>

namespace prelight {

/// What was odd but usable in an input, for people to read; each entry names its place.
using Warnings = std::vector<std::string>;

}  // namespace prelight
