#pragma once

#include <string_view>

#include "prelight/options.h"

namespace prelight {

/// Returns the option that sets a member, which is given as in messages ("HaarRequest::error"), or nullptr if
/// none does.
const OptionInfo* findOption(std::string_view field);

}  // namespace prelight
