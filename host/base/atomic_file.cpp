#include "base/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/state_file.h"
#include "prelight/error.h"

namespace prelight {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view prefix = ".prelight-";

/// Returns what a file holds, as far as it can be read.
std::string textOf(const std::string& path) {
  const std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();  // unlike an iterator of the buffer it throws nothing when a read fails
  return text.str();
}

/// Returns when a process began, in ticks since the machine's start; 0 if there is none or it is unknown.
std::uint64_t startOf(std::uint64_t process) {
  const std::string text = textOf(fmt::format("/proc/{}/stat", process));
  // The name, in brackets, may contain anything.
  const std::size_t name = text.rfind(')');
  if (name == std::string::npos) return 0;
  constexpr int fieldsBetween = 20;
  std::size_t at = name;
  for (int i = 0; i < fieldsBetween && at != std::string::npos; ++i) at = text.find(' ', at + 1);
  if (at == std::string::npos) return 0;
  std::uint64_t start = 0;
  std::from_chars(text.data() + at + 1, text.data() + text.size(), start);
  return start;
}

/// Returns a name that distinguishes machines, their starts, and containers, which cannot see each other's
/// processes.
std::string placeOfProcesses() {
  const std::string boot = textOf("/proc/sys/kernel/random/boot_id");
  std::error_code ignored;
  const fs::path names = fs::read_symlink("/proc/self/ns/pid", ignored);
  return fmt::format("{:08x}", StateHash().text(boot).text(names.string()).result() & 0xffffffffu);
}

/// The parts of a temporary name after the prefix: PLACE-PROCESS-START-NUMBER.
struct Maker {
  std::string_view place;
  std::uint64_t process = 0;
  std::uint64_t start = 0;
};

std::optional<Maker> makerOf(std::string_view name) {
  if (!name.starts_with(prefix)) return std::nullopt;
  name.remove_prefix(prefix.size());
  Maker maker;
  maker.place = name.substr(0, name.find('-'));
  name.remove_prefix(std::min(name.size(), maker.place.size() + 1));
  for (std::uint64_t* part : {&maker.process, &maker.start}) {
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), *part);
    if (error != std::errc() || end == name.data() + name.size() || *end != '-') return std::nullopt;
    name.remove_prefix(static_cast<std::size_t>(end - name.data()) + 1);
  }
  return maker;
}

}  // namespace

std::string temporaryName(int number) {
  const auto process = static_cast<std::uint64_t>(::getpid());
  return fmt::format("{}{}-{}-{}-{}", prefix, placeOfProcesses(), process, startOf(process), number);
}

void removeAbandonedFiles(const fs::path& folder) {
  const std::string place = placeOfProcesses();
  std::error_code ignored;
  for (fs::directory_iterator entry(folder, ignored), end; entry != end; entry.increment(ignored)) {
    const std::string name = entry->path().filename().string();
    const std::optional<Maker> maker = makerOf(name);
    if (!maker || maker->place != place || maker->start == 0) continue;
    if (startOf(maker->process) == maker->start) continue;
    std::error_code failed;
    if (entry->is_regular_file(failed)) fs::remove(entry->path(), failed);
  }
}

namespace fs = std::filesystem;

