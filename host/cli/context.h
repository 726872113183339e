#pragma once

#include "cli/global_options.h"
#include "cli/stop_signals.h"

namespace prelight::cli {

/// What the program hands to the command that runs.
struct Context {
  StopSignals signals;
  GlobalOptions options;
};

}  // namespace prelight::cli
