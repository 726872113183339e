// Files from strangers are refused at once by every command, and no data of the machine get into an output.
#include <gmock/gmock.h>

#include <filesystem>
#include <string>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::ordered_json;

constexpr const char* rule = "lies outside of the scene's folder";

class CliHostileFile : public CliTest {
 protected:
  void expectRefused(const GlbScene& scene, const std::string& part,
                     const std::string& place = "bad.glb") const {
    writeFile("bad.glb", scene.bytes());
    expectFailure(badInput, {"info", "bad.glb"}, {place, part});
    expectFailure(badInput, {"bake", "bad.glb", "-o", "out.glb", "--ao", "--rays", "16"}, {place, part});
    expectFailure(badInput, {"render", "bad.glb", "-o", "out.png"}, {place, part});
    expectFailure(badInput, {"compare", "bad.glb", "bad.glb"}, {place, part});
  }
};

TEST_F(CliHostileFile, LightMapThatIsADeviceOrAnEndlessName_IsRefusedAtOnce) {
  for (const std::string& image : {std::string("/dev/zero"), std::string(5000, 'x')}) {
    GlbScene scene = floorAndRoof();
    for (Json& node : scene.json["nodes"])
      if (node.contains("mesh"))
        node["extensions"]["PRELIGHT_transfer"]["primitives"] =
            Json::array({{{"lightmap", {{"texCoord", 0}, {"image", image}}}}});
    expectRefused(scene, "/lightmap/image");
  }
}

TEST_F(CliHostileFile, FilesOutsideTheFolder_AreRefusedUnlessAllowed) {
  std::filesystem::create_directory(path("scene"));
  writeFile("secret.bin", "the secret of the machine.......");
  GlbScene scene = floorAndRoof();
  scene.json["buffers"].push_back({{"byteLength", 32}, {"uri", "../secret.bin"}});
  writeFile("scene/bad.glb", scene.bytes());
  expectFailure(badInput, {"bake", "scene/bad.glb", "-o", "out.glb", "--ao", "--rays", "16"}, {rule});
  prelightDone({"bake", "scene/bad.glb", "-o", "out.glb", "--ao", "--rays", "16", "--allow-outside"});
  EXPECT_THAT(readFile("out.glb"), HasSubstr("the secret"));
  scene = floorAndRoof();
  scene.json["images"] = Json::array({{{"uri", "/etc/passwd"}}});
  expectRefused(scene, rule);
}

TEST_F(CliHostileFile, InstancesWithoutEnd_AreRefused) {
  GlbScene scene = floorAndRoof();
  scene.json["accessors"].push_back({{"componentType", 5126}, {"count", 10'000'000}, {"type", "VEC3"}});
  scene.json["nodes"][1]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
      scene.json["accessors"].size() - 1;
  expectRefused(scene, "10000000 instances");
}

TEST_F(CliHostileFile, NewerGltfThanItSays_IsRefused) {
  GlbScene scene = floorAndRoof();
  scene.json["asset"]["minVersion"] = "9.9";
  expectRefused(scene, "/asset/minVersion");
}

/// Vector occluders of such a scene would hold NaN.
TEST_F(CliHostileFile, CoordinatesBeyondMeasure_AreRefused) {
  GlbScene scene = floorAndRoof();
  scene.json["nodes"][1]["scale"] = {1e38, 1, 1};
  expectRefused(scene, "within 1e+15 m", "node \"roof\" (/nodes/1)");
}

TEST_F(CliHostileFile, SkyBeyondMeasure_IsRefused) {
  writeFile("scene.glb", floorAndRoof().bytes());
  // One texel of Radiance HDR: 0.5 x 2^127 in each channel.
  writeFile("sky.hdr", std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n") + "\x80\x80\x80\xFF");
  expectFailure(badInput, {"render", "scene.glb", "-o", "out.exr", "--env", "sky.hdr"},
                {"sky.hdr", "column 0, row 0"});
}

}  // namespace
}  // namespace prelight::test