namespace {

constexpr int mostLinks = 40;  // limit of Linux
constexpr mode_t permissionBits = 0777;
const char* const descriptorsFolder = "/proc/self/fd/";

[[noreturn]] void failToWrite(const std::string& shown, const std::string& reason) {
  throw Error(ExitCode::RuntimeFailure, shown, "cannot write: " + reason,
              "check the folder, its permissions and free space");
}

/// Returns the target of a chain of symbolic links, whether it exists or not.
fs::path withoutLinks(const fs::path& path, const std::string& shown) {
  fs::path target = path;
  for (int i = 0; i < mostLinks; ++i) {
    std::error_code error;
    if (!fs::is_symlink(target, error)) return target;
    const fs::path next = fs::read_symlink(target, error);
    if (error) failToWrite(shown, error.message());
    target = next.is_absolute() ? next : target.parent_path() / next;
  }
  failToWrite(shown, std::strerror(ELOOP));
}

fs::path folderOf(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// Returns the status of the file that is to be replaced, if it exists.
std::optional<struct stat> statusOf(const std::string& shown, const fs::path& target) {
  struct stat status {};
  if (target.filename().empty()) failToWrite(shown, "no file name");
  if (::stat(target.c_str(), &status) != 0) {
    if (errno != ENOENT) failToWrite(shown, std::strerror(errno));
    return std::nullopt;
  }
  if (S_ISDIR(status.st_mode)) failToWrite(shown, "it is a folder");
  if (!S_ISREG(status.st_mode)) failToWrite(shown, "it is not a regular file");
  return status;
}

/// Checks the length of the target's name, because the temporary's name is short and opening it does not.
void checkName(const std::string& shown, const fs::path& target) {
  const long most = ::pathconf(folderOf(target).c_str(), _PC_NAME_MAX);
  if (most > 0 && target.filename().string().size() > static_cast<std::size_t>(most))
    failToWrite(shown, std::strerror(ENAMETOOLONG));
}

/// Returns true when this folder is available, by which unnamed files get a name.
bool namesDescriptors() { return ::access(descriptorsFolder, X_OK) == 0; }

}  // namespace

PendingFile::PendingFile(const fs::path& path, std::optional<mode_t> permissions, const std::string& shown)
    : shown_(shown.empty() ? path.string() : shown), target_(withoutLinks(path, shown_)) {
  std::error_code ignored;
  const fs::path folder = folderOf(target_);
  if (!fs::is_directory(folder, ignored)) failToWrite(shown_, "no such folder " + folder.string());
  const std::optional<struct stat> older = statusOf(shown_, target_);
  checkName(shown_, target_);
  const mode_t narrow = S_IRUSR | S_IWUSR, usual = narrow | S_IRGRP | S_IWGRP | S_IROTH | S_IWOTH;
  const mode_t mode = older || permissions ? narrow : usual;
  if (namesDescriptors()) descriptor_ = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, mode);
  if (descriptor_ < 0) openNamed(folder, mode);
  // The owner of the replaced file is kept where the system permits it, as for root.
  if (older && (older->st_uid != ::geteuid() || older->st_gid != ::getegid()) &&
      ::fchown(descriptor_, older->st_uid, older->st_gid) != 0)
    errno = 0;
  if (permissions || older)
    ::fchmod(descriptor_, permissions.value_or(older ? older->st_mode & permissionBits : narrow));
}

void PendingFile::openNamed(const fs::path& folder, mode_t mode) {
  for (int number = 0; descriptor_ < 0; ++number) {
    temporary_ = folder / temporaryName(number);
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (descriptor_ < 0 && errno != EEXIST) fail(errno);
  }
}

PendingFile::PendingFile(PendingFile&& other) noexcept
    : shown_(std::move(other.shown_)),
      target_(std::move(other.target_)),
      temporary_(std::move(other.temporary_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      state_(std::exchange(other.state_, State::Gone)) {}

PendingFile::~PendingFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty() &&
      (state_ == State::Open || state_ == State::Complete || state_ == State::Exchanged))
    ::unlink(temporary_.c_str());
}

void PendingFile::fail(int error) const {
  failToWrite(shown_, error != 0 ? std::strerror(error) : "the file system refused");
}

void PendingFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail(count < 0 ? errno : ENOSPC);
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
}

void PendingFile::overwrite(std::uint64_t offset, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail(count < 0 ? errno : ENOSPC);
    bytes = bytes.subspan(static_cast<std::size_t>(count));
    offset += static_cast<std::uint64_t>(count);
  }
}

int PendingFile::openAgain() const {
  const std::string own = descriptorsFolder + std::to_string(descriptor_);
  const int descriptor = ::open(temporary_.empty() ? own.c_str() : temporary_.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) fail(errno);
  return descriptor;
}

