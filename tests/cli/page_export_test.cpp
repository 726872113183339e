#include <gmock/gmock.h>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"
#include "support/file_limit.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A floor under a roof, baked for a page.
class CliPage : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    writeFile("scene.glb", floorAndRoof().bytes());
    prelightDone({"bake", "scene.glb", "-o", "baked.glb", "--sh", "3", "--ao", "--vo", "--rays", "16"});
  }
};

TEST_F(CliPage, Page_IsOneFile) {
  const std::set<std::string> before = files();
  const auto report =
      nlohmann::json::parse(prelightDone({"export", "baked.glb", "-o", "page.html", "--target", "web",
                                          "--env", "neutral", "--env", "studio", "--json"})
                                .output);
  EXPECT_EQ(report["target"], "web");
  EXPECT_EQ(report["bytes"], readFile("page.html").size());
  ASSERT_EQ(report["shadings"].size(), 3u);
  EXPECT_EQ(report["shadings"][0]["name"], "sh");
  EXPECT_EQ(report["leftOut"], nlohmann::json::array());
  std::set<std::string> after = files();
  after.erase("page.html");
  EXPECT_EQ(after, before);
  const std::string page = readFile("page.html");
  EXPECT_THAT(page, HasSubstr("<title>baked</title>"));
  for (const char* part : {"\"name\":\"sh\"", "\"name\":\"ao\"", "\"name\":\"vo\"", "\"name\":\"neutral\"",
                           "\"name\":\"studio\""})
    EXPECT_THAT(page, HasSubstr(part));
  EXPECT_THAT(page, Not(HasSubstr("http://")));
}

TEST_F(CliPage, WhatItLeavesOut_IsSaidWithItsReason) {
  prelightDone({"bake", "scene.glb", "-o", "more.glb", "--sh", "3", "--horizons", "8", "--rays", "16"});
  EXPECT_THAT(
      prelightDone({"export", "more.glb", "-o", "page.html", "--target", "web"}).output,
      AllOf(HasSubstr("shadings   sh "), HasSubstr("left out   horizons: pages draw no light above")));
}

TEST_F(CliPage, SameInput_IsTheSamePage) {
  prelightDone({"export", "baked.glb", "-o", "a.html", "--target", "web"});
  prelightDone({"export", "baked.glb", "-o", "b.html", "--target", "web"});
  EXPECT_EQ(readFile("a.html"), readFile("b.html"));
}

TEST_F(CliPage, BadInput_IsRefusedByNameAndLeavesNothing) {
  expectFailure(badInput, {"export", "scene.glb", "-o", "page.html", "--target", "web"},
                {"scene.glb", "carries no bake", "prelight bake"});
  expectFailure(badUsage, {"export", "baked.glb", "-o", "page.html", "--target", "page"},
                {"--target page", "gltf, three, blender, raw, godot, unity, web"});
  expectFailure(badUsage, {"export", "baked.glb", "-o", "page.glb", "--target", "web"},
                {"page.glb", ".html"});
  expectFailure(badUsage, {"export", "baked.glb", "-o", "page.html", "--target", "web", "--as", "lightmap"},
                {"--as", "--target"});
  expectFailure(badUsage, {"export", "baked.glb", "-o", "out", "--target", "unity", "--env", "studio"},
                {"--env", "--target gltf", "--as probes"});
  expectFailure(badInput, {"export", "baked.glb", "-o", "page.html", "--target", "web", "--env", "none.hdr"},
                {"none.hdr"});
}

TEST_F(CliPage, BakeThatNoPageShows_IsAUsageError) {
  prelightDone({"bake", "scene.glb", "-o", "horizons.glb", "--horizons", "8", "--rays", "16"});
  expectFailure(badUsage, {"export", "horizons.glb", "-o", "page.html", "--target", "web"},
                {"nothing that a page shows", "--sh", "--ao"});
}

TEST_F(CliPage, FullDisk_LeavesNothing) {
  const FileLimit limit(4096);
  expectFailure(failed, {"export", "baked.glb", "-o", "page.html", "--target", "web"},
                {"page.html", "cannot write"});
}

}  // namespace
}  // namespace prelight::test
