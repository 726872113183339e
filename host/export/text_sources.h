#pragma once

#include <map>
#include <string>

namespace prelight {

/// The files of export/texts by their names, embedded when the library is built.
const std::map<std::string, std::string>& exportTextSources();

}  // namespace prelight
