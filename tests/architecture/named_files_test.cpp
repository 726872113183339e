#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <map>
#include <regex>
#include <sstream>
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
  files.emplace_back("SECURITY.md");
  return files;
}

/// The first capture group of every match.
std::vector<std::string> matchesIn(const std::string& text, const std::string& pattern) {
  const std::regex expression(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), expression), end; at != end; ++at)
    found.push_back((*at)[1]);
  return found;
}

/// Whether a file exists by a name written relative to the root or to an include folder.
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

/// The anchor that a heading has: lower case, without links, code marks and punctuation, dashes for spaces.
std::string anchorOf(const std::string& heading) {
  const std::string plain = std::regex_replace(heading, std::regex("\\[([^\\]]*)\\]\\([^)]*\\)"), "$1");
  std::string anchor;
  for (const char c : plain) {
    const auto code = static_cast<unsigned char>(c);
    if (c == ' ') anchor += '-';
    if (std::isalnum(code) != 0 || c == '-' || c == '_' || code > 127)
      anchor += static_cast<char>(std::tolower(code));
  }
  return anchor;
}

/// Anchors of a document's headings. Lines of code that begin with # are none.
std::vector<std::string> anchorsOf(const std::string& document) {
  std::istringstream lines(test::textOf(document));
  std::vector<std::string> anchors;
  bool code = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) code = !code;
    const std::size_t level = line.find_first_not_of('#');
    if (!code && level > 0 && level != std::string::npos && line[level] == ' ')
      anchors.push_back(anchorOf(line.substr(level + 1)));
  }
  return anchors;
}

TEST(Documents, LinksToHeadings_LeadToHeadings) {
  std::size_t links = 0;
  std::map<std::string, std::vector<std::string>> anchors;  // [document]
  for (const std::string& document : documents()) {
    const std::string text = test::textOf(document);
    const std::regex link("\\]\\(([^)#: ]*\\.md)?#([^) ]+)\\)");
    for (std::sregex_iterator at(text.begin(), text.end(), link), end; at != end; ++at) {
      const fs::path other = fs::path(document).parent_path() / (*at)[1].str();
      const std::string target = (*at)[1].matched ? other.lexically_normal().generic_string() : document;
      const auto [known, isNew] = anchors.try_emplace(target);
      if (isNew) known->second = anchorsOf(target);
      EXPECT_GT(std::count(known->second.begin(), known->second.end(), (*at)[2].str()), 0)
          << document << " links to " << (*at)[0].str();
      ++links;
    }
  }
  EXPECT_GT(links, 100u);
}

/// Names of the pages of a folder but for its index.
std::vector<std::string> pagesOf(const char* folder) {
  std::vector<std::string> pages;
  for (const auto& entry : fs::directory_iterator(test::sourceRoot() / folder))
    if (entry.path().extension() == ".md" && entry.path().filename() != "README.md")
      pages.push_back(entry.path().filename().string());
  return pages;
}

/// The page of a technique may be named by the reference of options alone.
TEST(Documents, Indexes_NameEveryPage) {
  const std::string reference = test::textOf("docs/command-line.md");
  for (const char* folder : {"docs", "docs/notes"}) {
    const std::string index = test::textOf(std::string(folder) + "/README.md");
    for (const std::string& page : pagesOf(folder))
      EXPECT_TRUE(index.find("](" + page + ")") != std::string::npos ||
                  reference.find("](notes/" + page + ")") != std::string::npos)
          << folder << "/" << page;
  }
}

/// The manual is read in an evening: what is measured, derived and tried belongs to the notes.
TEST(Documents, Manual_HasAtMost45ThousandWords) {
  std::size_t words = 0;
  for (const std::string& page : pagesOf("docs")) {
    std::istringstream text(test::textOf("docs/" + page));
    for (std::string word; text >> word;) ++words;
  }
  EXPECT_GT(words, 10'000u);
  EXPECT_LE(words, 45'000u);
}

TEST(Documents, SourcesThatTheyName_Exist) {
  std::size_t named = 0;
  for (const std::string& document : documents()) {
    const std::vector<std::string> files =
        matchesIn(test::textOf(document),
                  "\\b((?:host|kernels|viewer|tests|benchmarks|python)/[a-z0-9_/]+(?:\\.[a-z]+)?)");
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
