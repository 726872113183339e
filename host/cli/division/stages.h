#pragma once

#include <functional>
#include <string>

#include "cli/console/kept_state.h"
#include "cli/session.h"

namespace prelight::cli {

/// Does a command's work, which `state` keeps. Returns false where the command ends with that: after a slice,
/// before a stage that has no slices yet, or where stages are listed; what was done has been told then.
/// Throws UsageError if the work has no stage for the slice that was asked for, or if none of the parts that
/// were given was of use.
bool doStages(Session& session, const std::string& command, const KeptState& state,
              const std::function<void()>& work);

}  // namespace prelight::cli
