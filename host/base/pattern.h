#pragma once

#include <string>
#include <vector>

namespace prelight {

/// Returns true when `text` matches `pattern`: * is any run of characters, ? any single one.
bool matchesPattern(const std::string& text, const std::string& pattern);

/// Returns the parts of "a,b,c" without empty ones.
std::vector<std::string> splitPatterns(const std::string& text);

}  // namespace prelight
