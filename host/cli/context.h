#pragma once

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
};

}  // namespace prelight::cli
