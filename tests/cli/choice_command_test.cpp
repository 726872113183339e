#include <gmock/gmock.h>

#include <numeric>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;

/// Choices among what a file holds: a moment, a scene, a material variant.
class CliChoice : public CliTest {
 protected:
  Json report(std::vector<std::string> arguments) const {
    arguments.push_back("--json");
    return Json::parse(prelightDone(arguments).output);
  }

  double difference(const std::string& a, const std::string& b) const {
    return report({"compare", a, b})["picture"]["rmse"];
  }

  /// A file with the floor and the roof in one scene, the roof alone in another, and a material that is black
  /// in one of two variants.
  GlbScene choices() const {
    GlbScene scene = floorAndRoof();
    scene.json["scenes"] =
        Json::parse(R"([{"name": "both", "nodes": [0, 1]}, {"name": "roof", "nodes": [1]}])");
    const std::size_t own = scene.json["materials"].size();
    scene.json["materials"].push_back({{"pbrMetallicRoughness", {{"metallicFactor", 0}}}});
    scene.json["materials"].push_back({{"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}}}});
    scene.json["extensions"]["KHR_materials_variants"] =
        Json::parse(R"({"variants": [{"name": "day"}, {"name": "night"}]})");
    auto& primitive = scene.json["meshes"][0]["primitives"][0];
    primitive["material"] = own;
    primitive["extensions"]["KHR_materials_variants"]["mappings"] =
        Json::array({{{"material", own + 1}, {"variants", {1}}}});
    scene.json["extensionsUsed"].push_back("KHR_materials_variants");
    return scene;
  }
};

TEST_F(CliChoice, BakeOfAMoment_IsShownAtThatMoment) {
  prelightDone({"scene", "swing", "-o", "swing.glb"});
  prelightDone({"bake", "swing.glb", "-o", "baked.glb", "--sh", "2", "--rays", "4", "--at", "2"});
  const Json moment = parseGlb(readFile("baked.glb")).json["extensions"]["PRELIGHT_transfer"]["moment"];
  EXPECT_EQ(moment, (Json{{"animation", 0}, {"seconds", 2.0}}));
  const std::vector<std::string> light = {"--size", "96x72",   "--shading",
                                          "sh",     "--light", "directional:0,-1,-0.5:2,2,2"};
  const auto render = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "render");
    arguments.insert(arguments.end(), light.begin(), light.end());
    prelightDone(arguments);
  };
  render({"baked.glb", "-o", "baked.exr"});
  render({"baked.glb", "-o", "same.exr", "--at", "2"});
  const std::vector<std::string> small = {"render", "baked.glb", "-o", "small.exr", "--size", "8x8", "--at"};
  const auto warned = [&](const char* seconds) {
    std::vector<std::string> arguments = small;
    arguments.emplace_back(seconds);
    return prelightDone(arguments).errors;
  };
  EXPECT_THAT(warned("1"), HasSubstr("--at: the bake was made in another pose; left out: sh"));
  EXPECT_THAT(warned("2"), ::testing::Not(HasSubstr("another pose")));
  render({"swing.glb", "-o", "there.exr", "--at", "2", "--sh", "2", "--rays", "4"});
  render({"swing.glb", "-o", "rest.exr", "--sh", "2", "--rays", "4"});
  EXPECT_LT(difference("baked.exr", "there.exr"), 1e-6);
  EXPECT_LT(difference("baked.exr", "same.exr"), 1e-6);
  EXPECT_GT(difference("baked.exr", "rest.exr"), 0.01);
  expectFailure(2, {"bake", "swing.glb", "-o", "b.glb", "--sh", "2", "--at", "1", "--keys", "3"},
                {"--at", "--keys"});
}

TEST_F(CliChoice, ReferenceOfAMoment_IsThatOfTheBakedFile) {
  prelightDone({"scene", "swing", "-o", "swing.glb"});
  prelightDone(
      {"bake", "swing.glb", "-o", "baked.glb", "--ao", "--rays", "4", "--at", "2", "--animation", "swing"});
  const auto reference = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "reference");
    arguments.insert(arguments.end(),
                     {"--spp", "4", "--size", "48x36", "--light", "directional:0,-1,-0.5:2,2,2"});
    prelightDone(arguments);
  };
  reference({"swing.glb", "-o", "there.exr", "--at", "2"});
  reference({"baked.glb", "-o", "baked.exr"});
  reference({"swing.glb", "-o", "rest.exr"});
  EXPECT_EQ(difference("baked.exr", "there.exr"), 0.0);
  EXPECT_GT(difference("rest.exr", "there.exr"), 0.01);
}

