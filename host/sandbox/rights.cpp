#include "sandbox/rights.h"

#include <seccomp.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <memory>

namespace prelight {

namespace {

constexpr rlim_t mostSeconds = 120;

using Filter = std::unique_ptr<void, decltype(&seccomp_release)>;

/// The system calls of decoders, of memory allocation and of the end of a process.
constexpr int calls[] = {
    SCMP_SYS(read),          SCMP_SYS(write),        SCMP_SYS(readv),          SCMP_SYS(writev),
    SCMP_SYS(recvfrom),      SCMP_SYS(sendto),       SCMP_SYS(recvmsg),        SCMP_SYS(sendmsg),
    SCMP_SYS(poll),          SCMP_SYS(ppoll),        SCMP_SYS(close),          SCMP_SYS(lseek),
    SCMP_SYS(fstat),         SCMP_SYS(brk),          SCMP_SYS(munmap),         SCMP_SYS(mremap),
    SCMP_SYS(madvise),       SCMP_SYS(futex),        SCMP_SYS(sched_yield),    SCMP_SYS(sched_getaffinity),
    SCMP_SYS(clock_gettime), SCMP_SYS(gettimeofday), SCMP_SYS(getrandom),      SCMP_SYS(getpid),
    SCMP_SYS(gettid),        SCMP_SYS(rt_sigaction), SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigreturn),
    SCMP_SYS(exit),          SCMP_SYS(exit_group),   SCMP_SYS(sysinfo),        SCMP_SYS(restart_syscall),
};

bool allow(const Filter& filter) {
  for (const int call : calls)
    if (seccomp_rule_add(filter.get(), SCMP_ACT_ALLOW, call, 0) != 0) return false;
  const auto notExecutable = SCMP_A2(SCMP_CMP_MASKED_EQ, PROT_EXEC, 0);
  for (const int call : {SCMP_SYS(mmap), SCMP_SYS(mprotect)})
    if (seccomp_rule_add(filter.get(), SCMP_ACT_ALLOW, call, 1, notExecutable) != 0) return false;
  return true;
}

void bound(__rlimit_resource resource, rlim_t most) {
  rlimit limit{};
  if (::getrlimit(resource, &limit) != 0) return;
  limit.rlim_max = std::min(limit.rlim_max, most);
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(resource, &limit);
}

}  // namespace

bool giveUpRights() {
  bound(RLIMIT_CPU, mostSeconds);
  bound(RLIMIT_CORE, 0);
  const Filter filter(seccomp_init(SCMP_ACT_ERRNO(EPERM)), &seccomp_release);
  return filter && allow(filter) && seccomp_load(filter.get()) == 0;
}

}  // namespace prelight
