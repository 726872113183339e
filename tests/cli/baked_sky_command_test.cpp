// A file whose light was baked under a sky is shown under that sky.
#include <gmock/gmock.h>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class CliBakedSky : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    writeFile("scene.glb", floorAndRoof().bytes());
  }

  void bake(const std::string& output, const std::string& sky) const {
    prelightDone({"bake", "scene.glb", "-o", output, "--radiosity", "--rays", "16", "--env", sky});
  }

  ProcessResult render(const std::string& baked, const std::string& picture,
                       std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"render", baked,   "-o",        picture,
                                          "--size", "24x16", "--shading", "radiosity"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return prelightDone(arguments);
  }

  double differenceOf(const std::string& a, const std::string& b) const {
    const ProcessResult result = prelightDone({"compare", a, b, "--json"});
    return nlohmann::json::parse(result.output)["picture"]["max"].get<double>();
  }

  /// Writes a sky file: a rendered picture of `of`.
  void makeSky(const std::string& name, const std::string& of = "scene.glb") const {
    prelightDone({"render", of, "-o", name, "--size", "32x16", "--light", "point:0,3,3:40,40,40"});
  }
};

TEST_F(CliBakedSky, BuiltinSky_IsBehindThePictureAsIfAskedFor) {
  for (const std::string sky : {"neutral", "preetham:3:35:120"}) {
    bake("baked.glb", sky);
    EXPECT_THAT(render("baked.glb", "own.exr").errors, HasSubstr(sky));
    EXPECT_THAT(render("baked.glb", "asked.exr", {"--env", sky}).errors, Not(HasSubstr("warning")));
    EXPECT_EQ(differenceOf("own.exr", "asked.exr"), 0.0) << sky;
    render("baked.glb", "dark.exr", {"--light", "none"});
    EXPECT_GT(differenceOf("own.exr", "dark.exr"), 0.1) << sky;
  }
}

TEST_F(CliBakedSky, SkyOfAFile_IsFoundFromTheBakedFile) {
  std::filesystem::create_directories(path("skies"));
  std::filesystem::create_directories(path("out"));
  makeSky("skies/sky.exr");
  bake("out/baked.glb", "skies/sky.exr");
  EXPECT_EQ(parseGlb(readFile("out/baked.glb")).json["extensions"]["PRELIGHT_transfer"]["sky"]["name"],
            "../skies/sky.exr");
  render("out/baked.glb", "own.exr");
  render("out/baked.glb", "asked.exr", {"--env", "skies/sky.exr"});
  EXPECT_EQ(differenceOf("own.exr", "asked.exr"), 0.0);
  EXPECT_THAT(prelightDone({"info", "out/baked.glb"}).output, HasSubstr("../skies/sky.exr"));
}

/// The baked file may be moved together with the sky file beside it.
TEST_F(CliBakedSky, SkyBesideTheFile_IsFound) {
  std::filesystem::create_directories(path("skies"));
  makeSky("skies/sky.exr");
  bake("baked.glb", "skies/sky.exr");
  std::filesystem::create_directories(path("other"));
  std::filesystem::rename(path("baked.glb"), path("other/baked.glb"));
  std::filesystem::rename(path("skies/sky.exr"), path("other/sky.exr"));
  EXPECT_THAT(render("other/baked.glb", "own.exr").errors, Not(HasSubstr("warning")));
  render("other/baked.glb", "asked.exr", {"--env", "other/sky.exr"});
  EXPECT_EQ(differenceOf("own.exr", "asked.exr"), 0.0);
}

TEST_F(CliBakedSky, SkyThatIsGone_IsAskedForByName) {
  makeSky("sky.exr");
  bake("baked.glb", "sky.exr");
  std::filesystem::remove(path("sky.exr"));
  EXPECT_THAT(render("baked.glb", "own.exr").errors, HasSubstr("warning"));
  EXPECT_THAT(render("baked.glb", "own.exr").errors, HasSubstr("\"sky.exr\", which is missing"));
}

/// A different picture under the recorded name is not shown: a file from a stranger may name any file.
TEST_F(CliBakedSky, OtherPictureOfItsName_IsNotShown) {
  makeSky("sky.exr");
  bake("baked.glb", "sky.exr");
  prelightDone({"render", "scene.glb", "-o", "sky.exr", "--size", "32x16", "--light", "point:0,3,3:9,40,40"});
  EXPECT_THAT(render("baked.glb", "own.exr", {"--direct", "baked"}).errors, HasSubstr("another picture now"));
  render("baked.glb", "dark.exr", {"--light", "none", "--direct", "baked"});
  EXPECT_EQ(differenceOf("own.exr", "dark.exr"), 0.0);
}

TEST_F(CliBakedSky, AnotherSkyBehindBakedLight_IsWarnedOf) {
  bake("baked.glb", "neutral");
  EXPECT_THAT(render("baked.glb", "other.exr", {"--env", "studio"}).errors,
              HasSubstr("was baked under the sky \"neutral\""));
  EXPECT_THAT(render("baked.glb", "turned.exr", {"--rotate-env", "30"}).errors,
              HasSubstr("does not change with the sky"));
}

TEST_F(CliBakedSky, FileWithoutASky_HasNone) {
  prelightDone({"bake", "scene.glb", "-o", "baked.glb", "--radiosity", "--rays", "16"});
  EXPECT_FALSE(parseGlb(readFile("baked.glb")).json["extensions"]["PRELIGHT_transfer"].contains("sky"));
  EXPECT_THAT(render("baked.glb", "own.exr").errors, Not(HasSubstr("sky")));
}

}  // namespace
}  // namespace prelight::test
