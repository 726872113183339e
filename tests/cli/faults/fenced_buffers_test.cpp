// Runs commands with a page without access beside every buffer of OpenCL and with NaN in what has not been
// written (fenced_buffers.c): kernels stay within their buffers, and results depend on what was written
// alone. On devices that are processors; others do not see the pages.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "cli/faults/command_runs.h"

namespace prelight::test {
namespace {

class FencedBuffers : public ::testing::TestWithParam<Command> {
 protected:
  void SetUp() override { ASSERT_EQ(runs_.makeInputs({}), ""); }

  CommandRuns runs_;
};

TEST_P(FencedBuffers, EveryKernel_StaysWithinThem) {
  const Command& command = GetParam();
  ASSERT_EQ(runs_.run(command.arguments, {}).exitCode, 0);
  const std::map<std::string, std::string> unfenced = runs_.outputs();
  for (const char* side : {"start", "end"}) {
    const ProcessResult fenced =
        runs_.run(command.arguments, {{"LD_PRELOAD", PRELIGHT_FENCED_BUFFERS}, {"PRELIGHT_FENCE", side}});
    EXPECT_EQ(fenced.exitCode, 0) << "fence at the " << side << "\n" << fenced.errors;
    EXPECT_TRUE(runs_.outputs() == unfenced) << "fence at the " << side;
  }
}

INSTANTIATE_TEST_SUITE_P(OfCommands, FencedBuffers, ::testing::ValuesIn(everyCommand()),
                         [](const auto& one) { return std::string(one.param.name); });

/// A fence that nobody meets would tell nothing: reading past a buffer has to end the program.
TEST(FencedBuffersLibrary, ReadPastABuffer_EndsTheProgram) {
  for (const auto& [side, element] : {std::pair{"start", "-1"}, {"end", "4"}, {"end", "3"}}) {
    const ProcessResult result =
        runProcess({PRELIGHT_STRAY_READER, element},
                   {.environment = {{"LD_PRELOAD", PRELIGHT_FENCED_BUFFERS}, {"PRELIGHT_FENCE", side}}});
    const bool within = std::string(element) == "3";
    EXPECT_EQ(result.exitCode == 0, within) << side << " " << element << "\n" << result.errors;
  }
}

}  // namespace
}  // namespace prelight::test
