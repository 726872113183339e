#include "cli/console/library_calls.h"

#include <dlfcn.h>
#include <execinfo.h>
#include <pthread.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): <csignal> lacks the POSIX part

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <string_view>

namespace {

template <typename Function>
Function usual(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

std::atomic<bool> refused = false;
std::atomic<void (*)()> answerToAbort = nullptr;
std::atomic<void (*)()> answerToRefusal = nullptr;
static_assert(std::atomic<bool>::is_always_lock_free, "handlers of signals read it");

using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
using Abort = void (*)();
using Handle = int (*)(int, const struct sigaction*, struct sigaction*);

const auto usualAbort = usual<Abort>("abort");  // looked up before anything goes wrong

std::array<std::atomic<bool>, 65> kept{};  // [signal]

/// Returns whether the program itself asked for a thread, directly or through std::thread, and therefore
/// handles the refusal. `caller` is the return address in pthread_create().
bool programAsked(const void* caller) {
  Dl_info program{};
  if (dladdr(reinterpret_cast<const void*>(&programAsked), &program) == 0) return true;
  std::array<void*, 8> frames{};
  const auto end = frames.begin() + backtrace(frames.data(), static_cast<int>(frames.size()));
  for (auto frame = std::find(frames.begin(), end, caller); frame != end; ++frame) {
    Dl_info asking{};
    if (dladdr(*frame, &asking) == 0 || asking.dli_fname == nullptr) continue;
    if (std::string_view(asking.dli_fname).find("libstdc++") != std::string_view::npos) continue;
    return asking.dli_fbase == program.dli_fbase;
  }
  return true;
}

}  // namespace

// These functions replace those of the C library, which they call, for all libraries in the process, because
// the program comes first where names are looked up.

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*work)(void*),
                              void* argument) noexcept {
  static const auto create = usual<Create>("pthread_create");
  const int error = create(thread, attributes, work, argument);
  if (error == 0) return 0;
  refused = true;
  void (*answer)() = answerToRefusal;
  if (answer != nullptr && !programAsked(__builtin_return_address(0))) answer();
  return error;
}

extern "C" __attribute__((noreturn)) void abort() noexcept {  // as the C library declares it
  if (void (*answer)() = answerToAbort) answer();
  if (usualAbort != nullptr) usualAbort();
  for (;;) raise(SIGKILL);  // abort() was called before the program's variables were initialised
}

extern "C" int sigaction(int signal, const struct sigaction* action, struct sigaction* old) noexcept {
  static const auto handle = usual<Handle>("sigaction");
  const bool keeps =
      signal >= 0 && static_cast<std::size_t>(signal) < kept.size() && kept[static_cast<std::size_t>(signal)];
  return handle(signal, keeps ? nullptr : action, old);
}

namespace prelight::cli {

bool threadWasRefused() { return refused; }

void onRefusedThread(void (*answer)()) { answerToRefusal = answer; }

void onAbort(void (*answer)()) { answerToAbort = answer; }

void keepHandler(int signal) { kept[static_cast<std::size_t>(signal)] = true; }

}  // namespace prelight::cli
