#pragma once

#include <string>
#include <vector>

namespace prelight::viewer::gl {

/// The log of a driver's shader compiler with the names of files where it has their numbers: "NUMBER:LINE"
/// (Mesa, Intel) or "NUMBER(LINE)" (NVIDIA) at the beginning of a line, after "ERROR: " or not. Each line
/// begins with a line break and two spaces.
std::string nameShaderFiles(const std::string& log, const std::vector<std::string>& files);

}  // namespace prelight::viewer::gl
