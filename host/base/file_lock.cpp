#include "base/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace prelight {

bool lockFile(int descriptor) { return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK; }

bool isLockedByAnother(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return false;
  const bool locked = !lockFile(descriptor);
  ::close(descriptor);
  return locked;
}

// The lock is held until the name is gone: whoever waits for it finds out that the file has no name.
void removeUnlessLocked(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return;
  struct stat opened {};
  struct stat named {};
  if (lockFile(descriptor) && ::fstat(descriptor, &opened) == 0 && ::stat(path.c_str(), &named) == 0 &&
      opened.st_dev == named.st_dev && opened.st_ino == named.st_ino)
    ::unlink(path.c_str());
  ::close(descriptor);
}

}  // namespace prelight
