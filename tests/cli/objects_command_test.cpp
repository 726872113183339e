#include <gmock/gmock.h>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;

/// Objects placed into baked scenes.
class CliObjects : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    prelightDone({"scene", "cornell", "-o", "cornell.glb"});
    writeFile("object.glb", floorAndRoof().bytes());
  }

  void bake(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"bake", "cornell.glb", "-o",   "baked.glb", "--sh",
                                          "2",    "--rays",      "1024", "--volume",  "8"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    prelightDone(arguments);
  }

  ProcessResult render(const std::string& picture, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"render", "baked.glb", "-o", picture, "--size", "48x48"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return prelightDone(arguments);
  }

  nlohmann::json compare(const std::string& a, const std::string& b) const {
    return nlohmann::json::parse(prelightDone({"compare", a, b, "--json"}).output)["picture"];
  }
};

// Where there is no object the picture is that of the box alone. The object is lit, and casts shadows, as in
// a traced picture.
TEST_F(CliObjects, InCornell_LooksAsIfTracedThere) {
  bake({"--light-groups", "--bounces", "6"});
  const std::vector<std::string> object = {"--object", "object.glb:0,0.55,0.3:30:0.12"};
  const ProcessResult drawn = render("drawn.exr", object);
  EXPECT_THAT(drawn.output, HasSubstr("lights shading"));
  render("empty.exr", {"--shading", "lights"});
  prelightDone({"reference", "cornell.glb", "-o", "truth.exr", "--size", "48x48", "--spp", "512", object[0],
                object[1]});
  prelightDone({"reference", "cornell.glb", "-o", "empty_truth.exr", "--size", "48x48", "--spp", "512"});
  EXPECT_GT(compare("drawn.exr", "empty.exr")["max"], 0.1);
  // Without the object, the error is that of values at vertices. The object may add little to it.
  const double own = compare("empty.exr", "empty_truth.exr")["rmse"];
  EXPECT_LT(double(compare("drawn.exr", "truth.exr")["rmse"]), own + 0.03);
}

// Without a volume, cube maps of the lit box light the object.
TEST_F(CliObjects, InCornellWithoutAVolume_LooksAsIfTracedThere) {
  prelightDone(
      {"bake", "cornell.glb", "-o", "baked.glb", "--light-groups", "--rays", "1024", "--bounces", "6"});
  const std::vector<std::string> object = {"--object", "object.glb:0,0.55,0.3:30:0.12"};
  const ProcessResult drawn = render("drawn.exr", object);
  EXPECT_THAT(drawn.output, HasSubstr("lights shading"));
  render("empty.exr", {"--shading", "lights"});
  prelightDone({"reference", "cornell.glb", "-o", "truth.exr", "--size", "48x48", "--spp", "512", object[0],
                object[1]});
  prelightDone({"reference", "cornell.glb", "-o", "empty_truth.exr", "--size", "48x48", "--spp", "512"});
  EXPECT_GT(compare("drawn.exr", "empty.exr")["max"], 0.1);
  const double own = compare("empty.exr", "empty_truth.exr")["rmse"];
  EXPECT_LT(double(compare("drawn.exr", "truth.exr")["rmse"]), own + 0.03);
}

TEST_F(CliObjects, CubesBesideAVolume_AreLeftOutUnlessAskedFor) {
  bake({"--bounces", "1"});
  const std::vector<std::string> object = {"--object", "object.glb:0,0.55,0.3:30:0.12", "--json"};
  const auto planOf = [&](const std::string& picture, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = object;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return nlohmann::json::parse(render(picture, arguments).output)["plan"].back();
  };
  const nlohmann::json byVolume = planOf("volume.exr", {});
  EXPECT_EQ(byVolume["name"], "object cubes");
  EXPECT_EQ(byVolume["runs"], false);
  EXPECT_THAT(std::string(byVolume["reason"]), HasSubstr("has a volume"));
  const nlohmann::json byCubes = planOf("cube.exr", {"--object-light", "cube"});
  EXPECT_EQ(byCubes["runs"], true);
  EXPECT_THAT(std::string(byCubes["reason"]), HasSubstr("asked for"));
  EXPECT_GT(compare("cube.exr", "volume.exr")["max"], 1e-3);
}

