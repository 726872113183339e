#include <gmock/gmock.h>

#include <sstream>

#include "cli/cli_test.h"

namespace prelight::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

class CliPages : public CliTest {
 protected:
  /// Completions that bash offers after `words` were typed; the last word is incomplete.
  std::set<std::string> offeredByBash(const std::vector<std::string>& words) const {
    writeFile("completion", prelightDone({"help", "--completion", "bash"}).output);
    std::string typed;
    for (const std::string& word : words) typed += "'" + word + "' ";
    const std::string script = "source ./completion; COMP_WORDS=(prelight " + typed +
                               "); COMP_CWORD=" + std::to_string(words.size()) +
                               "; _prelight; printf '%s\\n' \"${COMPREPLY[@]}\"";
    const ProcessResult offered = runProcess({"bash", "-c", script}, {.directory = path("")});
    EXPECT_EQ(offered.exitCode, 0) << offered.errors;
    std::istringstream lines(offered.output);
    std::set<std::string> names;
    for (std::string line; std::getline(lines, line);)
      if (!line.empty()) names.insert(line);
    return names;
  }

  /// Option names at the beginning of lines of the command's help.
  std::vector<std::string> optionsInHelp(const std::string& command) const {
    std::istringstream lines(prelightDone({command, "--help"}).output);
    std::vector<std::string> options;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string word;
      words >> word;
      std::istringstream names(word);
      for (std::string name; std::getline(names, name, ',');)
        if (name.starts_with("-") && name != "-h" && name != "--help") options.push_back(name);
    }
    return options;
  }
};

std::string roffOf(const std::string& name) {
  std::string text;
  for (const char c : name) text += c == '-' ? "\\-" : std::string(1, c);
  return text;
}

TEST_F(CliPages, OptionsOfEveryCommand_AreInManualPageAndCompletions) {
  const std::string manual = prelightDone({"help", "--man"}).output;
  const std::string zsh = prelightDone({"help", "--completion", "zsh"}).output;
  const std::string fish = prelightDone({"help", "--completion", "fish"}).output;
  std::size_t options = 0;
  for (const char* command :
       {"bake", "render", "reference", "view", "export", "info", "scene", "devices", "compare", "help"}) {
    const std::size_t section = manual.find(std::string("\n.SS ") + command + "\n");
    ASSERT_NE(section, std::string::npos) << command;
    const std::string own = manual.substr(section, manual.find("\n.SS ", section + 1) - section);
    const std::set<std::string> offered = offeredByBash({command, "-"});
    for (const std::string& option : optionsInHelp(command)) {
      ++options;
      EXPECT_THAT(own, HasSubstr(roffOf(option))) << command;
      EXPECT_THAT(offered, Contains(option)) << command;
      EXPECT_THAT(zsh, HasSubstr(option + "["));
      const bool isLong = option.starts_with("--");
      EXPECT_THAT(fish, HasSubstr((isLong ? " -l " : " -s ") + option.substr(isLong ? 2 : 1) + " "));
    }
  }
  EXPECT_GT(options, 150u);
}

TEST_F(CliPages, Bash_OffersWhatBeginsAsTyped) {
  EXPECT_EQ(offeredByBash({"re"}), (std::set<std::string>{"render", "reference"}));
  EXPECT_EQ(offeredByBash({"bake", "x.glb", "--texel-"}),
            (std::set<std::string>{"--texel-error", "--texel-size"}));
  EXPECT_EQ(offeredByBash({"--verbose", "scene", "--li"}), (std::set<std::string>{"--list"}));
  EXPECT_EQ(offeredByBash({"bake", "mod"}), std::set<std::string>{});  // A file name is expected there.
}

TEST_F(CliPages, Shell_ThatIsUnknown_IsRefused) {
  expectFailure(badUsage, {"help", "--completion", "tcsh"}, {"--completion: got 'tcsh'", "bash", "zsh", "fish"});
}

}  // namespace
}  // namespace prelight::test
