#pragma once

namespace prelight::cli {

/// Returns whether the system has refused a thread to this process, whoever asked for it; libraries that
/// abort because of that leave no trace of the reason. It may be called within a signal handler.
bool threadWasRefused();

/// Calls `answer` when the system refuses a thread to a library, since some libraries wait for that thread
/// for ever. The program's own code gets std::system_error instead.
void onRefusedThread(void (*answer)());

/// Calls `answer` first whenever a library or the program itself calls abort().
void onAbort(void (*answer)());

/// Keeps the handler that a signal has now; libraries that install another are told that they succeeded.
/// LLVM's handler would be called first, and if the C library itself aborts no other one would be called
/// after it.
void keepHandler(int signal);

}  // namespace prelight::cli
