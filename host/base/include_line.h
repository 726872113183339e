#pragma once

#include <string>
#include <string_view>

namespace prelight {

/// Returns the quoted path of an include line of OpenCL C or GLSL, `#include "PATH"`; empty for any other
/// line.
inline std::string includedPath(std::string_view line) {
  constexpr std::string_view directive = "#include";
  const auto start = line.find_first_not_of(" \t");
  if (start == std::string_view::npos || !line.substr(start).starts_with(directive)) return {};
  const auto open = line.find('"', start + directive.size());
  const auto close = open == std::string_view::npos ? open : line.find('"', open + 1);
  return close == std::string_view::npos ? std::string()
                                         : std::string(line.substr(open + 1, close - open - 1));
}

}  // namespace prelight
