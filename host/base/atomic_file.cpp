#include "base/atomic_file.h"

#include <system_error>

#include "prelight/error.h"

namespace prelight {

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
