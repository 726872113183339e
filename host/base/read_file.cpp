#include "base/read_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "prelight/error.h"

namespace prelight {

namespace fs = std::filesystem;

std::vector<std::uint8_t> readFileBytes(const fs::path& path, const std::string& where, std::uint64_t limit) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw InputError(where, fmt::format("no such file: {}", path.string()));
  if (!fs::is_regular_file(status))
    throw InputError(where, fmt::format("not a regular file: {}", path.string()));
  const std::uint64_t size = std::min<std::uint64_t>(fs::file_size(path, error), limit);
  std::ifstream file(path, std::ios::binary);
  if (error || !file)
    throw InputError(where, fmt::format("cannot read {}", path.string()), "check its permissions");
  std::vector<std::uint8_t> bytes(size);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

}  // namespace prelight
