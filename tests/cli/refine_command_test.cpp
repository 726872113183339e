#include <gmock/gmock.h>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A floor of two triangles below a roof.
class CliRefine : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    writeFile("coarse.glb", floorAndRoofWithChart(false).bytes());
  }
};

TEST_F(CliRefine, CoarseScene_IsWarnedOfUntilItIsRefined) {
  const ProcessResult info = prelight({"info", "coarse.glb"});
  EXPECT_THAT(info.errors, HasSubstr("--refine 0.01"));
  const ProcessResult coarse = prelight({"bake", "coarse.glb", "-o", "x.glb", "--ao", "--rays", "16"});
  EXPECT_THAT(coarse.errors, HasSubstr("--refine 0.01"));
  const ProcessResult refined =
      prelight({"bake", "coarse.glb", "-o", "fine.glb", "--ao", "--rays", "16", "--refine", "0.05"});
  EXPECT_THAT(refined.errors, Not(HasSubstr("--refine")));
  EXPECT_THAT(refined.output, HasSubstr("vertices and"));
  EXPECT_THAT(prelight({"info", "fine.glb"}).errors, Not(HasSubstr("--refine")));
}

TEST_F(CliRefine, BakedFile_HoldsTheMeshAndTheError) {
  prelightDone({"bake", "coarse.glb", "-o", "fine.glb", "--ao", "--rays", "16", "--refine", "0.05"});
  const GlbScene scene = parseGlb(readFile("fine.glb"));
  EXPECT_EQ(scene.json.at("extensions").at("PRELIGHT_transfer").at("refined"), 0.05);
  const auto& entry = scene.json.at("nodes")[0].at("extensions").at("PRELIGHT_transfer").at("primitives")[0];
  const auto& position = scene.json.at("meshes")[0].at("primitives")[0].at("attributes").at("POSITION");
  EXPECT_GT(scene.json.at("accessors")[position.get<std::size_t>()].at("count"), 20);
  EXPECT_EQ(floatAccessor(scene, entry.at("ao")).size(),
            scene.json.at("accessors")[position.get<std::size_t>()].at("count"));
}

TEST_F(CliRefine, SameCommand_GivesTheSameBytes) {
  for (const char* name : {"one.glb", "two.glb"})
    prelightDone({"bake", "coarse.glb", "-o", name, "--sh", "3", "--rays", "16", "--refine", "0.05",
                  "--refine-vertices", "50"});
  const auto values = [&](const char* name) {
    const GlbScene scene = parseGlb(readFile(name));
    return floatAccessor(scene, scene.json.at("nodes")[0]
                                    .at("extensions")
                                    .at("PRELIGHT_transfer")
                                    .at("primitives")[0]
                                    .at("sh")
                                    .at("coefficients"));
  };
  EXPECT_EQ(values("one.glb"), values("two.glb"));
}

}  // namespace
}  // namespace prelight::test
