#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;

class CliVolume : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    prelightDone({"scene", "cornell", "-o", "room.glb"});
  }

  GlbScene bake(const std::vector<std::string>& options) const {
    std::vector<std::string> arguments = {"bake", "room.glb", "-o", "out.glb", "--sh", "3", "--rays", "16"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    prelightDone(arguments);
    return parseGlb(readFile("out.glb"));
  }

  static const nlohmann::ordered_json& volumeOf(const GlbScene& scene) {
    return scene.json.at("extensions").at("PRELIGHT_transfer").at("volume");
  }

  nlohmann::json info() const {
    return nlohmann::json::parse(prelightDone({"info", "out.glb", "--json"}).output).at("baked").at("volume");
  }
};

TEST_F(CliVolume, WithoutBounces_HoldsOneChannelOfEveryCell) {
  const GlbScene baked = bake({"--volume", "4"});
  const auto& volume = volumeOf(baked);
  EXPECT_EQ(volume.at("size"), nlohmann::ordered_json({4, 4, 4}));
  EXPECT_EQ(volume.at("channels"), 1);
  EXPECT_FALSE(volume.contains("direct"));
  const std::vector<float> values = floatAccessor(baked, volume.at("coefficients"));
  ASSERT_EQ(values.size(), 64u * 9);
  // The fraction of the sphere in which a cell sees the sky: some of it but not all, in an open room.
  double least = 1.0, most = 0.0;
  for (std::size_t cell = 0; cell < 64; ++cell) {
    const double open = std::sqrt(4.0 * std::numbers::pi) * values[9 * cell];
    least = std::min(least, open);
    most = std::max(most, open);
  }
  EXPECT_GE(least, -1e-5);
  EXPECT_LT(most, 0.9);
  EXPECT_GT(most, 0.1);

  const nlohmann::json shown = info();
  EXPECT_EQ(shown.at("size"), nlohmann::json({4, 4, 4}));
  EXPECT_EQ(shown.at("order"), 3);
  EXPECT_EQ(shown.at("channels"), 1);
  EXPECT_EQ(shown.at("bounces"), 0);
  EXPECT_EQ(shown.at("bytes"), 64 * (9 * 4 + 1));
}

TEST_F(CliVolume, WithBounces_AddsWhatSurfacesReflectToWhatIsDirect) {
  const GlbScene baked = bake({"--volume", "3", "--bounces", "2"});
  const auto& volume = volumeOf(baked);
  EXPECT_EQ(volume.at("channels"), 3);
  EXPECT_EQ(volume.at("bounces"), 2);
  const std::vector<float> all = floatAccessor(baked, volume.at("coefficients"));
  const std::vector<float> direct = floatAccessor(baked, volume.at("direct"));
  ASSERT_EQ(direct.size(), 27u * 9);
  ASSERT_EQ(all.size(), 3 * direct.size());
  for (std::size_t cell = 0; cell < 27; ++cell)
    for (std::size_t channel = 0; channel < 3; ++channel)
      EXPECT_GE(all[(3 * cell + channel) * 9], direct[cell * 9] - 1e-6f) << "under an even sky";
  const nlohmann::json shown = info();
  EXPECT_EQ(shown.at("channels"), 3);
  EXPECT_EQ(shown.at("bounces"), 2);
  EXPECT_EQ(shown.at("bytes"), 27 * ((4 + 12) * 9 * 4 + 1));
}

TEST_F(CliVolume, OfAnAnimatedScene_StandsBesideTheKeys) {
  prelightDone({"scene", "swing", "-o", "room.glb"});
  const GlbScene baked = bake({"--volume", "3", "--animation", "0", "--keys", "2"});
  EXPECT_TRUE(baked.json.at("extensions").at("PRELIGHT_transfer").contains("animation"));
  EXPECT_EQ(info().at("order"), 3);
}

