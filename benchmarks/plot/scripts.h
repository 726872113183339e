#pragma once

#include <map>
#include <string>

namespace prelight {

/// Texts of the Python scripts by path under benchmarks/ ("plot/plot.py").
const std::map<std::string, std::string>& plotScripts();

}  // namespace prelight
