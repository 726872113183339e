#include "benchmarks/run/work_folder.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "prelight/error.h"

namespace prelight::benchmarks {

WorkFolder::WorkFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "prelight-bench-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    throw Error(ExitCode::RuntimeFailure, name,
                fmt::format("cannot make this folder: {}", std::generic_category().message(errno)),
                "set TMPDIR to a folder that can be written to");
  path_ = name;
}

WorkFolder::~WorkFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace prelight::benchmarks
