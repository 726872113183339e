#include "cli/process_limits.h"

#include <pthread.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): <csignal> lacks the POSIX part
#include <sys/resource.h>
#include <unistd.h>

#include <thread>

#include "cli/standard_streams.h"
#include "prelight/error.h"

namespace prelight::cli {
namespace {

constexpr rlim_t leastStack = rlim_t{4} << 20;
constexpr std::size_t usualStack = std::size_t{8} << 20;

bool isLimited(int resource) {
  rlimit limit{};
  return getrlimit(static_cast<__rlimit_resource>(resource), &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

bool stackIsSmall() {
  rlimit limit{};
  return getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur < leastStack;
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

int onLargeStack(const std::function<int()>& work) {
  if (!stackIsSmall()) return work();
  // Threads would take the limit's size; theirs is not bound by it.
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, usualStack);
  pthread_setattr_default_np(&attributes);
  pthread_attr_destroy(&attributes);
  int result = 0;
  std::thread([&] { result = work(); }).join();
  return result;
}

void answerWantOfMemory() {
  if (!isLimited(RLIMIT_AS) && !isLimited(RLIMIT_DATA)) return;
  for (const int number : {SIGABRT, SIGSEGV, SIGBUS}) signal(number, endOutOfMemory);
}

}  // namespace prelight::cli
