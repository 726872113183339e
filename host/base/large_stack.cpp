#include "base/large_stack.h"

#include <pthread.h>
#include <sys/resource.h>

#include <thread>

namespace prelight {

namespace {

constexpr rlim_t leastStack = rlim_t{4} << 20;
constexpr std::size_t usualStack = std::size_t{8} << 20;

bool stackIsSmall() {
  rlimit limit{};
  return getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur < leastStack;
}

}  // namespace

int onLargeStack(const std::function<int()>& work) {
  if (!stackIsSmall()) return work();
  // New threads would get the limit's size by default, but theirs may exceed it.
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, usualStack);
  pthread_setattr_default_np(&attributes);
  pthread_attr_destroy(&attributes);
  int result = 0;
  std::thread([&] { result = work(); }).join();
  return result;
}

}  // namespace prelight
