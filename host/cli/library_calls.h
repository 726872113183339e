#pragma once

namespace prelight::cli {

/// Whether the system has refused this process a thread, whoever asked for it: the libraries that abort then
/// leave no trace of the reason. May be asked within a handler of a signal.
bool threadWasRefused();

/// `answer` is called where a library that was written in C is refused a thread: some wait for it for ever.
/// C++ throws in place of that.
void onRefusedThread(void (*answer)());

/// `answer` is called first where a library or the program itself calls abort().
void onAbort(void (*answer)());

/// A signal keeps the handler that it has now: libraries that ask for another are told that they have it.
/// LLVM's would be called first, and where the C library itself aborts no other comes after it.
void keepHandler(int signal);

}  // namespace prelight::cli
