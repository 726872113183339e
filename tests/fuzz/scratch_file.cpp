#include "fuzz/scratch_file.h"

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <string>
#include <system_error>

namespace prelight::fuzz {

namespace fs = std::filesystem;

namespace {

/// Returns the path of a new folder that only this user may enter.
fs::path makeFolder() {
  std::string name = (fs::temp_directory_path() / "prelight-fuzz-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::system_error(errno, std::generic_category(), name);
  return name;
}

}  // namespace

ScratchFolder::ScratchFolder() : path_(makeFolder()) {}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

ScratchFile::ScratchFile(const char* name, Bytes content) : path_(folder_ / name) {
  std::ofstream file(path_, std::ios::binary);
  file.write(reinterpret_cast<const char*>(content.data()), static_cast<std::streamsize>(content.size()));
  file.close();
  if (!file) throw std::system_error(errno, std::generic_category(), path_.string());
}

}  // namespace prelight::fuzz
