#pragma once

#include <string>

#include "base/work_share.h"
#include "cli/console/kept_state.h"
#include "cli/session.h"

namespace prelight::cli {

/// Tells what a process did whose work ended with a stage: a slice and its file, or the merged slices, the
/// state and the next stage. Throws UsageError if none of the parts that were given was of use.
void tellStageEnd(Session& session, const std::string& command, const KeptState& state, const StageEnd& end);

/// Tells the stages of work that has been done as a whole.
void tellStages(Session& session, const std::string& command, const KeptState& state);

/// After work that has come to its end: throws UsageError if it was to end with a slice of a stage, or if
/// none of the parts that were given was of use. Tells what was taken from parts.
void requireStage(Session& session, const KeptState& state);

}  // namespace prelight::cli
