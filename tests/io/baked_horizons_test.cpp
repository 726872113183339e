#include <gtest/gtest.h>

#include "io/baked_file.h"
#include "io/misfit.h"
#include "scene/gltf/load/loader.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

struct HorizonFile {
  GltfDocument document = test::triangleDocument();
  CompiledScene scene;
  Bake bake;

  HorizonFile() {
    Warnings warnings;
    scene = compileScene(loadScene(document, warnings), warnings);
    bake.horizons = HorizonTransfer{5, {}, {}};
    for (std::size_t i = 0; i < scene.vertexCount() * 5; ++i)
      bake.horizons->angles.push_back(0.1f * static_cast<float>(i));
    for (const float angle : bake.horizons->angles) bake.horizons->feet.push_back(0.5f * angle);
  }
};

TEST(BakedHorizons, WriteRead_GivesThemBack) {
  HorizonFile file;
  const test::TemporaryFolder folder;
  embedBake(file.document, file.scene, file.bake);
  writeGlb(folder / "baked.glb", file.document);
  Warnings warnings;
  const std::optional<Bake> copy = readBake(readGltf(folder / "baked.glb", warnings), file.scene);
  ASSERT_TRUE(copy && copy->horizons);
  EXPECT_EQ(copy->horizons->sectors, 5);
  EXPECT_EQ(copy->horizons->angles, file.bake.horizons->angles);
  EXPECT_EQ(copy->horizons->feet, file.bake.horizons->feet);
}

TEST(BakedHorizons, FileWithoutFeet_HasNone) {
  HorizonFile file;
  file.bake.horizons->feet.clear();
  embedBake(file.document, file.scene, file.bake);
  const std::optional<Bake> copy = readBake(file.document, file.scene);
  ASSERT_TRUE(copy && copy->horizons);
  EXPECT_EQ(copy->horizons->angles, file.bake.horizons->angles);
  EXPECT_TRUE(copy->horizons->feet.empty());
}

TEST(BakedHorizons, BeyondARightAngle_AreRefused) {
  for (const float angle : {1.58f, -0.001f}) {
    HorizonFile file;
    file.bake.horizons->angles[7] = angle;
    embedBake(file.document, file.scene, file.bake);
    const std::string message = test::inputErrorOf([&] { readBake(file.document, file.scene); });
    EXPECT_NE(message.find("horizons/angles"), std::string::npos) << message;
    EXPECT_NE(message.find("expected angles from 0 to pi/2"), std::string::npos) << message;
  }
}

class HorizonMisfit : public testing::TestWithParam<test::Misfit> {};

TEST_P(HorizonMisfit, IsRefused) {
  const HorizonFile file;
  test::expectRefused(file.document, file.bake, file.scene, GetParam());
}

constexpr const char* sectorsPlace = "/nodes/0/extensions/PRELIGHT_transfer/primitives/0/horizons/sectors";
constexpr const char* anglesPlace = "/nodes/0/extensions/PRELIGHT_transfer/primitives/0/horizons/angles";

INSTANTIATE_TEST_SUITE_P(
    BakedHorizons, HorizonMisfit,
    testing::Values(test::Misfit{"TwoSectors", sectorsPlace, "2", "horizons/sectors"},
                    test::Misfit{"TooManySectors", sectorsPlace, "65", "horizons/sectors"},
                    test::Misfit{"OtherSectors", sectorsPlace, "6", "horizons/angles"},
                    test::Misfit{"TextSectors", sectorsPlace, "\"all\"", "horizons/sectors"},
                    test::Misfit{"NoSuchAccessor", anglesPlace, "999", "horizons/angles"},
                    test::Misfit{"Positions", anglesPlace, "0", "horizons/angles"}),
    [](const auto& tried) { return std::string(tried.param.name); });

}  // namespace
}  // namespace prelight
