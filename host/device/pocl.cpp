#include "device/pocl.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <mutex>
#include <string_view>
#include <system_error>

namespace prelight {

std::string neededPoclMethod(const DeviceInfo& info) {
  return info.isPocl && info.driverVersion.starts_with("6.") ? "cbs" : "";
}

void configurePocl(const DeviceInfo& info) {
  if (!info.isPocl) return;
  static std::mutex setting;
  const std::lock_guard lock(setting);
  const std::string method = neededPoclMethod(info);
  if (!method.empty()) ::setenv("POCL_WORK_GROUP_METHOD", method.c_str(), 0);
  ::setenv("POCL_WORK_GROUP_SPECIALIZATION", "0", 0);
}

namespace fs = std::filesystem;

namespace {

constexpr const char* variable = "POCL_CACHE_DIR";
constexpr std::string_view temporaryPrefix = "prelight-pocl-";
/// Bytes of free space that a cache folder needs; all kernels of one command take a quarter of it.
constexpr std::uint64_t leastSpace = std::uint64_t{32} << 20;
constexpr std::size_t longestPath = 700;  ///< PoCL appends to the path and aborts beyond 1024 characters

std::string reasonOf(int error) { return std::generic_category().message(error); }

std::optional<fs::path> environmentPath(const char* name) {
  const char* value = std::getenv(name);
  if (value == nullptr) return std::nullopt;
  return value;
}

/// Returns the folder itself, or its nearest existing parent.
fs::path nearestThere(const fs::path& folder) {
  std::error_code ignored;
  fs::path place = fs::absolute(folder, ignored).lexically_normal();
  while (place.has_relative_path() && !fs::exists(fs::symlink_status(place, ignored)))
    place = place.parent_path();
  return place;
}

/// Writes as many bytes as a small kernel has. Returns 0 or the errno of the failure.
int tryToFill(int file) {
  static constexpr std::array<char, 1 << 16> bytes{};
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t written = ::write(file, bytes.data() + done, bytes.size() - done);
    if (written < 0) return errno;
    done += static_cast<std::size_t>(written);
  }
  return 0;
}

/// Creates and removes a file and a folder in `folder`. Returns 0 or the errno of the failure.
int tryToWrite(const fs::path& folder) {
  std::string file = folder / "prelight-test-XXXXXX", subfolder = file;
  const int descriptor = ::mkostemp(file.data(), O_CLOEXEC);
  if (descriptor < 0) return errno;
  int failure = tryToFill(descriptor);
  if (::close(descriptor) != 0 && failure == 0) failure = errno;
  ::unlink(file.c_str());
  if (failure == 0 && ::mkdtemp(subfolder.data()) == nullptr) return errno;
  ::rmdir(subfolder.c_str());
  return failure;
}

/// Returns the locked lock file in a folder, or -1. A process holds this lock as long as it uses the folder.
int lockedFile(const fs::path& folder, int flags) {
  const int file = ::open((folder / "lock").c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | flags, 0600);
  if (file >= 0 && ::flock(file, LOCK_EX | LOCK_NB) == 0) return file;
  if (file >= 0) ::close(file);
  return -1;
}

/// Removes temporary folders that killed processes of this user have left in `base`.
void removeAbandoned(const fs::path& base) {
  std::error_code ignored;
  for (fs::directory_iterator entry(base, ignored); entry != fs::directory_iterator();
       entry.increment(ignored)) {
    const fs::path& path = entry->path();
    struct stat status {};
    if (!path.filename().string().starts_with(temporaryPrefix)) continue;
    if (::lstat(path.c_str(), &status) != 0 || !S_ISDIR(status.st_mode) || status.st_uid != ::geteuid())
      continue;
    const int lock = lockedFile(path, 0);
    if (lock < 0) continue;  // in use, or about to be
    fs::remove_all(path, ignored);
    ::close(lock);
  }
}

/// A temporary folder for PoCL, reserved for this process as long as it lives.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::error_code ignored;
    for (const fs::path& base : {environmentPath("TMPDIR").value_or("/tmp"), fs::path("/tmp"),
                                 fs::path("/var/tmp"), fs::path("/dev/shm")})
      if (fs::is_directory(base, ignored) && !whyUnusableForPocl(base) && makeIn(fs::absolute(base, ignored)))
        return;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty() && ::getpid() == owner_) fs::remove_all(path_, ignored);
    if (lock_ >= 0) ::close(lock_);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  bool makeIn(const fs::path& base) {
    removeAbandoned(base);
    std::string name = base / (std::string(temporaryPrefix) + "XXXXXX");
    if (::mkdtemp(name.data()) == nullptr) return false;
    path_ = name;
    lock_ = lockedFile(path_, O_CREAT);
    return true;
  }

  fs::path path_;
  int lock_ = -1;
  pid_t owner_ = ::getpid();  ///< forked processes share the folder but do not remove it
};

