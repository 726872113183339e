#include "device/kernel_source.h"

#include <fmt/format.h>

#include <charconv>
#include <sstream>
#include <string_view>
#include <vector>

#include "base/text.h"
#include "prelight/error.h"

namespace prelight {

namespace {

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

std::string nameSourceFiles(const std::string& log, const std::string& expanded) {
  std::vector<std::string> places;  // file and line of each line of the expanded source
  std::istringstream lines(expanded);
  std::string file;
  int number = 0;
  for (std::string line; std::getline(lines, line); ++number) {
    places.push_back(fmt::format("{}:{}", file, number));
    if (line.rfind("#line ", 0) != 0) continue;
    number = std::stoi(line.substr(6)) - 1;
    const auto open = line.find('"');
    file = line.substr(open + 1, line.rfind('"') - open - 1);
  }
  constexpr std::string_view place = "<kernel>:";
  std::string named;
  std::size_t from = 0;
  for (std::size_t found = log.find(place); found != std::string::npos; found = log.find(place, found + 1)) {
    std::size_t line = 0;
    const char* digits = log.data() + found + place.size();
    const auto [end, failure] = std::from_chars(digits, log.data() + log.size(), line);
    if (failure != std::errc() || line < 1 || line > places.size()) continue;
    named.append(log, from, found - from);
    named += places[line - 1];
    from = static_cast<std::size_t>(end - log.data());
  }
  return named.append(log, from);
}

}  // namespace prelight
