#include "cli/console/standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace prelight::cli {
namespace {

/// Returns 0 or an error number.
int writeAll(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(descriptor, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return count < 0 ? errno : ENOSPC;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return 0;
}

}  // namespace

void openStandardStreams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    // The lowest free number is taken, which is this one. The wrong direction makes every use fail, as
    // before.
    if (::fcntl(descriptor, F_GETFD) < 0 && errno == EBADF)
      (void)::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

void writeError(std::string_view text) { (void)writeAll(STDERR_FILENO, text); }

void StandardOutput::write(std::string_view text) {
  if (failure_) return;
  failure_ = std::error_code(writeAll(STDOUT_FILENO, text), std::generic_category());
}

std::error_code StandardOutput::failure() const {
  return failure_ == std::errc::broken_pipe ? std::error_code() : failure_;
}

}  // namespace prelight::cli
