#include "base/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <system_error>

#include "prelight/error.h"

namespace prelight {

void refuseSpecialFile(const std::filesystem::path& path) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const char* kind = nullptr;
  switch (fs::status(path, ignored).type()) {
    case fs::file_type::fifo:
      kind = "a pipe";
      break;
    case fs::file_type::socket:
      kind = "a socket";
      break;
    case fs::file_type::character:
    case fs::file_type::block:
      kind = "a device";
      break;
    default:
      return;
  }
  throw InputError(path.string(), std::string("is ") + kind + ", expected a file",
                   "write its contents into a file");
}

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
  if (file.bad())
    throw InputError(where, fmt::format("cannot read {}: the system reports an error", path.string()),
                     "check the disk, or the connection to it");
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

}  // namespace prelight