TEST_F(CliChoice, FullShading_ShowsTheMoment) {
  prelightDone({"scene", "swing", "-o", "swing.glb"});
  const auto render = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(),
                     {"render", "swing.glb", "--shading", "full", "--size", "48x36", "--spp", "1",
                      "--photons", "100", "--light", "directional:0,-1,-0.5:2,2,2"});
    prelightDone(arguments);
  };
  render({"-o", "there.exr", "--at", "2"});
  render({"-o", "rest.exr"});
  EXPECT_GT(difference("rest.exr", "there.exr"), 0.01);
}

/// Transfer knows no bounces of lamps that stand in a room.
TEST_F(CliChoice, BakeThatLacksTheLight_GivesWayToFullShading_UnlessItIsAskedFor) {
  prelightDone({"scene", "rooms", "-o", "rooms.glb"});
  prelightDone({"bake", "rooms.glb", "-o", "baked.glb", "--sh", "2", "--rays", "4", "--bounces", "1"});
  const auto drawn = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"render", "baked.glb", "-o", "a.exr", "--size", "16x12"});
    const ProcessResult result = prelightDone(options);
    return result.output + result.errors;
  };
  EXPECT_THAT(drawn({}), ::testing::AllOf(HasSubstr("full shading"), HasSubstr("--shading sh")));
  EXPECT_THAT(drawn({"--shading", "sh"}),
              ::testing::AllOf(HasSubstr("sh shading"), ::testing::Not(HasSubstr("drawn in full"))));
}

TEST_F(CliChoice, Scenes_AreChosenByNameAndNumber) {
  writeFile("choices.glb", choices().bytes());
  const auto nodes = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"info", "choices.glb"});
    return report(options)["contents"]["meshNodes"];
  };
  EXPECT_EQ(nodes({}), 2);
  EXPECT_EQ(nodes({"--scene", "roof"}), 1);
  EXPECT_EQ(nodes({"--scene", "1"}), 1);
  EXPECT_EQ(nodes({"--scene", "0"}), 2);
  const Json contents = report({"info", "choices.glb"})["contents"];
  EXPECT_EQ(contents["scenes"], (Json{"both", "roof"}));
  EXPECT_EQ(contents["variants"], (Json{"day", "night"}));
  EXPECT_THAT(prelightDone({"info", "choices.glb"}).output, HasSubstr("'night'"));
  prelightDone({"bake", "choices.glb", "-o", "roof.glb", "--ao", "--rays", "4", "--scene", "roof"});
  EXPECT_EQ(report({"info", "roof.glb"})["contents"]["meshNodes"], 1) << "the file shows what was baked";
}

TEST_F(CliChoice, UnknownScenesAndVariants_ListWhatThereIs) {
  writeFile("choices.glb", choices().bytes());
  expectFailure(2, {"info", "choices.glb", "--scene", "cellar"},
                {"--scene", "cellar", "0 \"both\", 1 \"roof\""});
  expectFailure(2, {"info", "choices.glb", "--scene", "2"}, {"--scene", "2"});
  expectFailure(2, {"info", "choices.glb", "--variant", "dusk"}, {"--variant", "dusk", "\"day\", \"night\""});
  expectFailure(2, {"info", "choices.glb", "--animation", "0"}, {"--animation", "--at"});
  expectFailure(2, {"info", "choices.glb", "--at", "1"}, {"no animations"});
}

