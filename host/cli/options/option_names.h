#pragma once

#include <string>
#include <string_view>

namespace prelight::cli {

/// Replaces the fields named in the library's messages ("BakeRequest::maxMemory") by the options that set
/// them ("--max-memory"). Names of fields that no option sets stay.
std::string withOptions(std::string_view text);

}  // namespace prelight::cli