std::string describePoclCache(const fs::path& folder, const std::string& reason) {
  return fmt::format("PoCL cannot keep kernels in {}: {}", folder.empty() ? "\"\"" : folder.string(), reason);
}

std::optional<PoclCacheReplacement> replaceWhereUnusable() {
  const fs::path folder = poclCacheFolder();
  const std::optional<std::string> reason = whyUnusableForPocl(folder);
  if (!reason) return std::nullopt;
  static const TemporaryFolder temporary;  // outlives PoCL, which is loaded later
  if (!temporary.path().empty()) ::setenv(variable, temporary.path().c_str(), 1);
  return PoclCacheReplacement{describePoclCache(folder, *reason), temporary.path()};
}

}  // namespace

std::optional<std::string> whyUnusableForPocl(const fs::path& folder) {
  if (folder.empty()) return "the name is empty";
  if (folder.native().size() > longestPath)
    return fmt::format("the name has {} characters, at most {} are possible", folder.native().size(),
                       longestPath);
  const fs::path there = nearestThere(folder);
  std::error_code error;
  if (!fs::is_directory(there, error)) return fmt::format("{} is not a folder", there.string());
  struct statvfs system {};
  if (::statvfs(there.c_str(), &system) != 0) return reasonOf(errno);
  if ((system.f_flag & ST_NOEXEC) != 0) return "its file system does not let code run (noexec)";
  const std::uint64_t space = std::uint64_t{system.f_bavail} * system.f_frsize;
  if (const int failure = tryToWrite(there); failure != 0) return reasonOf(failure);
  if (space < leastSpace)
    return fmt::format("{:.1f} MiB of its file system are free, kernels may take {} MiB",
                       static_cast<double>(space) / (1 << 20), leastSpace >> 20);
  return std::nullopt;
}

fs::path poclCacheFolder() {
  if (const auto named = environmentPath(variable)) return *named;
  const char* keeps = std::getenv("POCL_KERNEL_CACHE");
  const fs::path name = keeps != nullptr && std::string_view(keeps) == "0" ? "pocl/uncached" : "pocl/kcache";
  if (const auto cache = environmentPath("XDG_CACHE_HOME"); cache && !cache->empty()) return *cache / name;
  if (const auto home = environmentPath("HOME")) return fs::path(home->native() + "/.cache") / name;
  return "/tmp" / name;
}

const std::optional<PoclCacheReplacement>& replaceUnusablePoclCache() {
  static const std::optional<PoclCacheReplacement> replacement = replaceWhereUnusable();
  return replacement;
}

std::optional<std::string> poclCacheWarning() {
  const std::optional<PoclCacheReplacement>& replacement = replaceUnusablePoclCache();
  if (!replacement) return std::nullopt;
  const std::string instead = replacement->folder.empty()
                                  ? "nor can it in TMPDIR, /tmp, /var/tmp or /dev/shm"
                                  : "they are compiled anew for this run, in " + replacement->folder.string();
  return fmt::format("{}; {} (set {} to a folder that takes them)", replacement->problem, instead, variable);
}

std::optional<std::string> problemOfPoclCache() {
  const fs::path folder = poclCacheFolder();
  const std::optional<std::string> reason = whyUnusableForPocl(folder);
  if (!reason) return std::nullopt;
  return describePoclCache(folder, *reason);
}

}  // namespace prelight
