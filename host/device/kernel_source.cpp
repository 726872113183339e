#include "device/kernel_source.h"

#include <fmt/format.h>

#include <sstream>

#include "prelight/error.h"

namespace prelight {

namespace {

/// The quoted path of an include line; empty for any other line.
std::string includedPath(const std::string& line) {
  const auto start = line.find_first_not_of(" \t");
  if (start == std::string::npos || line.compare(start, 8, "#include") != 0) return {};
  const auto open = line.find('"', start + 8);
  const auto close = open == std::string::npos ? open : line.find('"', open + 1);
  return close == std::string::npos ? std::string() : line.substr(open + 1, close - open - 1);
}

class Expander {
 public:
  explicit Expander(const std::map<std::string, std::string>& sources) : sources_(sources) {}

  void expand(const std::string& file, const std::string& from, std::string& out) {
    const auto found = sources_.find(file);
    if (found == sources_.end())
      throw Error(ExitCode::RuntimeFailure, from, fmt::format("no embedded kernel file \"{}\"", file));
    out += fmt::format("#line 1 \"{}\"\n", file);
    std::istringstream lines(found->second);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
      const std::string path = includedPath(line);
      if (path.empty()) {
        out += line + '\n';
        continue;
      }
      if (depth_ > 32)
        throw Error(ExitCode::RuntimeFailure, file, "kernel files include each other in a circle");
      ++depth_;
      expand(path, fmt::format("{}:{}", file, number), out);
      --depth_;
      out += fmt::format("#line {} \"{}\"\n", number + 1, file);
    }
  }

 private:
  const std::map<std::string, std::string>& sources_;
  int depth_ = 0;
};

}  // namespace

std::string expandKernelSource(const std::string& file, const std::map<std::string, std::string>& sources) {
  std::string out;
  Expander(sources).expand(file, "kernels", out);
  return out;
}

}  // namespace prelight