TEST_F(CliObjects, ShadowsByOccluders_AreNearThoseOfRays) {
  prelightDone(
      {"bake", "cornell.glb", "-o", "baked.glb", "--light-groups", "--rays", "256", "--bounces", "2"});
  const std::vector<std::string> object = {"--object", "object.glb:0,0.55,0.3:30:0.12"};
  render("empty.exr", {"--shading", "lights"});
  render("rays.exr", {object[0], object[1]});
  render("occluders.exr", {object[0], object[1], "--object-shadow", "vo"});
  const double between = compare("occluders.exr", "rays.exr")["rmse"];
  EXPECT_GT(between, 0.0);
  EXPECT_LT(between, 0.3 * double(compare("empty.exr", "rays.exr")["rmse"]));
  expectFailure(badUsage,
                {"render", "cornell.glb", "-o", "x.png", "--object-shadow", "maps", object[0], object[1]},
                {"--object-shadow", "rays or vo or neighbourhood"});
}

// Light that the object sends onto the scene is missing with rays; it is small compared with the object.
TEST_F(CliObjects, ShadowsByNeighbourhoods_AreNearThoseOfRays) {
  prelightDone({"scene", "shapes", "-o", "shapes.glb"});
  prelightDone({"bake", "shapes.glb", "-o", "baked.glb", "--sh", "4", "--rays", "64", "--bounces", "1"});
  const std::vector<std::string> object = {"--object", "object.glb:0.3,0.7,0:30:0.25", "--env", "studio"};
  render("empty.exr", {"--shading", "sh", object[2], object[3]});
  std::vector<std::string> more = object;
  render("rays.exr", more);
  more.insert(more.end(), {"--object-shadow", "neighbourhood"});
  render("neighbourhood.exr", more);
  const double between = compare("neighbourhood.exr", "rays.exr")["rmse"];
  EXPECT_GT(between, 0.0);
  EXPECT_LT(between, 0.3 * double(compare("empty.exr", "rays.exr")["rmse"]));
}

TEST_F(CliObjects, ProbesAndSeveralObjects_AreDrawnUnderTheSky) {
  bake({"--bounces", "1"});
  const ProcessResult result = render(
      "both.exr", {"--probes", "--object", "object.glb:0,0.5,0", "--object", "object.glb:0,0.2,0:0:0.2"});
  EXPECT_THAT(result.output, HasSubstr("sh shading"));
  render("none.exr", {"--shading", "sh"});
  EXPECT_GT(compare("both.exr", "none.exr")["max"], 0.01);
}

TEST_F(CliObjects, BadPlaces_AreUsageErrors) {
  for (const char* object : {"object.glb", "object.glb:1,2", ":1,2,3", "object.glb:1,2,3:x",
                             "object.glb:1,2,3:0:0", "object.glb:1,2,3:0:1:2", "object.glb:1,2,nan"})
    expectFailure(badUsage, {"render", "cornell.glb", "-o", "x.png", "--object", object},
                  {"--object", "FILE:x,y,z"});
}

TEST_F(CliObjects, WithoutAVolumeOrInOtherShadings_AreRefused) {
  const std::vector<std::string> object = {"--object", "object.glb:0,0,0"};
  expectFailure(badInput,
                {"render", "cornell.glb", "-o", "x.png", "--rays", "16", "--object-light", "volume",
                 object[0], object[1]},
                {"no volume", "--volume"});
  expectFailure(badInput, {"render", "cornell.glb", "-o", "x.png", "--rays", "16", "--probes"},
                {"no volume", "--volume"});
  expectFailure(
      badUsage,
      {"render", "cornell.glb", "-o", "x.png", "--rays", "16", "--probes", "--object-light", "cube"},
      {"--probes", "volume"});
  expectFailure(
      badUsage,
      {"render", "cornell.glb", "-o", "x.png", "--shading", "ao", "--rays", "16", object[0], object[1]},
      {"--shading ao", "sh, lights and phong"});
  bake({"--bounces", "1"});
  expectFailure(
      badInput,
      {"render", "baked.glb", "-o", "x.png", "--shading", "lights", "--rays", "16", object[0], object[1]},
      {"holds no light groups", "--light-groups"});
  expectFailure(badInput, {"render", "baked.glb", "-o", "x.png", "--object", "missing.glb:0,0,0"},
                {"missing.glb"});
}

}  // namespace
}  // namespace prelight::test
