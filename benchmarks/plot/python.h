#pragma once

#include <string>
#include <vector>

namespace prelight::benchmarks {

/// The Python 3 that can import a module: the one of PATH, or else the system's. Empty: neither can.
std::string pythonWith(const std::string& module);

/// Runs a script of benchmarks/plot/, "plot.py", to its end. Returns what it printed. Throws Error with the
/// end of that where it fails.
std::string runScript(const std::string& python, const std::string& script,
                      const std::vector<std::string>& arguments);

}  // namespace prelight::benchmarks
