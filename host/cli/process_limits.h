#pragma once

#include <functional>

namespace prelight::cli {

/// Lets writing to a full or closed place fail with an error instead of ending the process (SIGPIPE,
/// SIGXFSZ).
void ignoreWriteSignals();

/// Runs `work` and returns what it returns. Where the stack is limited to less than compilers of kernels and
/// kernels need, it and all threads that it starts get the usual size all the same. `work` does not throw.
int onLargeStack(const std::function<int()>& work);

/// Where the address space is limited, libraries that give up for want of it (PoCL and LLVM abort) end the
/// process with the exit code for that.
void answerWantOfMemory();

}  // namespace prelight::cli
