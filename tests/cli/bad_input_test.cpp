#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;

class CliBadInput : public CliTest {
 protected:
  /// Bakes, draws and describes a spoiled scene. Each command must refuse the scene and name `place`.
  void expectRefused(const std::string& bytes, const std::string& place) const {
    writeFile("bad.glb", bytes);
    expectFailure(badInput, {"bake", "bad.glb", "-o", "out.glb", "--ao"}, {"bad.glb", place});
    expectFailure(badInput, {"render", "bad.glb", "-o", "out.png"}, {"bad.glb", place});
    expectFailure(badInput, {"info", "bad.glb"}, {"bad.glb", place});
  }

  static std::string spoiled(const std::function<void(GlbScene&)>& spoil) {
    GlbScene scene = floorAndRoof();
    spoil(scene);
    return scene.bytes();
  }
};

TEST_F(CliBadInput, File_Missing_IsNamed) {
  expectFailure(badInput, {"bake", "none.glb", "-o", "out.glb"}, {"none.glb"});
  expectFailure(badInput, {"info", "none.gltf"}, {"none.gltf"});
  expectFailure(badInput, {"compare", "a.exr", "b.exr"}, {"a.exr"});
  expectFailure(badInput, {"info", "."}, {"."});
}

TEST_F(CliBadInput, File_EmptyTruncatedOrForeign_IsRefused) {
  const std::string whole = floorAndRoof().bytes();
  expectRefused("", "");
  expectRefused("PNG, honestly", "");
  expectRefused(whole.substr(0, 10), "");
  expectRefused(whole.substr(0, whole.size() / 2), "");
  expectRefused(whole.substr(0, whole.size() - 40), "");
  expectRefused("XXXX" + whole.substr(4), "");
}

TEST_F(CliBadInput, Json_BrokenOrOfAnotherVersion_IsRefused) {
  writeFile("bad.gltf", "{\"asset\": {\"version\": \"2.0\"}, ");
  expectFailure(badInput, {"info", "bad.gltf"}, {"bad.gltf"});
  expectRefused(spoiled([](GlbScene& s) { s.json["asset"]["version"] = "1.0"; }), "/asset");
  expectRefused(spoiled([](GlbScene& s) { s.json["nodes"] = "none"; }), "/nodes");
}

TEST_F(CliBadInput, Index_OutOfRange_IsRefusedWithItsPlace) {
  expectRefused(spoiled([](GlbScene& s) { s.json["nodes"][1]["mesh"] = 7; }), "/nodes/1");
  expectRefused(spoiled([](GlbScene& s) { s.json["nodes"][1]["mesh"] = -1; }), "/nodes/1");
  expectRefused(spoiled([](GlbScene& s) { s.json["scenes"][0]["nodes"] = {0, 99}; }), "/scenes/0");
  expectRefused(spoiled([](GlbScene& s) { s.json["accessors"][0]["bufferView"] = 5; }), "/accessors/0");
  expectRefused(spoiled([](GlbScene& s) { s.json["meshes"][0]["primitives"][0]["material"] = 3; }),
                "/meshes/0");
  expectRefused(spoiled([](GlbScene& s) { s.bin[96] = 9; }), "/meshes/0");
}

TEST_F(CliBadInput, Accessor_PastItsBuffer_IsRefusedWithItsPlace) {
  expectRefused(spoiled([](GlbScene& s) { s.json["accessors"][0]["count"] = 4000; }), "/accessors/0");
  expectRefused(spoiled([](GlbScene& s) { s.json["bufferViews"][0]["byteLength"] = 1u << 30; }),
                "/bufferViews/0");
  expectRefused(spoiled([](GlbScene& s) { s.json["buffers"][0]["byteLength"] = 1u << 30; }), "/buffers/0");
}

TEST_F(CliBadInput, Nodes_InACycle_AreRefused) {
  expectRefused(spoiled([](GlbScene& s) {
                  s.json["nodes"][0]["children"] = {1};
                  s.json["nodes"][1]["children"] = {0};
                }),
                "/nodes/");
}

TEST_F(CliBadInput, Position_NotANumber_IsRefused) {
  expectRefused(spoiled([](GlbScene& s) {
                  const float nan = std::numeric_limits<float>::quiet_NaN();
                  std::memcpy(s.bin.data() + 4, &nan, sizeof nan);
                }),
                "/");
}

TEST_F(CliBadInput, RequiredExtension_Unknown_IsNamed) {
  expectRefused(spoiled([](GlbScene& s) { s.json["extensionsRequired"] = {"ACME_gravity"}; }),
                "ACME_gravity");
}

TEST_F(CliBadInput, UsedExtension_Unknown_IsOnlyAWarning) {
  writeFile("scene.glb", spoiled([](GlbScene& s) { s.json["extensionsUsed"].push_back("ACME_gravity"); }));
  EXPECT_THAT(prelightDone({"info", "scene.glb"}).errors, HasSubstr("ACME_gravity"));
}

TEST_F(CliBadInput, Image_Unreadable_IsOnlyAWarning) {
  writeFile("scene.glb", spoiled([](GlbScene& s) {
              s.json["images"] = nlohmann::ordered_json::parse(R"([{"uri": "lost.png"}])");
              s.json["textures"] = nlohmann::ordered_json::parse(R"([{"source": 0}])");
              s.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
            }));
  const ProcessResult info = prelightDone({"info", "scene.glb"});
  EXPECT_THAT(info.errors, HasSubstr("warning: "));
  EXPECT_THAT(info.errors, HasSubstr("lost.png"));
  prelightDone({"bake", "scene.glb", "-o", "out.glb", "--ao", "--rays", "16"});
}

TEST_F(CliBadInput, Triangles_OfZeroArea_AreDroppedAndCounted) {
  writeFile("scene.glb", spoiled([](GlbScene& s) { s.bin[98] = 0; }));  // Indices 0, 0, 2: a line.
  const nlohmann::json info = nlohmann::json::parse(prelightDone({"info", "scene.glb", "--json"}).output);
  EXPECT_EQ(info["contents"]["triangles"], 2);
  EXPECT_EQ(info["contents"]["droppedTriangles"], 2);
}

TEST_F(CliBadInput, EmptyScene_IsDescribedButNotBaked) {
  writeFile("empty.glb", emptyScene().bytes());
  const nlohmann::json info = nlohmann::json::parse(prelightDone({"info", "empty.glb", "--json"}).output);
  EXPECT_EQ(info["contents"]["triangles"], 0);
  expectFailure(badInput, {"bake", "empty.glb", "-o", "out.glb"}, {"empty.glb", "no triangles"});
}

TEST_F(CliBadInput, Sky_Unreadable_IsRefused) {
  writeFile("scene.glb", floorAndRoof().bytes());
  writeFile("sky.hdr", "#?RADIANCE\nnothing");
  expectFailure(badInput, {"render", "scene.glb", "-o", "out.png", "--env", "sky.hdr"}, {"sky.hdr"});
  expectFailure(badInput, {"render", "scene.glb", "-o", "out.png", "--env", "none.exr"}, {"none.exr"});
  expectFailure(badInput, {"bake", "scene.glb", "-o", "out.glb", "--env", "none.exr"}, {"none.exr"});
}

}  // namespace
}  // namespace prelight::test
