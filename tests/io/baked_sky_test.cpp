#include "io/baked_sky.h"

#include <gtest/gtest.h>

#include "io/baked_file.h"
#include "io/misfit.h"
#include "scene/gltf/load/loader.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

struct LitFile {
  GltfDocument document = test::triangleDocument();
  CompiledScene scene;
  Bake bake;

  LitFile() {
    Warnings warnings;
    scene = compileScene(loadScene(document, warnings), warnings);
    bake.irradiance.emplace(scene.vertexCount(), glm::vec3(1.0f));
  }
};

TEST(BakedSky, WriteRead_GivesItBack) {
  LitFile file;
  file.bake.info.sky = BakedSky{"../skies/courtyard.exr", 0.75, 0xfedcba9876543210u};
  embedBake(file.document, file.scene, file.bake);
  const std::optional<BakedSky> named = readBakedSky(file.document);
  ASSERT_TRUE(named);
  EXPECT_EQ(named->name, "../skies/courtyard.exr");
  EXPECT_EQ(named->rotation, 0.75);
  EXPECT_EQ(named->hash, 0xfedcba9876543210u);
  const std::optional<Bake> copy = readBake(file.document, file.scene);
  ASSERT_TRUE(copy && copy->info.sky);
  EXPECT_EQ(copy->info.sky->name, named->name);
}

TEST(BakedSky, FileWithoutOne_NamesNone) {
  LitFile file;
  EXPECT_FALSE(readBakedSky(file.document)) << "no bake";
  embedBake(file.document, file.scene, file.bake);
  EXPECT_FALSE(readBakedSky(file.document));
  EXPECT_FALSE(readBake(file.document, file.scene)->info.sky);
}

TEST(BakedSky, HashThatIsNone_IsRefused) {
  LitFile file;
  file.bake.info.sky = BakedSky{"studio", 0.0, 1};
  embedBake(file.document, file.scene, file.bake);
  file.document.json["extensions"]["PRELIGHT_transfer"]["sky"]["hash"] = "courtyard";
  const std::string message = test::inputErrorOf([&] { (void)readBakedSky(file.document); });
  EXPECT_NE(message.find("sky/hash"), std::string::npos) << message;
}

TEST(BakedSky, OtherTexels_HaveAnotherHash) {
  Environment sky = constantEnvironment(glm::vec3(0.5f));
  const std::uint64_t before = skyHash(sky);
  EXPECT_EQ(skyHash(constantEnvironment(glm::vec3(0.5f))), before);
  sky.radiance[0].g += 1e-6f;
  EXPECT_NE(skyHash(sky), before);
}

}  // namespace
}  // namespace prelight
