#pragma once

#include <string>
#include <string_view>

namespace prelight::cli {

/// A text in which the fields that the library's messages name ("BakeRequest::maxMemory") are the options
/// that set them ("--max-memory"). Names of fields that no option sets stay.
std::string withOptions(std::string_view text);

}  // namespace prelight::cli
