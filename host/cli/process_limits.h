#pragma once

namespace prelight::cli {

/// Lets writing to a full or closed place fail with an error instead of ending the process (SIGPIPE,
/// SIGXFSZ).
void ignoreWriteSignals();

/// Where the address space is limited, libraries that give up for want of it (PoCL and LLVM abort) end the
/// process with the exit code for that.
void answerWantOfMemory();

}  // namespace prelight::cli
