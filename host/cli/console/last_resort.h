#pragma once

namespace prelight::cli {

/// Ends the program in the agreed way in situations that nobody handles: operator new fails, a thread does
/// not catch an exception, or a library (PoCL, LLVM, Mesa, libepoxy) aborts or crashes, as they do when the
/// system refuses them memory, a thread or a file. A message is written and the process ends at once, with
/// the exit code for what was refused, or for a failure if that is not known; outputs that are still being
/// written do not appear. A fault in the program's own code ends it as it would have without this.
void answerLastResorts();

}  // namespace prelight::cli
