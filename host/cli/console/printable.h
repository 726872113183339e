#pragma once

#include <string>
#include <string_view>

namespace prelight::cli {

/// Makes text harmless for a terminal, since names in files may hold control sequences. Control characters
/// (C0, DEL, C1), characters that change the direction of text and bytes that are not UTF-8 become \uXXXX or
/// \xXX. Lines after the first are indented, so that no name can pretend to be a message.
std::string printable(std::string_view text);

/// Makes JSON harmless, whose own escapes leave DEL, C1 and direction characters as they are. Ends of lines
/// stay.
std::string printableJson(std::string_view text);

}  // namespace prelight::cli