TEST_F(CliVolume, BadSizesAndAVolumeWithoutSh_AreUsageErrors) {
  for (const char* size : {"0", "65", "-1", "2.5", "many", "nan", ""})
    expectFailure(badUsage, {"bake", "room.glb", "-o", "x.glb", "--sh", "2", "--volume", size},
                  {"--volume", "1 to 64"});
  expectFailure(badUsage, {"bake", "room.glb", "-o", "x.glb", "--haar", "8", "--volume", "4"},
                {"--volume", "--sh"});
}

/// A floor under a black sheet that is far larger than the floor and transmits `factor` of the light on its
/// other side.
GlbScene floorUnderSheet(double factor) {
  GlbScene scene = floorAndRoof();
  scene.json.at("extensionsUsed").push_back("KHR_materials_diffuse_transmission");
  scene.json.at("meshes").push_back(scene.json.at("meshes").at(0));
  scene.json.at("meshes").at(1).at("primitives").at(0).at("material") = 1;
  scene.json.at("materials")
      .push_back({{"name", "sheet"},
                  {"doubleSided", true},
                  {"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}, {"metallicFactor", 0}}},
                  {"extensions",
                   {{"KHR_materials_diffuse_transmission",
                     {{"diffuseTransmissionFactor", factor},
                      {"diffuseTransmissionColorFactor", {0.9, 0.6, 0.3}}}}}}});
  scene.json.at("nodes").at(0).at("scale") = {1, 1, 1};
  scene.json.at("nodes").at(1).at("mesh") = 1;
  scene.json.at("nodes").at(1)["scale"] = {100, 1, 100};
  return scene;
}

class CliTranslucent : public CliTest {
 protected:
  /// SH transfer of the floor's vertices, [vertex][channel][i], and whether the pass ran.
  struct Baked {
    std::vector<float> floor;
    bool passRan = false;
  };

  Baked bake(double factor) const {
    writeFile("sheet.glb", floorUnderSheet(factor).bytes());
    prelightDone({"bake", "sheet.glb", "-o", "out.glb", "--sh", "2", "--bounces", "2", "--rays", "256",
                  "--report", "report.json"});
    const GlbScene scene = parseGlb(readFile("out.glb"));
    const auto& floor = scene.json.at("nodes").at(0).at("extensions").at("PRELIGHT_transfer");
    Baked baked{floatAccessor(scene, floor.at("primitives").at(0).at("sh").at("coefficients")), false};
    const nlohmann::json report = nlohmann::json::parse(readFile("report.json"));
    for (const auto& pass : report.at("plan").at("passes"))
      if (pass.at("name") == "translucent senders") baked.passRan = pass.at("runs");
    return baked;
  }
};

TEST_F(CliTranslucent, SheetOverAFloor_LetsItsShareOfTheSkyThrough) {
  const Baked opaque = bake(0.0), translucent = bake(0.5);
  EXPECT_FALSE(opaque.passRan);
  EXPECT_TRUE(translucent.passRan);
  ASSERT_EQ(opaque.floor.size(), 4u * 3 * 4);
  ASSERT_EQ(translucent.floor.size(), opaque.floor.size());
  // The sheet hides all of the sky but 1e-4. It is black, so that it sends transmitted light alone: factor x
  // colour of the light that its open upper side receives, from an even sky and, by A_1 = 2/3, from above.
  const double colors[3] = {0.9, 0.6, 0.3};
  constexpr std::size_t upwards = 1;  // Y_1,-1 is along +Y.
  for (std::size_t vertex = 0; vertex < 4; ++vertex) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const float* dark = opaque.floor.data() + (3 * vertex + channel) * 4;
      const float* lit = translucent.floor.data() + (3 * vertex + channel) * 4;
      const double even = std::sqrt(4.0 * std::numbers::pi);
      EXPECT_NEAR(even * dark[0], 0.0, 0.01);
      EXPECT_NEAR(even * lit[0], 0.5 * colors[channel], 0.02);
      EXPECT_NEAR(dark[upwards], 0.0, 0.01);
      EXPECT_NEAR(lit[upwards], 0.5 * colors[channel] * 2.0 / 3.0 * std::sqrt(0.75 / std::numbers::pi), 0.01);
    }
  }
}

}  // namespace
}  // namespace prelight::test