// File systems report delayed write errors when a descriptor is closed. Some cannot wait for the disk.
void PendingFile::close() {
  if (::fdatasync(descriptor_) != 0 && errno != EINVAL && errno != ENOSYS && errno != ENOTSUP) fail(errno);
  if (!temporary_.empty()) {
    closeDescriptor();
  } else {
    const int another = ::dup(descriptor_);
    if (another >= 0 && ::close(another) != 0) fail(errno);
  }
  state_ = State::Complete;
}

void PendingFile::closeDescriptor() {
  if (descriptor_ >= 0 && ::close(std::exchange(descriptor_, -1)) != 0) fail(errno);
}

/// Gives an unnamed file a name. Returns false if another file has it.
bool PendingFile::linkTo(const fs::path& path) const {
  const std::string own = descriptorsFolder + std::to_string(descriptor_);
  if (::linkat(AT_FDCWD, own.c_str(), AT_FDCWD, path.c_str(), AT_SYMLINK_FOLLOW) == 0) return true;
  if (errno != EEXIST) fail(errno);
  return false;
}

void PendingFile::takeName() {
  if (!temporary_.empty()) return;
  fs::path name;
  int number = 0;
  do name = folderOf(target_) / temporaryName(number++);
  while (!linkTo(name));
  temporary_ = std::move(name);
  closeDescriptor();
}

void PendingFile::moveIn(bool revocable) {
  const bool replaces = statusOf(shown_, target_).has_value();  // exchanging would replace a folder, too
  if (!replaces && temporary_.empty() && linkTo(target_)) {
    state_ = State::Created;
    return closeDescriptor();
  }
  takeName();
  if (revocable && replaces &&
      ::renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0) {
    state_ = State::Exchanged;
    return;
  }
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  state_ = replaces ? State::Replaced : State::Created;
}

void PendingFile::moveOut() noexcept {
  if (state_ == State::Exchanged &&
      ::renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0)
    state_ = State::Complete;
  if (state_ == State::Created && ::unlink(target_.c_str()) == 0) state_ = State::Gone;
}

void checkWritable(const fs::path& path, const std::string& shown) {
  removeAbandonedFiles(folderOf(path));
  const PendingFile file(path, std::nullopt, shown);
}

OutputFiles::OutputFiles(const std::filesystem::path& folder, FileWork work) : work_(work) {
  if (folder.empty() || work == FileWork::Count) return;
  std::error_code error;
  if (std::filesystem::create_directory(folder, error)) madeFolder_ = folder;
  if (error)
    throw Error(ExitCode::RuntimeFailure, folder.string(), "cannot make the folder: " + error.message());
}

OutputFiles::~OutputFiles() {
  files_.clear();
  std::error_code ignored;
  if (!madeFolder_.empty()) std::filesystem::remove(madeFolder_, ignored);  // removes only an empty folder
}

void OutputFiles::add(const std::filesystem::path& path, std::span<const std::span<const std::byte>> pieces) {
  for (const std::span<const std::byte> piece : pieces) bytes_[path] += piece.size();
  if (work_ == FileWork::Count) return;
  PendingFile& file = files_.emplace_back(path);
  for (const std::span<const std::byte> piece : pieces) file.write(piece);
  file.close();
  // Descriptors are scarcer than names.
  constexpr std::size_t mostWithoutName = 8;
  if (files_.size() > mostWithoutName) file.takeName();
}

void OutputFiles::commit() {
  std::size_t moved = 0;
  try {
    for (; moved < files_.size(); ++moved) files_[moved].moveIn(files_.size() > 1);
  } catch (...) {
    while (moved > 0) files_[--moved].moveOut();
    throw;
  }
  files_.clear();
  madeFolder_.clear();
}

std::uint64_t OutputFiles::bytesOf(const std::filesystem::path& path) const {
  const auto found = bytes_.find(path);
  return found == bytes_.end() ? 0 : found->second;
}

void writeFileAtomically(const std::filesystem::path& path,
                         std::span<const std::span<const std::byte>> pieces) {
  OutputFiles files;
  files.add(path, pieces);
  files.commit();
}

}  // namespace prelight
