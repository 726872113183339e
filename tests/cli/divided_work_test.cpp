#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/work_parts.h"
#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using Json = nlohmann::ordered_json;
using Arguments = std::vector<std::string>;

class CliDivided : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    prelightDone({"scene", "cornell", "-o", "room.glb"});
  }

  static Arguments with(Arguments arguments, const Arguments& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  /// Runs `command` in slices, stage by stage, until its output is there, and returns the stages.
  std::vector<std::string> inSlices(const Arguments& command, const std::string& output, int slices) const {
    std::vector<std::string> stages;
    Arguments from;
    for (int stage = 0; stage < 20; ++stage) {
      Arguments merge{"merge", "-o", output, "--json"};
      for (int i = 1; i <= slices; ++i) {
        const std::string part = std::to_string(stage) + "-" + std::to_string(i) + ".part";
        const std::string slice = std::to_string(i) + "/" + std::to_string(slices);
        prelightDone(with(with(command, {"-o", part, "--slice", slice}), from));
        merge.insert(merge.begin() + 1, part);
      }
      const Json report = Json::parse(prelightDone(merge).output);
      if (!report.contains("next")) return stages;
      stages.push_back(report.at("next"));
      from = {"--from", report.at("state")};
    }
    ADD_FAILURE() << "the stages have no end";
    return stages;
  }
};

/// A baked file without the time that its bake took, which no two bakes share.
std::string withoutSeconds(const std::string& bytes) {
  GlbScene scene = parseGlb(bytes);
  scene.json.at("extensions").at("PRELIGHT_transfer").erase("seconds");
  return scene.bytes();
}

TEST_F(CliDivided, Reference_HasTheBytesOfOneProcess) {
  const Arguments command{"reference", "room.glb", "--spp", "16", "--size", "96"};
  prelightDone(with(command, {"-o", "whole.exr"}));
  EXPECT_THAT(inSlices(command, "merged.exr", 3), ::testing::IsEmpty());
  EXPECT_EQ(readFile("merged.exr"), readFile("whole.exr"));
}

TEST_F(CliDivided, Bake_HasTheBytesOfOneProcess) {
  const Arguments command{"bake", "room.glb", "--ao", "--sh", "2", "--bounces", "1", "--rays", "64"};
  prelightDone(with(command, {"-o", "whole.glb"}));
  const std::vector<std::string> next = inSlices(command, "merged.glb", 2);
  EXPECT_EQ(withoutSeconds(readFile("merged.glb")), withoutSeconds(readFile("whole.glb")));
  EXPECT_FALSE(files().contains("merged.glb.state"));

  const Json listed = Json::parse(prelightDone(with(command, {"-o", "x.glb", "--stages", "--json"})).output);
  std::vector<std::string> stages;
  for (const Json& stage : listed.at("stages")) stages.push_back(stage.at("stage"));
  ASSERT_EQ(stages.size(), next.size() + 1);
  EXPECT_EQ(std::vector<std::string>(stages.begin() + 1, stages.end()), next);
  EXPECT_FALSE(files().contains("x.glb"));
}

TEST_F(CliDivided, TexelsAndVolume_HaveTheBytesOfOneProcess) {
  const Arguments command{"bake",     "room.glb", "--sh",     "2", "--bounces", "1",
                          "--texels", "64",       "--volume", "8", "--rays",    "16"};
  prelightDone(with(command, {"-o", "whole.glb"}));
  EXPECT_THAT(inSlices(command, "merged.glb", 2), ::testing::IsSupersetOf({"texels", "volume"}));
  EXPECT_EQ(withoutSeconds(readFile("merged.glb")), withoutSeconds(readFile("whole.glb")));
}

TEST_F(CliDivided, StateOfAStage_CanBeFinishedByOneProcess) {
  const Arguments command{"bake", "room.glb", "--ao", "--rays", "64"};
  prelightDone(with(command, {"-o", "whole.glb"}));
  prelightDone(with(command, {"-o", "1.part", "--slice", "1/1"}));
  prelightDone({"merge", "1.part", "-o", "merged.glb"});
  prelightDone(with(command, {"-o", "merged.glb", "--resume"}));
  EXPECT_EQ(withoutSeconds(readFile("merged.glb")), withoutSeconds(readFile("whole.glb")));
}

TEST_F(CliDivided, SliceOfNoNumbers_IsRefused) {
  for (const char* slice : {"0/2", "3/2", "1", "a/b", "1/0", "1/2/3", "-1/2"})
    expectFailure(badUsage, {"bake", "room.glb", "-o", "1.part", "--slice", slice}, {"--slice", slice});
}

TEST_F(CliDivided, WorkThatEndsByTheClockOrAnError_IsRefused) {
  expectFailure(badUsage, {"bake", "room.glb", "-o", "1.part", "--slice", "1/2", "--time", "1"}, {"--time"});
  expectFailure(badUsage, {"reference", "room.glb", "-o", "1.part", "--slice", "1/2", "--time", "1"},
                {"--time"});
  expectFailure(badUsage, {"reference", "room.glb", "-o", "1.part", "--slice", "1/2", "--error", "0.1"},
                {"--error"});
}

TEST_F(CliDivided, PartsOfDifferentWork_AreRefused) {
  const Arguments command{"reference", "room.glb", "--spp", "2", "--size", "16"};
  prelightDone(with(command, {"-o", "1.part", "--slice", "1/2"}));
  prelightDone(with(command, {"-o", "2.part", "--slice", "2/2", "--seed", "3"}));
  expectFailure(badUsage, {"merge", "1.part", "2.part", "-o", "a.exr"}, {"2.part", "seed"});
  expectFailure(badUsage, with(command, {"-o", "a.exr", "--parts", "2.part"}), {"2.part", "seed"});
  expectFailure(badInput, {"merge", "room.glb", "-o", "a.exr"}, {"room.glb"});
  expectFailure(badInput, {"merge", "none.part", "-o", "a.exr"}, {"none.part"});
}

TEST_F(CliDivided, PartsOfAnEarlierStage_AreRefused) {
  const Arguments command{"bake", "room.glb", "--ao", "--rays", "64"};
  prelightDone(with(command, {"-o", "1.part", "--slice", "1/1"}));
  prelightDone({"merge", "1.part", "-o", "a.glb"});
  const ProcessResult again = prelight({"merge", "1.part", "-o", "a.glb"});
  EXPECT_EQ(again.exitCode, badUsage);
  EXPECT_THAT(again.errors, ::testing::HasSubstr("passes 1 to 2"));
}

TEST_F(CliDivided, CommandOfAPart_NamesNoFileToWrite) {
  const auto part = [&](const Arguments& arguments) {
    std::filesystem::remove(path("1.part"));
    WorkSlice slice(path("1.part"), "bake", {}, {1, 1}, arguments);
    (void)slice.begin("loop", "stage");
    (void)slice.end();
  };
  for (const Arguments& arguments :
       {Arguments{"bake", "room.glb", "--report=r.json"}, Arguments{"bake", "room.glb", "--ao", "-ox.glb"},
        Arguments{"bake", "--output=x.glb"}, Arguments{"scene", "cornell", "--output=x.glb"}, Arguments{}}) {
    part(arguments);
    expectFailure(badInput, {"merge", "1.part", "-o", "a.glb"}, {"1.part"});
  }
}

}  // namespace
}  // namespace prelight::test
