#pragma once

#include <map>
#include <string>

namespace prelight {

/// The files of viewer/web/texts by their names, embedded when the viewer is built.
const std::map<std::string, std::string>& webPageTexts();

}  // namespace prelight
