#include <gmock/gmock.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "architecture/source_files.h"
#include "cli/cli_test.h"

// The reference of options has every option of the program and no other, and commands of the pages are
// accepted.
namespace prelight::test {
namespace {

using Names = std::set<std::string>;

/// Names such as `--sh` in a text.
Names optionsIn(const std::string& text) {
  static const std::regex option("(?:^|[^A-Za-z0-9-])(--[a-z][a-z-]*)");
  Names names;
  for (std::sregex_iterator at(text.begin(), text.end(), option), end; at != end; ++at)
    names.insert((*at)[1]);
  return names;
}

/// Options that begin the lines of a help text, before its examples.
Names optionsOfHelp(const std::string& help) {
  std::istringstream lines(help.substr(0, help.find("\nExample")));
  Names names;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find_first_not_of(' ');
    if (first == std::string::npos || line[first] != '-') continue;
    const Names named = optionsIn(line.substr(first, line.find(' ', first) - first));
    names.insert(named.begin(), named.end());
  }
  return names;
}

Names difference(const Names& a, const Names& b) {
  Names names;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::inserter(names, names.end()));
  return names;
}

/// A page without its section about the benchmarks, which are a program of their own.
std::string withoutBenchmarks(const std::string& page) {
  const std::size_t first = page.find("\n## bench\n");
  EXPECT_NE(first, std::string::npos);
  return page.substr(0, first) + page.substr(page.find("\n## ", first + 1));
}

class DocumentedOptions : public CliTest {
 protected:
  DocumentedOptions() {
    for (const char* command :
         {"bake", "render", "reference", "view", "export", "info", "scene", "devices", "compare", "plot", "help"})
      optionsOf_[command] = optionsOfHelp(prelightDone({command, "--help"}).output);
    everywhere_ = optionsOfHelp(prelightDone({"--help"}).output);
  }

  std::map<std::string, Names> optionsOf_;  ///< [command]
  Names everywhere_;                        ///< before or after every command
};

TEST_F(DocumentedOptions, Reference_HasEveryOptionAndNoOther) {
  Names all = everywhere_;
  for (const auto& [command, options] : optionsOf_) all.insert(options.begin(), options.end());
  EXPECT_GT(all.size(), 100u);
  const Names documented = optionsIn(withoutBenchmarks(textOf("docs/command-line.md")));
  EXPECT_THAT(difference(all, documented), ::testing::IsEmpty()) << "missing in docs/command-line.md";
  EXPECT_THAT(difference(documented, all), ::testing::IsEmpty()) << "no option of the program";
}

/// Lines that are typed stand four spaces from the margin.
TEST_F(DocumentedOptions, CommandsOfThePages_HaveTheOptionsThatTheyAreGiven) {
  const std::regex typed("(?:^|\n)    prelight ([a-z]+)([^\n]*)");
  std::size_t commands = 0;
  std::vector<std::string> pages = filesBelow("docs", {".md"});
  pages.emplace_back("README.md");
  for (const std::string& page : pages) {
    const std::string text = textOf(page);
    for (std::sregex_iterator at(text.begin(), text.end(), typed), end; at != end; ++at) {
      const auto command = optionsOf_.find((*at)[1]);
      if (command == optionsOf_.end()) continue;
      const std::string arguments = (*at)[2].str().substr(0, (*at)[2].str().find(" #"));
      EXPECT_THAT(difference(difference(optionsIn(arguments), command->second), everywhere_),
                  ::testing::IsEmpty())
          << page << ": " << (*at)[0];
      ++commands;
    }
  }
  EXPECT_GT(commands, 100u);
}

}  // namespace
}  // namespace prelight::test
