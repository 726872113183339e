#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "architecture/source_files.h"

namespace prelight {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> documents() {
  std::vector<std::string> files = test::filesBelow("docs", {".md"});
  files.emplace_back("README.md");
  files.emplace_back("CONTRIBUTING.md");
  return files;
}

/// First groups of all matches.
std::vector<std::string> matchesIn(const std::string& text, const std::string& pattern) {
  const std::regex expression(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), expression), end; at != end; ++at)
    found.push_back((*at)[1]);
  return found;
}

/// Files are named from the root, or from where includes begin.
bool existsBelowAny(const std::string& name) {
  constexpr std::array<const char*, 8> bases = {"",       "host",  "host/include", "kernels",
                                                "viewer", "tests", "benchmarks",   "benchmarks/lab"};
  return std::any_of(bases.begin(), bases.end(),
                     [&](const char* base) { return fs::exists(test::sourceRoot() / base / name); });
}

TEST(Documents, Links_LeadToFiles) {
  for (const std::string& document : documents()) {
    for (const std::string& link : matchesIn(test::textOf(document), "\\]\\(([^)#: ]+)[)# ]")) {
      EXPECT_TRUE(fs::exists((test::sourceRoot() / document).parent_path() / link))
          << document << " links to " << link;
    }
  }
}

TEST(Documents, SourcesThatTheyName_Exist) {
  std::size_t named = 0;
  for (const std::string& document : documents()) {
    const std::vector<std::string> files = matchesIn(
        test::textOf(document), "\\b((?:host|kernels|viewer|tests|benchmarks|python)/[a-z0-9_/]+(?:\\.[a-z]+)?)");
    for (const std::string& file : files) EXPECT_TRUE(existsBelowAny(file)) << document << " names " << file;
    named += files.size();
  }
  EXPECT_GT(named, 50u);
}

TEST(Sources, FilesThatTheirCommentsName_Exist) {
  std::size_t named = 0;
  for (const char* folder : {"host", "kernels", "viewer", "benchmarks", "python", "tests"}) {
    for (const std::string& source :
         test::filesBelow(folder, {".h", ".cpp", ".cl", ".glsl", ".frag", ".vert", ".py"})) {
      const std::vector<std::string> files =
          matchesIn(test::textOf(source),
                    "//[^\\n\"]*?\\b((?:docs|[a-z_]+)/[a-zA-Z0-9_/-]+\\.(?:h|cl|cpp|md|glsl|frag|json))\\b");
      for (const std::string& file : files) EXPECT_TRUE(existsBelowAny(file)) << source << " names " << file;
      named += files.size();
    }
  }
  EXPECT_GT(named, 50u);
}

}  // namespace
}  // namespace prelight
