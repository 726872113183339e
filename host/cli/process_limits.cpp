#include "cli/process_limits.h"

#include <signal.h>  // NOLINT(modernize-deprecated-headers): <csignal> lacks the POSIX part
#include <sys/resource.h>
#include <unistd.h>

#include "cli/standard_streams.h"
#include "prelight/error.h"

namespace prelight::cli {
namespace {

bool isLimited(int resource) {
  rlimit limit{};
  return getrlimit(static_cast<__rlimit_resource>(resource), &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

/// Ends the program when a library has found no memory.
void endOutOfMemory(int) {
  writeError(
      "prelight: error: out of memory: the address space is limited (ulimit -v), and a library gave up\n");
  _exit(static_cast<int>(ExitCode::OutOfMemory));
}

}  // namespace

void ignoreWriteSignals() {
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
}

void answerWantOfMemory() {
  if (!isLimited(RLIMIT_AS) && !isLimited(RLIMIT_DATA)) return;
  for (const int number : {SIGABRT, SIGSEGV, SIGBUS}) signal(number, endOutOfMemory);
}

}  // namespace prelight::cli
