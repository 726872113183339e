// A broken part is a warning if it is not used, and an error if it is used.
#include <gtest/gtest.h>

#include <string>

#include "scene/gltf/accessor.h"
#include "scene/gltf/load/loader.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

struct UnusedCase {
  const char* name;
  const char* pointer;  ///< Pointer into the valid triangle; "-" appends.
  const char* value;
  const char* warning;
};

std::ostream& operator<<(std::ostream& out, const UnusedCase& c) { return out << c.name; }

class BrokenUnused : public testing::TestWithParam<UnusedCase> {};

TEST_P(BrokenUnused, Part_IsAWarningAndSurvivesWriting) {
  const UnusedCase& c = GetParam();
  GltfDocument document = test::triangleDocument();
  document.json[Json::json_pointer(c.pointer)] = Json::parse(c.value);
  const test::TemporaryFolder folder;
  writeGlb(folder / "odd.glb", document);
  Warnings warnings;
  const GltfDocument read = readGltf(folder / "odd.glb", warnings);
  EXPECT_EQ(loadScene(read, warnings).meshes.at(0).primitives.at(0).triangles.size(), 1u);
  EXPECT_TRUE(test::anyContains(warnings, c.warning)) << testing::PrintToString(warnings);
  writeGlb(folder / "again.glb", read);
  EXPECT_EQ(loadScene(readGltf(folder / "again.glb", warnings), warnings).meshes.at(0).primitives.size(), 1u);
}

