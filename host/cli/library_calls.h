#pragma once

namespace prelight::cli {

/// Whether the system has refused this process a thread, whoever asked for it: the libraries that abort then
/// leave no trace of the reason. May be asked within a handler of a signal.
bool threadWasRefused();

/// Calls `answer` when the system refuses a thread to a library: some wait for that thread for ever. The
/// program's own code gets std::system_error instead.
void onRefusedThread(void (*answer)());

/// `answer` is called first where a library or the program itself calls abort().
void onAbort(void (*answer)());

/// A signal keeps the handler that it has now: libraries that ask for another are told that they have it.
/// LLVM's would be called first, and where the C library itself aborts no other comes after it.
void keepHandler(int signal);

}  // namespace prelight::cli
