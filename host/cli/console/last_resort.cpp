#include "cli/console/last_resort.h"

#include <execinfo.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): <csignal> lacks the POSIX part
#include <sys/resource.h>
#include <ucontext.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>
#include <system_error>

#include "cli/console/library_calls.h"
#include "cli/console/standard_streams.h"
#include "prelight/error.h"

// The linker's names for the beginning and the end of the program's own code.
extern "C" const char __executable_start, etext;  // NOLINT(bugprone-reserved-identifier)

namespace prelight::cli {
namespace {

/// The things that the system can refuse to a process, which then dies.
enum class Refused { Memory, Thread, File, Unknown };

constexpr std::string_view nameOf(Refused what) {
  switch (what) {
    case Refused::Memory:
      return "out of memory (give the bake less with --max-memory, or close other programs)";
    case Refused::Thread:
      return "out of memory: the system refuses further threads, and a library gave up (raise the limit, "
             "ulimit -u, or close other programs)";
    case Refused::File:
      return "too many open files, and a library gave up (raise the limit, ulimit -n)";
    case Refused::Unknown:
      break;
  }
  return "a library gave up (its own message, if there is one, stands above)";
}

/// Calls only functions that work without memory and within a signal handler. If several threads die, the
/// first one says why.
[[noreturn]] void endRefused(Refused what) {
  static std::atomic_flag said;
  while (said.test_and_set()) pause();
  writeError("prelight: error: ");
  writeError(nameOf(what));
  writeError("\n");
  const bool memory = what == Refused::Memory || what == Refused::Thread;
  _exit(static_cast<int>(memory ? ExitCode::OutOfMemory : ExitCode::RuntimeFailure));
}

/// The handler of a failing operator new. A std::bad_alloc would pass through libraries that do not expect
/// exceptions and leave their locks taken: with PoCL, when LLVM finds no memory, any later clean-up waits for
/// ever.
void onFailedNew() { endRefused(Refused::Memory); }

bool isLimited(int resource) {
  rlimit limit{};
  return getrlimit(static_cast<__rlimit_resource>(resource), &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

/// Returns whether memory can be had. A thread that dies within malloc() may hold its lock, so that this call
/// may take long, which means nothing.
bool memoryCanBeHad() {
  constexpr std::size_t little = std::size_t{1} << 20;
  signal(SIGALRM, [](int) { endRefused(Refused::Unknown); });
  alarm(2);
  void* const had = std::malloc(little);
  alarm(0);
  return had != nullptr;
}

/// Returns what was refused before the process dies. For files and for memory of libraries, the error number
/// of the thread's last failed call tells.
Refused refusedBefore(int error) {
  if (error == EMFILE || error == ENFILE) return Refused::File;
  if (error == ENOMEM) return Refused::Memory;
  if (threadWasRefused()) return Refused::Thread;
  return isLimited(RLIMIT_AS) || isLimited(RLIMIT_DATA) ? Refused::Memory : Refused::Unknown;
}

/// Returns whether the instruction that a signal interrupted belongs to a library, which may do anything when
/// it did not get what it asked for.
bool isInLibrary(const void* context) {
#if defined(__x86_64__)
  const auto at =
      static_cast<std::uintptr_t>(static_cast<const ucontext_t*>(context)->uc_mcontext.gregs[REG_RIP]);
#elif defined(__aarch64__)
  const auto at = static_cast<std::uintptr_t>(static_cast<const ucontext_t*>(context)->uc_mcontext.pc);
#else
  const auto at = reinterpret_cast<std::uintptr_t>(&__executable_start);
#endif
  return at < reinterpret_cast<std::uintptr_t>(&__executable_start) ||
         at >= reinterpret_cast<std::uintptr_t>(&etext);
}

/// Set when the program terminates by an exception that is a fault of its own.
std::atomic<bool> terminates = false;

void onFatalSignal(int signal, siginfo_t*, void* context) {
  const Refused refused = refusedBefore(errno);
  const bool ofLibrary = !terminates && (signal == SIGABRT || isInLibrary(context));
  if (refused != Refused::Unknown) endRefused(refused);
  if (ofLibrary) endRefused(memoryCanBeHad() ? Refused::Unknown : Refused::Memory);
  ::signal(signal, SIG_DFL);
  raise(signal);
}

/// Called when a library aborts or the program terminates.
void beforeAbort() {
  if (terminates) return;
  const Refused refused = refusedBefore(errno);
  endRefused(refused == Refused::Unknown && !memoryCanBeHad() ? Refused::Memory : refused);
}

std::terminate_handler usualTerminate = nullptr;

/// Called for an exception that nobody catches. If it tells what was refused the program ends in the agreed
/// way, else the usual handler prints it and aborts.
[[noreturn]] void onTerminate() {
  if (std::current_exception()) {
    try {
      throw;
    } catch (const std::bad_alloc&) {
      endRefused(Refused::Memory);
    } catch (const std::system_error& error) {
      if (error.code() == std::errc::not_enough_memory) endRefused(Refused::Memory);
      if (error.code() == std::errc::resource_unavailable_try_again) endRefused(Refused::Thread);
    } catch (...) {  // NOLINT(bugprone-empty-catch): the usual handler looks at it
    }
  }
  terminates = true;
  usualTerminate();
  std::abort();
}

}  // namespace

void answerLastResorts() {
  // This call loads the C library's unwinder, which ending threads look for when there may be no memory for
  // it.
  void* frame = nullptr;
  backtrace(&frame, 1);
  std::set_new_handler(onFailedNew);
  usualTerminate = std::set_terminate(onTerminate);
  onRefusedThread([] { endRefused(Refused::Thread); });
  onAbort(beforeAbort);
  // The signal handler has a stack of its own, because libraries that run out of memory may also run out of
  // stack while they report it: GLib's log calls itself.
  static std::array<std::byte, 1 << 16> room;
  const stack_t stack{.ss_sp = room.data(), .ss_flags = 0, .ss_size = room.size()};
  sigaltstack(&stack, nullptr);
  struct sigaction action {};
  action.sa_sigaction = onFatalSignal;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  for (const int number : {SIGABRT, SIGSEGV, SIGBUS, SIGILL}) {
    sigaction(number, &action, nullptr);
    keepHandler(number);
  }
}

}  // namespace prelight::cli
