#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <functional>

namespace prelight::test {

/// Runs `body` in a process of its own, whose limits and mounts end with it. Returns the result of `body`, or
/// 128 and the number of the signal that ended it.
inline int inOwnProcess(const std::function<int()>& body) {
  const pid_t process = ::fork();
  if (process == 0) ::_exit(body());
  int status = 0;
  ::waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace prelight::test