const UnusedCase unusedCases[] = {
    {"BufferWithoutUri", "/buffers/-", R"({"byteLength": 100})", "/buffers/1"},
    {"BufferByHttp", "/buffers/-", R"({"byteLength": 100, "uri": "http://x/y.bin"})", "/buffers/1"},
    {"BufferMissing", "/buffers/-", R"({"byteLength": 100, "uri": "none.bin"})", "/buffers/1"},
    {"ViewOutOfRange", "/bufferViews/-", R"({"buffer": 0, "byteLength": 100000})", "/bufferViews/3"},
    {"ViewOfNoBuffer", "/bufferViews/-", R"({"buffer": 7, "byteLength": 1})", "/bufferViews/3"},
    {"AccessorType", "/accessors/-", R"({"componentType": 5126, "count": 24, "type": "NotaVEC3"})",
     "/accessors/3/type"},
    {"AccessorOutOfRange", "/accessors/-",
     R"({"bufferView": 0, "componentType": 5126, "count": 4000, "type": "VEC3"})", "/accessors/3"},
    {"AccessorOfNothing", "/accessors/-", R"({})", "/accessors/3"},
    {"LightType", "/extensions", R"({"KHR_lights_punctual": {"lights": [{"type": "spherical"}]}})",
     "/extensions/KHR_lights_punctual/lights/0/type"},
    {"CameraFov", "/cameras", R"([{"type": "perspective", "perspective": {"yfov": 4, "znear": 10}}])",
     "/cameras/0/perspective/yfov"},
    {"ImageView", "/images", R"([{"bufferView": 99}])", "/images/0/bufferView"},
};

INSTANTIATE_TEST_SUITE_P(Table, BrokenUnused, testing::ValuesIn(unusedCases),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(ReadGltf, BrokenPartOnceUsed_IsAnError) {
  const auto complaint = [](const char* accessor, const char* view, const char* buffer) {
    GltfDocument document = test::triangleDocument();
    document.json["buffers"].push_back(Json::parse(buffer));
    document.json["bufferViews"].push_back(Json::parse(view));
    document.json["accessors"].push_back(Json::parse(accessor));
    document.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 3;
    Warnings warnings;
    return test::inputErrorOf([&] { test::reload(document, warnings); });
  };
  const char* good = R"({"bufferView": 3, "componentType": 5126, "count": 3, "type": "VEC3"})";
  EXPECT_NE(complaint(R"({"componentType": 5126, "count": 3, "type": "NotaVEC3"})",
                      R"({"buffer": 0, "byteLength": 36})", R"({"byteLength": 0})")
                .find("/accessors/3/type"),
            std::string::npos);
  EXPECT_NE(complaint(good, R"({"buffer": 0, "byteLength": 99999})", R"({"byteLength": 0})")
                .find("/bufferViews/3: 99999 bytes"),
            std::string::npos);
  EXPECT_NE(complaint(good, R"({"buffer": 1, "byteLength": 36})", R"({"byteLength": 36, "uri": "none.bin"})")
                .find("/buffers/1/uri: no such file"),
            std::string::npos);
}

/// glTF allows such buffers, but nothing can be drawn from them.
TEST(ReadGltf, BufferLeftOut_SkipsWhatItShouldHold) {
  GltfDocument document = test::triangleDocument();
  document.json["buffers"].push_back({{"byteLength", 36}});
  document.json["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 36}});
  document.json["accessors"][1]["bufferView"] = 3;
  Warnings warnings;
  const Scene scene = test::reload(document, warnings);
  EXPECT_TRUE(scene.meshes.at(0).primitives.at(0).triangles.empty());
  EXPECT_TRUE(test::anyContains(warnings, "/buffers/1: it has neither a URI"));
  EXPECT_TRUE(test::anyContains(warnings, "/meshes/0/primitives/0: its data lie in a buffer"));
}

TEST(ReadGltf, ViewOfAMissingBuffer_ReachesNothing) {
  GltfDocument document = test::triangleDocument();
  document.json["buffers"].push_back({{"byteLength", 36}});
  document.json["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 36}});
  document.json["accessors"].push_back(
      {{"bufferView", 3}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
  const test::TemporaryFolder folder;
  writeGlb(folder / "odd.glb", document);
  Warnings warnings;
  const GltfDocument read = readGltf(folder / "odd.glb", warnings);
  EXPECT_NE(test::inputErrorOf([&] { AccessorReader(read, 3); }).find("/bufferViews/3"), std::string::npos);
}

TEST(ReadGltf, IntegersWrittenAsFloats_AreIntegers) {
  GltfDocument document = test::triangleDocument();
  document.json["nodes"] = Json::parse(R"([{"children": [1.0], "mesh": 0.0}, {}])");
  document.json["bufferViews"][0]["buffer"] = 0.0;
  document.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 0.0;
  Warnings warnings;
  EXPECT_EQ(test::reload(document, warnings).nodes.size(), 2u);
  document.json["nodes"][0]["mesh"] = 0.5;
  EXPECT_NE(test::inputErrorOf([&] { test::reload(document, warnings); }).find("/nodes/0/mesh"),
            std::string::npos);
}

TEST(ReadGltf, IndicesWithoutData_AreZeros) {
  GltfDocument document = test::triangleDocument();
  document.json["accessors"][2].erase("bufferView");
  Warnings warnings;
  EXPECT_EQ(test::reload(document, warnings).meshes[0].primitives[0].triangles.at(0), glm::uvec3(0));
}

TEST(ReadGltf, CustomAttributes_MayBeOfAnyTypeAndCount) {
  GltfDocument document = test::triangleDocument();
  document.json["accessors"].push_back({{"componentType", 5126}, {"count", 2}, {"type", "VEC17"}});
  document.json["meshes"][0]["primitives"][0]["attributes"]["_WIND"] = 3;
  Warnings warnings;
  EXPECT_EQ(test::reload(document, warnings).meshes[0].primitives[0].triangles.size(), 1u);
}

TEST(ReadGltf, AnimationWithoutTimes_RestsWithAWarning) {
  GltfDocument document = test::triangleDocument();
  document.json["accessors"].push_back({{"componentType", 5126}, {"count", 2}, {"type", "SCALAR"}});
  document.json["accessors"].push_back({{"componentType", 5126}, {"count", 2}, {"type", "VEC3"}});
  document.json["animations"] = Json::parse(
      R"([{"samplers": [{"input": 3, "output": 4}],
           "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}])");
  Warnings warnings;
  const Scene scene = test::reload(document, warnings);
  EXPECT_TRUE(test::anyContains(warnings, "no data"));
  EXPECT_TRUE(scene.animations.at(0).channels.empty());
}

TEST(ReadGltf, BytesAfterTheEnd_AreAWarning) {
  const test::TemporaryFolder folder;
  writeGlb(folder / "long.glb", test::triangleDocument());
  test::writeBytes(folder / "long.glb", test::readBytes(folder / "long.glb") + "x");
  Warnings warnings;
  EXPECT_EQ(loadScene(readGltf(folder / "long.glb", warnings), warnings).meshes.size(), 1u);
  EXPECT_TRUE(test::anyContains(warnings, "1 bytes after the end"));
}

TEST(ReadGltf, MinVersion_IsObeyed) {
  const auto complaint = [](const char* version, const char* least, Warnings& warnings) {
    GltfDocument document = test::triangleDocument();
    document.json["asset"] = {{"version", version}, {"minVersion", least}};
    return test::inputErrorOf([&] { test::reload(document, warnings); });
  };
  Warnings warnings;
  EXPECT_EQ(complaint("2.0", "2.0", warnings), "");
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(complaint("2.1", "2.1", warnings), "");
  EXPECT_TRUE(test::anyContains(warnings, "asks for glTF 2.1"));
  for (const char* least : {"9.9", "3.0", "2.1", "2.", "2.x", "1.0", "2.99999999999", ""})
    EXPECT_NE(complaint("2.0", least, warnings).find("/asset/minVersion"), std::string::npos) << least;
}

TEST(Accessor, MatricesOfBytes_SkipThePaddingOfColumns) {
  GltfDocument document = test::triangleDocument();
  // Two matrices with columns padded to 4 bytes; the padding of the last column is missing, which leaves 14
  // bytes.
  const int index = test::appendBytes(document, {1, 2, 0, 0, 3, 4, 0, 0, 5, 6, 0, 0, 7, 8}, "MAT2", 2, 5121);
  const AccessorReader reader(document, static_cast<std::size_t>(index));
  EXPECT_EQ(reader.floats(), (std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8}));
  document.json["bufferViews"].back()["byteLength"] = 13;
  EXPECT_NE(test::inputErrorOf([&] { AccessorReader(document, static_cast<std::size_t>(index)); }), "");
}

}  // namespace
}  // namespace prelight
