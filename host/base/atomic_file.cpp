#include "base/atomic_file.h"

namespace prelight {

void OutputFiles::add(const std::filesystem::path& path, std::span<const std::span<const std::byte>> pieces) {
  PendingFile& file = files_.emplace_back(path);
  for (const std::span<const std::byte> piece : pieces) file.write(piece);
  file.close();
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
}

void writeFileAtomically(const std::filesystem::path& path,
                         std::span<const std::span<const std::byte>> pieces) {
  OutputFiles files;
  files.add(path, pieces);
  files.commit();
}

}  // namespace prelight
