#include "python/unlocked_work.h"

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <mutex>

#include "prelight/error.h"

namespace prelight::python {

namespace {

/// The work of all threads in the only interpreter.
struct Works {
  std::mutex guard;
  std::condition_variable changed;
  std::size_t running = 0;
  std::atomic<bool> end = false;
};

Works& works() {
  static Works all;
  return all;
}

void stopAll() {
  Works& all = works();
  all.end = true;
  const nb::gil_scoped_release released;
  std::unique_lock lock(all.guard);
  all.changed.wait(lock, [&] { return all.running == 0; });
}

}  // namespace

UnlockedWork::UnlockedWork() {
  if (interpreterEnds()) throw Interrupted("the interpreter ends");
  {
    const std::lock_guard lock(works().guard);
    ++works().running;
  }
  released_.emplace();
}

UnlockedWork::~UnlockedWork() {
  released_.reset();
  const std::lock_guard lock(works().guard);
  --works().running;
  works().changed.notify_all();
}

bool UnlockedWork::interpreterEnds() { return works().end; }

void bindInterpreterEnd() { nb::module_::import_("atexit").attr("register")(nb::cpp_function(stopAll)); }

}  // namespace prelight::python
