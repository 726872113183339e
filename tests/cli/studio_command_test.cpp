// Models that lack lights, a camera or a scale in metres.
#include <gmock/gmock.h>

#include <cmath>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class CliStudio : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    writeFile("lit.glb", floorAndRoof().bytes());
    writeFile("plain.glb", plainModel().bytes());
  }

  /// A floor and a roof without lights and without a camera.
  static GlbScene plainModel() {
    GlbScene scene = floorAndRoof();
    scene.json.erase("cameras");
    scene.json.erase("extensions");
    scene.json.erase("extensionsUsed");
    for (auto& node : scene.json["nodes"]) {
      node.erase("camera");
      node.erase("extensions");
    }
    return scene;
  }

  nlohmann::json reportOf(std::vector<std::string> arguments) const {
    arguments.emplace_back("--json");
    return nlohmann::json::parse(prelightDone(arguments).output);
  }

  nlohmann::json compare(const std::string& a, const std::string& b) const {
    return reportOf({"compare", a, b})["picture"];
  }
};

TEST_F(CliStudio, ModelWithoutLight_IsLitFramedAndExposed) {
  const ProcessResult told = prelightDone({"render", "plain.glb", "-o", "a.png", "--size", "48x32"});
  EXPECT_THAT(told.errors, HasSubstr("built-in studio"));
  EXPECT_THAT(told.errors, HasSubstr("exposure "));
  const nlohmann::json report = reportOf({"render", "plain.glb", "-o", "b.png", "--size", "48x32"});
  EXPECT_EQ(report["studio"], true);
  const double exposure = report["exposure"].get<double>();
  EXPECT_GT(exposure, 0.1);
  EXPECT_LT(exposure, 10.0);
  EXPECT_EQ(readFile("a.png"), readFile("b.png"));
  // The reported exposure with the studio requested by name gives the same picture.
  prelightDone({"render", "plain.glb", "-o", "c.png", "--size", "48x32", "--env", "studio", "--exposure",
                report["exposure"].dump()});
  EXPECT_EQ(readFile("a.png"), readFile("c.png"));
}

TEST_F(CliStudio, Exr_HoldsRadianceWhateverTheExposure) {
  prelightDone({"render", "plain.glb", "-o", "a.exr", "--size", "48x32"});
  const ProcessResult told =
      prelightDone({"render", "plain.glb", "-o", "b.exr", "--size", "48x32", "--exposure", "3"});
  EXPECT_THAT(told.errors, HasSubstr("radiance as it is"));
  EXPECT_EQ(readFile("a.exr"), readFile("b.exr"));
}

TEST_F(CliStudio, SceneWithLight_IsMeteredUnlessAnExposureIsGiven) {
  const ProcessResult told = prelightDone({"render", "lit.glb", "-o", "a.png", "--size", "48x32"});
  EXPECT_THAT(told.errors, Not(HasSubstr("studio")));
  EXPECT_THAT(told.errors, HasSubstr("exposure "));
  prelightDone({"render", "lit.glb", "-o", "b.png", "--size", "48x32", "--exposure", "auto"});
  EXPECT_EQ(readFile("a.png"), readFile("b.png"));
  const nlohmann::json report = reportOf({"render", "lit.glb", "-o", "c.png", "--size", "48x32"});
  EXPECT_EQ(report["studio"], false);
  EXPECT_NE(report["exposure"].get<double>(), 1.0);
  const ProcessResult asked =
      prelightDone({"render", "lit.glb", "-o", "d.png", "--size", "48x32", "--exposure", "1"});
  EXPECT_THAT(asked.errors, Not(HasSubstr("exposure")));
  EXPECT_NE(readFile("a.png"), readFile("d.png"));
}

/// One sun in lux, as authoring programs write it, and one of a brightness that suits the screen.
TEST_F(CliStudio, SunsOfAnyStrength_GiveTheSamePicture) {
  const auto exposureUnder = [&](const char* light, const char* picture) {
    return reportOf({"render", "plain.glb", "-o", picture, "--size", "48x32", "--light", light})["exposure"]
        .get<double>();
  };
  const double lux = exposureUnder("directional:0,-1,-0.2:2000,2000,2000", "a.png");
  const double suitable = exposureUnder("directional:0,-1,-0.2:2,2,2", "b.png");
  EXPECT_NEAR(suitable / lux, 1000.0, 20.0);
}

TEST_F(CliStudio, ReportOfReference_TellsTheStudio) {
  for (const bool plain : {true, false}) {
    const nlohmann::json report = reportOf(
        {"reference", plain ? "plain.glb" : "lit.glb", "-o", "r.exr", "--size", "8x6", "--spp", "1"});
    EXPECT_EQ(report["studio"], plain);
    EXPECT_TRUE(report.contains("exposure") && report["exposure"].is_null());
  }
}

/// A texture makes a small part of the roof glow. A camera inside the scene shows it without further light; a
/// camera outside shows a model, in the studio.
TEST_F(CliStudio, GlowSeenFromOutside_GetsTheStudio) {
  GlbScene scene = plainModel();
  scene.json["materials"] = nlohmann::json::parse(R"([{"emissiveFactor": [0.05, 0.05, 0.05],
      "emissiveTexture": {"index": 0}}])");
  scene.json["textures"] = nlohmann::json::parse(R"([{"source": 0}])");
  scene.json["images"] = nlohmann::json::parse(R"([{"uri": "none.png"}])");
  for (auto& mesh : scene.json["meshes"])
    for (auto& primitive : mesh["primitives"]) primitive["material"] = 0;
  scene.json["cameras"] =
      nlohmann::json::parse(R"([{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.01}}])");
  for (const bool outside : {true, false}) {
    GlbScene placed = scene;
    placed.json["nodes"].push_back({{"camera", 0},
                                    {"rotation", {-std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)}},
                                    {"translation", {0.0, outside ? 5.0 : 0.1, 0.0}}});
    placed.json["scenes"][0]["nodes"].push_back(placed.json["nodes"].size() - 1);
    writeFile("glow.glb", placed.bytes());
    EXPECT_EQ(reportOf({"render", "glow.glb", "-o", "g.png", "--size", "48x32"})["studio"], outside);
  }
}

