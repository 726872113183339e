#include "device/kernel_source.h"

#include <fmt/format.h>

#include <regex>
#include <sstream>
#include <vector>

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

std::string nameSourceFiles(const std::string& log, const std::string& expanded) {
  std::vector<std::string> places;  // of each line of the expanded source
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
  const std::regex place("<kernel>:([0-9]{1,9})");
  std::string named;
  auto from = log.begin();
  for (std::sregex_iterator found(log.begin(), log.end(), place), end; found != end; ++found) {
    const auto line = static_cast<std::size_t>(std::stoul((*found)[1]));
    named.append(from, (*found)[0].first);
    named += line >= 1 && line <= places.size() ? places[line - 1] : found->str();
    from = (*found)[0].second;
  }
  return named.append(from, log.end());
}

}  // namespace prelight
