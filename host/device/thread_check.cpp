#include "device/thread_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <latch>
#include <system_error>
#include <thread>
#include <vector>

#include "prelight/error.h"

namespace prelight {

namespace {

/// Returns the positive number in an environment variable, or `otherwise`.
std::size_t limitOf(const char* name, std::size_t otherwise) {
  const char* text = std::getenv(name);
  std::size_t number = 0;
  if (text == nullptr) return otherwise;
  const auto [end, error] = std::from_chars(text, text + std::strlen(text), number);
  return error == std::errc() && number > 0 ? std::min(number, otherwise) : otherwise;
}

}  // namespace

std::size_t threadsOfRuntime() {
  const std::size_t processors = std::max(1u, std::thread::hardware_concurrency());
  return limitOf("POCL_MAX_PTHREAD_COUNT", limitOf("POCL_CPU_MAX_CU_COUNT", processors));
}

void requireThreads(std::size_t count) {
  std::latch all(1);
  std::vector<std::jthread> threads;
  threads.reserve(count);
  std::error_code failure;
  try {
    while (threads.size() < count) threads.emplace_back([&] { all.wait(); });
  } catch (const std::system_error& error) {
    failure = error.code();
  }
  const std::size_t started = threads.size();
  all.count_down();
  threads.clear();
  if (failure)
    throw Error(ExitCode::OutOfMemory, "OpenCL",
                fmt::format("the system gives {} of the {} threads that a runtime starts: {}", started, count,
                            failure.message()),
                "raise the limit of processes with ulimit -u, or set POCL_MAX_PTHREAD_COUNT to fewer");
}

}  // namespace prelight
