#pragma once

#include "cli/global_options.h"
#include "cli/standard_streams.h"
#include "cli/stop_signals.h"

namespace prelight::cli {

/// What the program hands to the command that runs.
struct Context {
  StopSignals signals;
  StandardOutput output;
  GlobalOptions options;
  char* const* arguments = nullptr;  ///< what the program was started with, and a null pointer at the end
};

}  // namespace prelight::cli
