#include <gmock/gmock.h>

#include <algorithm>
#include <iterator>
#include <sstream>

#include "architecture/source_files.h"
#include "cli/cli_test.h"

// Pages that a newcomer follows word by word: their commands run one after the other in an empty folder.
namespace prelight::test {
namespace {

using Words = std::vector<std::string>;

/// Arguments of `prelight` in the lines of a page that are typed, four spaces from the margin.
std::vector<Words> commandsOf(const std::string& page) {
  const std::string margin = "    prelight ";
  std::istringstream lines(textOf(page));
  std::vector<Words> commands;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(margin)) continue;
    std::istringstream words(line.substr(margin.size()));
    commands.emplace_back(std::istream_iterator<std::string>(words), std::istream_iterator<std::string>());
  }
  return commands;
}

bool has(const Words& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

void setOption(Words& words, const std::string& option, const std::string& value) {
  const auto given = std::find(words.begin(), words.end(), option);
  if (given == words.end()) {
    words.insert(words.end(), {option, value});
  } else {
    *std::next(given) = value;
  }
}

/// The same command with few rays, samples and pixels, and large texels.
Words quickly(Words words) {
  if (words[0] == "bake") setOption(words, "--rays", "16");
  if (has(words, "--lightmap")) setOption(words, "--texel-size", "0.5");
  if (words[0] == "reference") setOption(words, "--spp", "1");
  if (words[0] == "reference" || words[0] == "render") setOption(words, "--size", "32x24");
  return words;
}

class Walkthrough : public CliTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(Walkthrough, CommandsRunOneAfterTheOther) {
  std::size_t run = 0;
  for (const Words& words : commandsOf(GetParam())) {
    if (words.front() == "view" || words.front() == "devices")
      continue;  // needs a display; tests every device
    const ProcessResult done = prelight(quickly(words));
    ASSERT_EQ(done.exitCode, 0) << ::testing::PrintToString(words) << "\n" << done.errors;
    ++run;
  }
  EXPECT_GE(run, 8u);
}

INSTANTIATE_TEST_SUITE_P(Pages, Walkthrough, ::testing::Values("docs/getting-started.md", "docs/tutorial.md"),
                         [](const auto& test) { return test.index == 0 ? "GettingStarted" : "Tutorial"; });

}  // namespace
}  // namespace prelight::test
