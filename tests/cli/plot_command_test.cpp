#include <gmock/gmock.h>

#include <iterator>
#include <sstream>

#include "cli/cli_test.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;

using CliPlot = CliTest;

/// Arguments of the examples of the help, without `prelight`.
std::vector<std::vector<std::string>> examplesOf(const std::string& help) {
  std::istringstream lines(help.substr(help.find("Examples:")));
  std::vector<std::vector<std::string>> examples;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::vector<std::string> example(std::istream_iterator<std::string>(words), {});
    if (example.size() < 2 || example.front() != "prelight") continue;
    example.erase(example.begin());
    examples.push_back(example);
  }
  return examples;
}

TEST_F(CliPlot, ExamplesOfTheHelp_DrawPictures) {
  prelightDone({"scene", "shapes", "-o", "shapes.glb"});
  prelightDone({"bake", "shapes.glb", "-o", "baked.glb", "--sh", "3", "--rays", "16"});
  const auto examples = examplesOf(prelightDone({"plot", "--help"}).output);
  EXPECT_EQ(examples.size(), 8u);
  for (const std::vector<std::string>& example : examples) {
    SCOPED_TRACE(::testing::PrintToString(example));
    prelightDone(example);
    const auto output = std::next(std::find(example.begin(), example.end(), "-o"));
    EXPECT_THAT(readFile(*output), HasSubstr("data:image/png;base64,"));
  }
}

TEST_F(CliPlot, Json_HasTheLightsOfASky) {
  const nlohmann::json report = nlohmann::json::parse(
      prelightDone({"plot", "lights", "-o", "a.png", "--sky-lights", "7", "--json"}).output);
  EXPECT_EQ(report["lights"].size(), 7u);
  EXPECT_EQ(readFile("a.png").substr(1, 3), "PNG");
}

TEST_F(CliPlot, TransferOfInnerProducts_IsRefused) {
  prelightDone({"scene", "shapes", "-o", "shapes.glb"});
  prelightDone({"bake", "shapes.glb", "-o", "baked.glb", "--ch", "3", "--ch-naive", "--rays", "16"});
  expectFailure(badInput, {"plot", "transfer", "baked.glb", "-o", "a.svg"},
                {"inner products", "expected coefficients", "without --ch-naive"});
}

TEST_F(CliPlot, WhatAKindDoesNotTake_IsRefused) {
  expectFailure(badUsage, {"plot", "lobes", "-o", "a.svg"}, {"lobes", "did you mean lobe?"});
  expectFailure(badUsage, {"plot", "sh", "-o", "a.svg", "--env", "studio"},
                {"--env", "plot sh does not take it"});
  expectFailure(badUsage, {"plot", "sh", "scene.glb", "-o", "a.svg"}, {"takes no file"});
  expectFailure(badUsage, {"plot", "transfer", "-o", "a.svg"}, {"a baked file is required"});
  expectFailure(badUsage, {"plot", "sh", "-o", "a.jpg"}, {"-o", ".svg"});
  expectFailure(badUsage, {"plot", "sh", "-o", "a.svg", "--order", "9"}, {"--order", "1 to 8"});
  expectFailure(badUsage, {"plot", "wavelets", "-o", "a.svg", "--face-size", "16"},
                {"--face-size", "2, 4 or 8"});
}

}  // namespace
}  // namespace prelight::test
