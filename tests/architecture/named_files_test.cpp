#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace prelight {
namespace {

namespace fs = std::filesystem;

const fs::path root = PRELIGHT_SOURCE_DIR;

std::string textOf(const fs::path& file) {
  std::ifstream in(file);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<fs::path> filesBelow(const fs::path& folder, const std::set<std::string>& extensions) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (extensions.count(entry.path().extension().string()) > 0) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<fs::path> documents() {
  std::vector<fs::path> files = filesBelow(root / "docs", {".md"});
  files.push_back(root / "README.md");
  files.push_back(root / "CONTRIBUTING.md");
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
  constexpr std::array<const char*, 5> bases = {"", "host", "kernels", "viewer", "tests"};
  return std::any_of(bases.begin(), bases.end(),
                     [&](const char* base) { return fs::exists(root / base / name); });
}

TEST(Documents, Links_LeadToFiles) {
  for (const fs::path& document : documents()) {
    for (const std::string& link : matchesIn(textOf(document), "\\]\\(([^)#: ]+)[)# ]")) {
      EXPECT_TRUE(fs::exists(document.parent_path() / link)) << document << " links to " << link;
    }
  }
}

TEST(Documents, SourcesThatTheyName_Exist) {
  std::size_t named = 0;
  for (const fs::path& document : documents()) {
    const std::vector<std::string> files = matchesIn(
        textOf(document), "\\b((?:host|kernels|viewer|tests|benchmarks)/[a-z0-9_/]+(?:\\.[a-z]+)?)");
    for (const std::string& file : files) EXPECT_TRUE(existsBelowAny(file)) << document << " names " << file;
    named += files.size();
  }
  EXPECT_GT(named, 50u);
}

TEST(Sources, FilesThatTheirCommentsName_Exist) {
  std::size_t named = 0;
  for (const char* folder : {"host", "kernels", "viewer", "benchmarks", "tests"}) {
    for (const fs::path& source :
         filesBelow(root / folder, {".h", ".cpp", ".cl", ".glsl", ".frag", ".vert", ".py"})) {
      const std::vector<std::string> files =
          matchesIn(textOf(source),
                    "//[^\\n\"]*?\\b((?:docs|[a-z_]+)/[a-zA-Z0-9_/-]+\\.(?:h|cl|cpp|md|glsl|frag|json))\\b");
      for (const std::string& file : files) EXPECT_TRUE(existsBelowAny(file)) << source << " names " << file;
      named += files.size();
    }
  }
  EXPECT_GT(named, 50u);
}

}  // namespace
}  // namespace prelight
