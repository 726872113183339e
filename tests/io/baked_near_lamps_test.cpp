#include <gtest/gtest.h>

#include <random>

#include "io/baked_file.h"
#include "io/misfit.h"
#include "scene/gltf/load/loader.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

struct ShellFile {
  GltfDocument document = test::triangleDocument();
  CompiledScene scene;
  Bake bake;

  ShellFile() {
    Warnings warnings;
    scene = compileScene(loadScene(document, warnings), warnings);
    NearLampTransfer transfer{2, 3, 0.125, 7.5, {}};
    std::mt19937 random(3);
    for (std::size_t i = 0; i < scene.vertexCount() * 12; ++i)
      transfer.halves.push_back(static_cast<std::uint16_t>(random() % 0x7c00));
    bake.nearLamps = transfer;
  }
};

TEST(BakedNearLamps, WriteRead_GivesThemBack) {
  ShellFile file;
  const test::TemporaryFolder folder;
  embedBake(file.document, file.scene, file.bake);
  writeGlb(folder / "baked.glb", file.document);
  Warnings warnings;
  const std::optional<Bake> copy = readBake(readGltf(folder / "baked.glb", warnings), file.scene);
  ASSERT_TRUE(copy && copy->nearLamps);
  EXPECT_EQ(copy->nearLamps->order, 2);
  EXPECT_EQ(copy->nearLamps->shells, 3);
  EXPECT_EQ(copy->nearLamps->nearest, 0.125);
  EXPECT_EQ(copy->nearLamps->farthest, 7.5);
  EXPECT_EQ(copy->nearLamps->halves, file.bake.nearLamps->halves);
}

TEST(BakedNearLamps, OfKeys_AreGivenBackAndMustBeAsMany) {
  ShellFile file;
  const HarmonicTransfer sh{1, 1, 0, std::vector<float>(file.scene.vertexCount(), 0.25f)};
  NearLampTransfer later = *file.bake.nearLamps;
  std::swap(later.halves.front(), later.halves.back());
  file.bake.animation = AnimatedTransfer{0, {0.0, 1.0}, {sh, sh}, {*file.bake.nearLamps, later}};
  file.document.json["animations"] = {{{"channels", nlohmann::ordered_json::array()}}};
  embedBake(file.document, file.scene, file.bake);
  const std::optional<Bake> copy = readBake(file.document, file.scene);
  ASSERT_TRUE(copy && copy->animation);
  ASSERT_EQ(copy->animation->nearLamps.size(), 2u);
  EXPECT_EQ(copy->animation->nearLamps[0].halves, file.bake.nearLamps->halves);
  EXPECT_EQ(copy->animation->nearLamps[1].halves, later.halves);
  EXPECT_EQ(copy->animation->nearLamps[1].farthest, 7.5);
  nlohmann::ordered_json& entry =
      file.document.json["nodes"][0]["extensions"]["PRELIGHT_transfer"]["primitives"][0]["nearLamps"];
  entry["keys"].erase(1);
  const std::string message = test::inputErrorOf([&] { readBake(file.document, file.scene); });
  EXPECT_NE(message.find("nearLamps/keys"), std::string::npos) << message;
}

TEST(BakedNearLamps, Infinite_IsRefused) {
  ShellFile file;
  file.bake.nearLamps->halves[5] = 0x7c00;
  embedBake(file.document, file.scene, file.bake);
  const std::string message = test::inputErrorOf([&] { readBake(file.document, file.scene); });
  EXPECT_NE(message.find("nearLamps/halves"), std::string::npos) << message;
  EXPECT_NE(message.find("finite"), std::string::npos) << message;
}

class NearLampMisfit : public testing::TestWithParam<test::Misfit> {};

TEST_P(NearLampMisfit, IsRefused) {
  const ShellFile file;
  test::expectRefused(file.document, file.bake, file.scene, GetParam());
}

constexpr const char* shellEntry = "/nodes/0/extensions/PRELIGHT_transfer/primitives/0/nearLamps";

std::vector<test::Misfit> shellMisfits() {
  static const std::string order = std::string(shellEntry) + "/order",
                           shells = std::string(shellEntry) + "/shells",
                           nearest = std::string(shellEntry) + "/nearest",
                           farthest = std::string(shellEntry) + "/farthest",
                           halves = std::string(shellEntry) + "/halves";
  return {{"NoBands", order.c_str(), "0", "nearLamps/order"},
          {"TooManyBands", order.c_str(), "33", "nearLamps/order"},
          {"OtherOrder", order.c_str(), "3", "nearLamps/halves"},
          {"OneShell", shells.c_str(), "1", "nearLamps/shells"},
          {"TooManyShells", shells.c_str(), "33", "nearLamps/shells"},
          {"OtherShells", shells.c_str(), "4", "nearLamps/halves"},
          {"NoNearest", nearest.c_str(), "0", "0 < nearest < farthest"},
          {"Reversed", nearest.c_str(), "8", "0 < nearest < farthest"},
          {"TextFarthest", farthest.c_str(), "\"far\"", "nearLamps/farthest"},
          {"NoSuchAccessor", halves.c_str(), "999", "nearLamps/halves"},
          {"Floats", halves.c_str(), "0", "nearLamps/halves"}};
}

INSTANTIATE_TEST_SUITE_P(BakedNearLamps, NearLampMisfit, testing::ValuesIn(shellMisfits()),
                         [](const auto& tried) { return std::string(tried.param.name); });

}  // namespace
}  // namespace prelight