TEST_F(CliStudio, LightOfTheOptions_LeavesTheStudioOut) {
  for (const char* light : {"none", "point:0,2,0:10,10,10"}) {
    const ProcessResult told =
        prelightDone({"render", "plain.glb", "-o", "a.png", "--size", "48x32", "--light", light});
    EXPECT_THAT(told.errors, Not(HasSubstr("studio"))) << light;
  }
  prelightDone(
      {"render", "plain.glb", "-o", "a.exr", "--size", "48x32", "--light", "none", "--shading", "phong"});
  prelightDone(
      {"render", "plain.glb", "-o", "b.exr", "--size", "48x32", "--env", "neutral", "--shading", "phong"});
  EXPECT_LT(compare("a.exr", "b.exr")["max"].get<double>(), 1e-5);
}

TEST_F(CliStudio, BadExposures_AreUsageErrors) {
  for (const char* value : {"0", "-1", "bright", "nan", "1e99"})
    expectFailure(badUsage, {"render", "plain.glb", "-o", "a.png", "--exposure", value},
                  {"--exposure", value, "or auto"});
}

/// Every way of drawing gives the same picture whatever the model's size.
TEST_F(CliStudio, ModelOfAnySize_LooksTheSame) {
  const std::vector<std::vector<std::string>> paths = {
      {"render", "--shading", "ao", "--rays", "64"},
      {"render", "--shading", "sh", "--rays", "64"},
      {"render", "--shading", "vo", "--rays", "64"},
      {"render", "--shading", "full", "--spp", "16"},
      {"render", "--shading", "full", "--rasterised"},
      {"render", "--shading", "lightmap", "--rays", "64"},
      {"reference", "--spp", "64"},
  };
  for (const std::vector<std::string>& path : paths) {
    const auto draw = [&](const std::string& scale, const std::string& picture) {
      std::vector<std::string> arguments = path;
      arguments.insert(arguments.end(), {"plain.glb", "-o", picture, "--size", "32x24", "--scale", scale});
      prelightDone(arguments);
    };
    draw("1", "one.exr");
    for (const char* scale : {"1e-4", "1e-2", "1e2", "1e5"}) {
      draw(scale, "other.exr");
      const nlohmann::json difference = compare("other.exr", "one.exr");
      EXPECT_LT(difference["relMSE"].get<double>(), 1e-3) << path[2] << " " << scale;
      EXPECT_NEAR(difference["meanA"].get<double>() / difference["meanB"].get<double>(), 1.0, 5e-3)
          << path[2] << " " << scale;
    }
  }
}

TEST_F(CliStudio, Info_TellsSizeAndGuessesTheUnit) {
  const nlohmann::json usual = reportOf({"info", "plain.glb"});
  EXPECT_TRUE(usual["contents"]["unit"].is_null());
  const nlohmann::json large = reportOf({"info", "plain.glb", "--scale", "900"});
  EXPECT_TRUE(large["contents"]["unit"]["guess"].is_null());
  EXPECT_TRUE(large["contents"]["unit"]["scale"].is_null());
  const std::string text = prelightDone({"info", "plain.glb", "--scale", "900"}).output;
  EXPECT_THAT(text, HasSubstr("if it is not: --scale 0.001"));
  EXPECT_THAT(text, Not(HasSubstr("probably")));
}

/// The baked file has the requested size, and its own bake fits it.
TEST_F(CliStudio, BakeOfAScaledScene_IsThatOfItsSize) {
  prelightDone({"bake", "plain.glb", "-o", "small.glb", "--ao", "--rays", "16", "--scale", "0.01"});
  const nlohmann::json before = reportOf({"info", "plain.glb"})["contents"]["bounds"];
  const nlohmann::json info = reportOf({"info", "small.glb"});
  EXPECT_NEAR(info["contents"]["bounds"][1][0].get<double>(), 0.01 * before[1][0].get<double>(), 1e-9);
  EXPECT_FALSE(info["baked"].is_null());
  const ProcessResult told = prelightDone({"info", "small.glb", "--scale", "2"});
  EXPECT_THAT(told.errors, HasSubstr("in its own size and is left out"));
  EXPECT_THAT(told.output, HasSubstr("nothing"));
}

TEST_F(CliStudio, BakeOfCoatedMaterials_WarnsOnceWithTheirNames) {
  GlbScene scene = plainModel();
  scene.json["materials"] = nlohmann::ordered_json::parse(
      R"([{"name": "lacquer", "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1}}}])");
  for (auto& mesh : scene.json["meshes"])
    for (auto& primitive : mesh["primitives"]) primitive["material"] = 0;
  writeFile("coated.glb", scene.bytes());
  const nlohmann::json report = reportOf({"bake", "coated.glb", "-o", "b.glb", "--sh", "2", "--rays", "4"});
  EXPECT_THAT(report["warnings"].dump(),
              HasSubstr("baked transfer leaves out clear coats of \\\"lacquer\\\""));
  const nlohmann::json plain = reportOf({"bake", "coated.glb", "-o", "a.glb", "--ao", "--rays", "4"});
  EXPECT_THAT(plain["warnings"].dump(), Not(HasSubstr("leaves out")));
}

}  // namespace
}  // namespace prelight::test
