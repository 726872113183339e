#pragma once

#include <map>
#include <string>

namespace prelight {

/// Returns the embedded files of export/texts by their names.
const std::map<std::string, std::string>& exportTextSources();

}  // namespace prelight
