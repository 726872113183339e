#include <gmock/gmock.h>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::size_t vertices = 8;

/// Output of `info` for bakes of a floor under a roof with a point light.
class CliInfo : public CliTest {
 protected:
  void bake(const std::vector<std::string>& options, const std::string& scene = "") const {
    if (scene.empty()) writeFile("scene.glb", floorAndRoof().bytes());
    std::vector<std::string> arguments = {
        "bake", scene.empty() ? "scene.glb" : scene, "-o", "out.glb", "--rays", "16"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    prelightDone(arguments);
  }

  nlohmann::json baked() const {
    return nlohmann::json::parse(prelightDone({"info", "out.glb", "--json"}).output).at("baked");
  }

  std::string text() const { return prelightDone({"info", "out.glb"}).output; }
};

std::size_t countOf(const GlbScene& scene, const nlohmann::ordered_json& accessor) {
  return scene.json.at("accessors").at(accessor.get<std::size_t>()).at("count");
}

TEST_F(CliInfo, EveryTechnique_IsListedWithItsShapeAndBytes) {
  bake({"--ao", "--sh", "3", "--ch", "2", "--glossy", "2", "--light-groups", "--volume", "4", "--bounces",
        "1"});
  const nlohmann::json json = baked();
  EXPECT_EQ(json.at("ao"), true);
  EXPECT_EQ(json.at("bentNormal"), true);
  EXPECT_EQ(json.at("sh"),
            nlohmann::json({{"order", 3}, {"channels", 3}, {"bounces", 1}, {"bytes", vertices * 3 * 9 * 4}}));
  EXPECT_EQ(json.at("ch"),
            nlohmann::json({{"order", 2}, {"channels", 3}, {"bounces", 1}, {"bytes", vertices * 3 * 4 * 4}}));
  EXPECT_EQ(
      json.at("glossy"),
      nlohmann::json({{"order", 2}, {"channels", 3}, {"bounces", 1}, {"bytes", vertices * 3 * 16 * 4}}));
  const nlohmann::json root = parseGlb(readFile("out.glb")).json.at("extensions").at("PRELIGHT_transfer");
  EXPECT_EQ(json.at("lightGroups").at("groups"), root.at("lightGroups"));
  EXPECT_EQ(json.at("lightGroups").at("bytes"), vertices * 3 * 4);
  for (const char* member : {"size", "min", "max", "order", "channels", "bounces"})
    EXPECT_EQ(json.at("volume").at(member), root.at("volume").at(member)) << member;
  EXPECT_GT(json.at("volume").at("bytes"), 0);

  const std::string shown = text();
  for (const char* part : {"AO; 32 B, 4 bytes per vertex", "bent normals; 96 B",
                           "SH of order 3, 3 channels, 1 bounce; 864 B, 108 bytes per vertex",
                           "CH of order 2", "glossy matrices of order 2", "1 light group '", "volume of 4 x"})
    EXPECT_THAT(shown, HasSubstr(part));
  EXPECT_THAT(shown, Not(HasSubstr("Haar wavelets")));
}

TEST_F(CliInfo, Haar_SaysHowManyCoefficientsARowKeeps) {
  bake({"--haar", "8", "--bounces", "1"});
  const GlbScene file = parseGlb(readFile("out.glb"));
  std::size_t coefficients = 0, offsets = 0;
  for (std::size_t node = 0; node < 2; ++node) {
    const auto& haar = file.json.at("nodes")
                           .at(node)
                           .at("extensions")
                           .at("PRELIGHT_transfer")
                           .at("primitives")
                           .at(0)
                           .at("haar");
    coefficients += countOf(file, haar.at("values"));
    offsets += countOf(file, haar.at("offsets"));
  }
  const nlohmann::json haar = baked().at("haar");
  EXPECT_EQ(haar.at("faceSize"), 8);
  EXPECT_EQ(haar.at("channels"), 3);
  EXPECT_EQ(haar.at("bounces"), 1);
  EXPECT_NEAR(haar.at("coefficientsPerRow"), static_cast<double>(coefficients) / (3 * vertices), 1e-6);
  // Each of the two primitives has one more offset than rows.
  EXPECT_EQ(haar.at("bytes").get<std::size_t>(), 4 * (offsets - 1) + (2 + 4) * coefficients);
  EXPECT_THAT(text(), HasSubstr("Haar wavelets on 6 x 8 x 8 texels, 3 channels, 1 bounce; "));
  EXPECT_THAT(text(), HasSubstr(" of 384 coefficients per row; "));
}

TEST_F(CliInfo, CompressedSh_SaysItsMethodAndBytesAVertex) {
  bake({"--sh", "4", "--compress", "half"});
  nlohmann::json json = baked();
  EXPECT_FALSE(json.contains("sh"));
  EXPECT_EQ(json.at("shCompressed").at("method"), "half");
  EXPECT_EQ(json.at("shCompressed").at("order"), 4);
  EXPECT_EQ(json.at("shCompressed").at("bytesPerVertex"), 32.0);
  EXPECT_THAT(text(), HasSubstr("SH of order 4 as half, 1 channel, 0 bounces; 256 B, 32 bytes per vertex"));

  bake({"--sh", "3", "--compress", "cpca:2:1:byte"});
  json = baked();
  EXPECT_EQ(json.at("shCompressed").at("method"), "cpca:2:1:byte");
  // Means, components, each vertex's cluster, its weights, and the range of each cluster's weights.
  EXPECT_EQ(json.at("shCompressed").at("bytes"), 2 * 9 * 4 + 2 * 9 * 4 + vertices * 2 + vertices + 2 * 2 * 4);
  EXPECT_THAT(text(), HasSubstr("SH of order 3 as cpca:2:1:byte"));
}

TEST_F(CliInfo, NaiveCh_IsCalledSo) {
  bake({"--ch", "3", "--ch-naive"});
  EXPECT_EQ(baked().at("ch").at("naive"), true);
  EXPECT_THAT(text(), HasSubstr("CH of order 3, 1 channel, 0 bounces, projected naively"));
}

TEST_F(CliInfo, LightGroups_AreNamed) {
  bake({"--light-group", "all=*"});
  EXPECT_EQ(baked().at("lightGroups").at("groups").at(0).at("name"), "all");
  EXPECT_THAT(text(), HasSubstr("1 light group 'all', 3 channels, 0 bounces; 96 B, 12 bytes per vertex"));
}

TEST_F(CliInfo, Animation_ListsItsKeys) {
  prelightDone({"scene", "swing", "-o", "swing.glb"});
  bake({"--sh", "2", "--animation", "swing", "--keys", "3"}, "swing.glb");
  const nlohmann::json json = baked();
  EXPECT_EQ(json.at("animation").at("index"), 0);
  EXPECT_EQ(json.at("animation").at("times"), nlohmann::json({0.0, 2.0, 4.0}));
  EXPECT_EQ(json.at("animation").at("bytes"), 3 * json.at("sh").at("bytes").get<int>());
  EXPECT_THAT(text(), HasSubstr("3 keys of animation 0 at 0, 2, 4 s; "));
}

TEST_F(CliInfo, FileWithoutABake_HoldsNothing) {
  writeFile("out.glb", floorAndRoof().bytes());
  EXPECT_TRUE(baked().is_null());
  EXPECT_THAT(text(), HasSubstr("baked      nothing"));
  EXPECT_THAT(text(), Not(HasSubstr("holds")));
}

}  // namespace
}  // namespace prelight::test
