#pragma once

#include <string>
#include <vector>

namespace prelight {

/// True when `text` is what `pattern` describes: * is any run of characters, ? any one.
bool matchesPattern(const std::string& text, const std::string& pattern);

/// The parts of "a,b,c"; empty ones are left out.
std::vector<std::string> splitPatterns(const std::string& text);

}  // namespace prelight
