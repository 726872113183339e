#include "io/atomic_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>

#include "base/error.h"

namespace prelight {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void failToWrite(const fs::path& path, const std::string& reason) {
  throw Error(ExitCode::RuntimeFailure, path.string(), "cannot write: " + reason,
              "check the folder, its permissions and free space");
}

/// Unique among the threads of this process and, through its id, among processes.
fs::path temporaryBeside(const fs::path& path) {
  const std::size_t thread = std::hash<std::thread::id>()(std::this_thread::get_id());
  const std::string tag = std::to_string(getpid()) + '-' + std::to_string(thread);
  return path.parent_path() / ('.' + path.stem().string() + '.' + tag + path.extension().string());
}

class RemoveUnlessKept {
 public:
  explicit RemoveUnlessKept(fs::path path) : path_(std::move(path)) {}
  RemoveUnlessKept(const RemoveUnlessKept&) = delete;
  RemoveUnlessKept& operator=(const RemoveUnlessKept&) = delete;
  ~RemoveUnlessKept() {
    std::error_code ignored;
    if (!kept_) fs::remove(path_, ignored);
  }
  void keep() { kept_ = true; }

 private:
  fs::path path_;
  bool kept_ = false;
};

}  // namespace

void writeFileAtomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  std::error_code error;
  fs::path target = path;
  if (fs::is_symlink(path, error)) {
    target = fs::weakly_canonical(path, error);
    if (error) failToWrite(path, error.message());
  }
  const fs::file_status status = fs::status(target, error);
  if (fs::is_directory(status)) failToWrite(path, "it is a folder");
  if (target.filename().empty()) failToWrite(path, "no file name");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    write(target);
    return;
  }
  const fs::path parent = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(parent, error)) failToWrite(path, "no such folder " + parent.string());

  const fs::path temporary = temporaryBeside(target);
  RemoveUnlessKept guard(temporary);
  write(temporary);
  fs::rename(temporary, target, error);
  if (error) failToWrite(path, error.message());
  guard.keep();
}

void writeFileAtomically(const fs::path& path, std::span<const std::span<const std::byte>> pieces) {
  writeFileAtomically(path, [&](const fs::path& temporary) {
    errno = 0;
    std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
    for (const std::span<const std::byte> piece : pieces) {
      file.write(reinterpret_cast<const char*>(piece.data()), static_cast<std::streamsize>(piece.size()));
    }
    file.close();
    if (!file) failToWrite(path, errno != 0 ? std::strerror(errno) : "the file system refused");
  });
}

}  // namespace prelight
