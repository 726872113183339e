#pragma once

#include <string>
#include <string_view>

namespace prelight::cli {

/// What a terminal can be given: names in files may hold sequences that command it. Control characters (C0,
/// DEL, C1), characters that turn the direction of text and bytes that are not UTF-8 become \uXXXX or \xXX.
/// What follows the end of a line is indented, so that no name can pretend to be a message.
std::string printable(std::string_view text);

/// The same for JSON, whose own escapes leave DEL, C1 and directions as they are. Ends of lines stay.
std::string printableJson(std::string_view text);

}  // namespace prelight::cli