TEST_F(CliChoice, Variants_ChangeWhatIsReflectedAndAreRecorded) {
  writeFile("choices.glb", choices().bytes());
  const auto bake = [&](const std::string& scene, const std::string& output,
                        std::vector<std::string> options) {
    options.insert(options.begin(),
                   {"bake", scene, "-o", output, "--sh", "1", "--bounces", "1", "--rays", "64"});
    prelightDone(options);
    const GlbScene baked = parseGlb(readFile(output));
    const auto& entry = baked.json["nodes"][0]["extensions"]["PRELIGHT_transfer"]["primitives"][0];
    return floatAccessor(baked, entry["sh"]["coefficients"].get<std::size_t>());
  };
  const std::vector<float> day = bake("choices.glb", "day.glb", {});
  const std::vector<float> night = bake("choices.glb", "night.glb", {"--variant", "night"});
  // The dark variant has one channel, the other has three.
  const auto meanOf = [](const std::vector<float>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
  };
  EXPECT_GT(meanOf(day), 1.01 * meanOf(night)) << "a black roof reflects nothing";
  EXPECT_EQ(parseGlb(readFile("night.glb")).json["extensions"]["PRELIGHT_transfer"]["variant"], "night");
  EXPECT_EQ(bake("night.glb", "again.glb", {}), night) << "a baked file keeps its variant";
}

TEST_F(CliChoice, AnotherVariantThanTheBakedOne_IsAWarning) {
  writeFile("choices.glb", choices().bytes());
  prelightDone({"bake", "choices.glb", "-o", "own.glb", "--ao", "--rays", "4"});
  EXPECT_THAT(prelightDone({"info", "own.glb", "--variant", "night"}).errors,
              HasSubstr("made of its own materials"));
  GlbScene gone = parseGlb(readFile("own.glb"));
  gone.json["extensions"]["PRELIGHT_transfer"]["variant"] = "dusk";
  writeFile("gone.glb", gone.bytes());
  EXPECT_THAT(prelightDone({"info", "gone.glb"}).errors,
              HasSubstr("variant \"dusk\", which the file no longer has"));
}

TEST_F(CliChoice, AnotherSceneThanTheBakedOne_IsShownWithoutTheBakeAndSaid) {
  writeFile("choices.glb", choices().bytes());
  prelightDone({"bake", "choices.glb", "-o", "roof.glb", "--ao", "--rays", "4", "--scene", "roof"});
  EXPECT_EQ(parseGlb(readFile("roof.glb")).json["extensions"]["PRELIGHT_transfer"]["scene"], 1);
  const std::vector<std::string> render = {"render", "roof.glb", "-o", "a.png", "--size", "16x16"};
  EXPECT_THAT(prelightDone(render).errors, testing::Not(HasSubstr("made of")));
  std::vector<std::string> other = render;
  other.insert(other.end(), {"--scene", "both"});
  EXPECT_THAT(prelightDone(other).errors, HasSubstr("made of scene 1 \"roof\", not of scene 0 \"both\""));
  // The warning also appears for a bake that does not record its scene.
  GlbScene silent = parseGlb(readFile("roof.glb"));
  silent.json["extensions"]["PRELIGHT_transfer"].erase("scene");
  writeFile("silent.glb", silent.bytes());
  other[1] = "silent.glb";
  EXPECT_THAT(prelightDone(other).errors, HasSubstr("made of scene 1 \"roof\", not of scene 0 \"both\""));
}

TEST_F(CliChoice, AnotherMomentThanTheBakedOne_IsSaid) {
  prelightDone({"scene", "swing", "-o", "swing.glb"});
  prelightDone({"bake", "swing.glb", "-o", "baked.glb", "--ao", "--rays", "4", "--at", "2"});
  const auto errorsAt = [&](const char* seconds) {
    return prelightDone({"bake", "baked.glb", "-o", "again.glb", "--ao", "--rays", "4", "--at", seconds})
        .errors;
  };
  EXPECT_THAT(errorsAt("1"), HasSubstr("made at 2 s of animation 0, not at 1 s of animation 0"));
  EXPECT_THAT(errorsAt("2"), testing::Not(HasSubstr("made at")));
}

}  // namespace
}  // namespace prelight::test
