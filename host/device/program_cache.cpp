#include "device/program_cache.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/evp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <string_view>
#include <system_error>

namespace prelight {

namespace fs = std::filesystem;

namespace {

constexpr mode_t ownerFolder = 0700, ownerFile = 0600, othersWrite = S_IWGRP | S_IWOTH;

/// Closes a file descriptor at the end of its scope.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

bool writeAll(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

std::string writableByOthers(const fs::path& folder) {
  return fmt::format("{} can be written to by others (look at what is in it, then chmod 700)",
                     folder.string());
}

}  // namespace

std::optional<std::string> refusalOfCache(const fs::path& folder) {
  struct stat status {};
  if (::stat(folder.c_str(), &status) == 0) {
    if (!S_ISDIR(status.st_mode)) return fmt::format("{} is not a folder", folder.string());
    if (status.st_uid != ::geteuid()) return fmt::format("{} belongs to another user", folder.string());
    if ((status.st_mode & othersWrite) != 0) return writableByOthers(folder);
  }
  // Users who may rename within the parent folder can replace the folder.
  const fs::path above = folder.parent_path();
  if (!above.empty() && ::stat(above.c_str(), &status) == 0) {
    if (status.st_uid != ::geteuid() && status.st_uid != 0)
      return fmt::format("{} belongs to another user", above.string());
    if ((status.st_mode & othersWrite) != 0 && (status.st_mode & S_ISVTX) == 0)
      return writableByOthers(above);
  }
  return std::nullopt;
}

bool makePrivateFolders(const fs::path& folder) {
  std::error_code ignored;
  if (folder.empty() || fs::is_directory(folder, ignored)) return !folder.empty();
  if (folder.has_parent_path() && folder.parent_path() != folder && !makePrivateFolders(folder.parent_path()))
    return false;
  return ::mkdir(folder.c_str(), ownerFolder) == 0 || fs::is_directory(folder, ignored);
}

std::optional<std::string> readOwnFile(const fs::path& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (file.number() < 0 || ::fstat(file.number(), &status) != 0 || !S_ISREG(status.st_mode) ||
      status.st_uid != ::geteuid() || (status.st_mode & othersWrite) != 0)
    return std::nullopt;
  std::string bytes;
  std::array<char, 1 << 16> part{};
  for (;;) {
    const ssize_t count = ::read(file.number(), part.data(), part.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return std::nullopt;
    if (count == 0) return bytes;
    bytes.append(part.data(), static_cast<std::size_t>(count));
  }
}

bool writeOwnFile(const fs::path& path, const std::string& bytes) {
  fs::path temporary = path;
  temporary += fmt::format(".{}", ::getpid());
  ::unlink(temporary.c_str());  // left by an ended process with the same number
  bool written = false;
  {
    const Descriptor file(
        ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, ownerFile));
    if (file.number() < 0) return false;
    written = writeAll(file.number(), bytes);
  }
  if (written && ::rename(temporary.c_str(), path.c_str()) == 0) return true;
  ::unlink(temporary.c_str());
  return false;
}

namespace fs = std::filesystem;

namespace {

constexpr const char* binaryMagic = "PRELIGHT-KERNEL-1";

/// Returns the first line of an entry, which identifies the payload.
std::string headerOf(const std::string& key, const std::string& payload) {
  return fmt::format("{} {} {} {}\n", binaryMagic, key, payload.size(), sha256(payload));
}

}  // namespace

std::string sha256(const std::string& text) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  EVP_Digest(text.data(), text.size(), digest.data(), &length, EVP_sha256(), nullptr);
  std::string hex;
  for (unsigned int i = 0; i < length; ++i) hex += fmt::format("{:02x}", digest[i]);
  return hex;
}

fs::path ProgramCache::defaultFolder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache == '/')
    return fs::path(cache) / "prelight" / "kernels";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    return fs::path(home) / ".cache" / "prelight" / "kernels";
  return {};
}

std::optional<std::vector<unsigned char>> ProgramCache::load(const std::string& key) const {
  if (folder_.empty() || refusalOfCache(folder_)) return std::nullopt;
  const std::optional<std::string> entry = readOwnFile(folder_ / key);
  if (!entry) return std::nullopt;
  const std::size_t end = entry->find('\n');
  if (end == std::string::npos) return std::nullopt;
  const std::string payload = entry->substr(end + 1);
  if (entry->substr(0, end + 1) != headerOf(key, payload)) return std::nullopt;
  return std::vector<unsigned char>(payload.begin(), payload.end());
}

void ProgramCache::store(const std::string& key, const std::vector<unsigned char>& binary) const {
  if (folder_.empty() || !makePrivateFolders(folder_) || refusalOfCache(folder_)) return;
  const std::string payload(binary.begin(), binary.end());
  writeOwnFile(folder_ / key, headerOf(key, payload) + payload);
}

void ProgramCache::remove(const std::string& key) const {
  std::error_code ignored;
  if (!folder_.empty()) fs::remove(folder_ / key, ignored);
}

}  // namespace prelight
