#pragma once

#include <string>
#include <vector>

#include "viewer/window/controls.h"

namespace prelight::viewer {

/// The shading that the number key 0 to 9 shows: 1 the first of shadings(), 0 the tenth.
Shading shadingOfKey(int digit);

/// A line for every key and mouse movement that does something to what is shown; those that need lights,
/// nodes, light groups, a sky or a shading that is not there are left out.
std::vector<std::string> keyHelp(const Controls& controls, bool hasSky);

}  // namespace prelight::viewer
