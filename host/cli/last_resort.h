#pragma once

namespace prelight::cli {

/// Ends the program in the agreed way where nobody can be told any more: operator new that fails, an
/// exception that a thread does not catch, and a library (PoCL, LLVM, Mesa, libepoxy) that aborts or crashes,
/// as it does when the system refuses it memory, a thread or a file. A message is written and the process
/// ends at once with the exit code of what was refused, or of a failure where that is not known; files on
/// their way to their places are not there yet. A fault in the program's own code ends it as it would have.
void answerLastResorts();

}  // namespace prelight::cli
