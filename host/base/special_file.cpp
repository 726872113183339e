#include "base/special_file.h"

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

}  // namespace prelight
