#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/console/global_options.h"
#include "cli/console/standard_streams.h"
#include "cli/console/stop_signals.h"

namespace prelight::cli {

/// The objects that the program passes to the command that runs.
struct Context {
  StopSignals signals;
  StandardOutput output;
  GlobalOptions options;
  char* const* arguments = nullptr;  ///< the program's own arguments, ended by a null pointer
  /// Runs another command in place of the one that calls it, with the same global options.
  std::function<void(const std::vector<std::string>& arguments)> runAgain = {};
};

}  // namespace prelight::cli
