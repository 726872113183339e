#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "prelight/error.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/load/loader.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using test::inputErrorOf;
using test::TemporaryFolder;
using test::triangleDocument;

/// A change to the valid triangle (a value put at a JSON pointer), and a text that the error must contain.
struct BrokenCase {
  const char* name;
  const char* pointer;
  const char* value;
  const char* expected;
};

std::ostream& operator<<(std::ostream& out, const BrokenCase& c) { return out << c.name; }

class BrokenGltf : public testing::TestWithParam<BrokenCase> {};

TEST_P(BrokenGltf, Read_ThrowsNamingThePlace) {
  const BrokenCase& c = GetParam();
  GltfDocument document = triangleDocument();
  document.json[nlohmann::ordered_json::json_pointer(c.pointer)] = nlohmann::ordered_json::parse(c.value);
  const TemporaryFolder folder;
  writeGlb(folder / "broken.glb", document);
  Warnings warnings;
  const std::string message =
      inputErrorOf([&] { loadScene(readGltf(folder / "broken.glb", warnings), warnings); });
  EXPECT_NE(message.find("broken.glb: "), std::string::npos) << message;
  EXPECT_NE(message.find(c.expected), std::string::npos) << message;
}

const BrokenCase brokenCases[] = {
    {"Version", "/asset/version", R"("1.0")", "/asset/version: glTF version \"1.0\""},
    {"VersionType", "/asset/version", "2", "/asset/version: expected a string, got 2"},
    {"Asset", "/asset", "[]", "/asset: expected an object"},
    {"Required", "/extensionsRequired", R"(["GOOGLE_texture_basis"])", "GOOGLE_texture_basis"},
    {"NodesType", "/nodes", "{}", "/nodes: expected an array"},
    {"NodeType", "/nodes/0", "7", "/nodes/0: expected an object, got 7"},
    {"Mesh", "/nodes/0/mesh", "1", "/nodes/0/mesh: mesh index 1 out of range, expected 0..0"},
    {"MeshNegative", "/nodes/0/mesh", "-1", "/nodes/0/mesh: expected a non-negative integer, got -1"},
    {"MeshFloat", "/nodes/0/mesh", "0.5", "/nodes/0/mesh: expected a non-negative integer, got 0.5"},
    {"MeshHuge", "/nodes/0/mesh", "18446744073709551615", "/nodes/0/mesh: mesh index 18446744073709551615"},
    {"Camera", "/nodes/0/camera", "0", "/nodes/0/camera: camera index 0 out of range, the file has none"},
    {"Skin", "/nodes/0/skin", "0", "/nodes/0/skin"},
    {"Matrix", "/nodes/0/matrix", "[1, 2, 3]", "/nodes/0/matrix: expected 16 numbers"},
    {"Rotation", "/nodes/0/rotation", R"([0, 0, 0, "1"])", "/nodes/0/rotation/3: expected a number"},
    {"Child", "/nodes/0/children", "[3]", "/nodes/0/children/0: node index 3"},
    {"SelfChild", "/nodes/0/children", "[0]", "/nodes/0: the node is its own ancestor"},
    {"TwoParents", "/nodes", R"([{"children": [2]}, {"children": [2]}, {}])",
     "/nodes/1/children/0: node 2 is already"},
    {"TwiceChild", "/nodes", R"([{"children": [1, 1]}, {}])", "/nodes/0/children/1: node 1 is already"},
    {"Cycle", "/nodes", R"([{}, {"children": [2]}, {"children": [1]}])", "the node is its own ancestor"},
    {"SceneTwice", "/scenes/0/nodes", "[0, 0]", "/scenes/0/nodes/1: node 0 is listed twice"},
    {"Scene", "/scene", "4", "/scene: scene index 4"},
    {"SceneNode", "/scenes/0/nodes/0", "9", "/scenes/0/nodes/0: node index 9"},
    {"Attribute", "/meshes/0/primitives/0/attributes/POSITION", "12",
     "/meshes/0/primitives/0/attributes/POSITION: accessor index 12 out of range, expected 0..2"},
    {"AttributeType", "/meshes/0/primitives/0/attributes/POSITION", "2",
     "attributes/POSITION: expected an accessor"},
    {"Indices", "/meshes/0/primitives/0/indices", "0",
     "/meshes/0/primitives/0/indices: expected unsigned integers"},
    {"Material", "/meshes/0/primitives/0/material", "5", "/meshes/0/primitives/0/material: material index 5"},
    {"Mode", "/meshes/0/primitives/0/mode", "7", "/meshes/0/primitives/0/mode: expected 0..6"},
    {"Primitives", "/meshes/0/primitives", "null", "/meshes/0/primitives: expected an array"},
    {"Target", "/meshes/0/primitives/0/targets", R"([{"POSITION": 40}])",
     "targets/0/POSITION: accessor index 40"},
    {"AttributeCount", "/accessors/1/count", "2", "attributes/NORMAL: 2 vertices, but POSITION has 3"},
    {"CountZero", "/accessors/0/count", "0", "/accessors/0/count: expected a positive integer"},
    {"CountLong", "/accessors/0/count", "4", "/accessors/0: 4 elements of 12 bytes"},
    {"CountHuge", "/accessors/0/count", "9223372036854775807", "/accessors/0: 9223372036854775807 elements"},
    {"Offset", "/accessors/0/byteOffset", "18446744073709551612", "/accessors/0: 3 elements"},
    {"ComponentType", "/accessors/0/componentType", "5124", "/accessors/0/componentType: expected one of"},
    {"AccessorType", "/accessors/0/type", R"("VEC5")", "/accessors/0/type: expected SCALAR"},
    {"View", "/accessors/0/bufferView", "3", "/accessors/0/bufferView: buffer view index 3"},
    {"ViewLength", "/bufferViews/0/byteLength", "1000",
     "/bufferViews/0: 1000 bytes from offset 0 reach beyond"},
    {"ViewOverflow", "/bufferViews/0/byteOffset", "18446744073709551600", "/bufferViews/0: 36 bytes"},
    {"ViewBuffer", "/bufferViews/0/buffer", "1", "/bufferViews/0/buffer: buffer index 1"},
    {"Stride", "/bufferViews/0/byteStride", "6", "/bufferViews/0/byteStride: expected a multiple of 4"},
    {"StrideSmall", "/bufferViews/0/byteStride", "8", "/accessors/0: elements of 12 bytes do not fit"},
    {"StrideLong", "/bufferViews/0/byteStride", "16", "/accessors/0: 3 elements of 12 bytes, 16 apart"},
    {"Buffer", "/buffers/0/byteLength", "100000000000000",
     "/buffers/0/byteLength: expected 100000000000000 bytes"},
    {"NoBuffer", "/buffers/0", R"({"byteLength": 80, "uri": "none.bin"})", "/buffers/0/uri: no such file"},
    {"RemoteBuffer", "/buffers/0", R"({"byteLength": 80, "uri": "http://x/y"})", "URI scheme \"http\""},
    {"BadDataUri", "/buffers/0", R"({"byteLength": 80, "uri": "data:;base64,*"})",
     "/buffers/0/uri: malformed data"},
    {"ZeroesTooMany", "/accessors/0", R"({"componentType": 5126, "count": 4000000000, "type": "VEC3"})",
     "/accessors/0/count: 4000000000 elements without a buffer view"},
    {"SparseCount", "/accessors/0/sparse",
     R"({"count": 4, "indices": {"bufferView": 2, "componentType": 5123}, "values": {"bufferView": 0}})",
     "/accessors/0/sparse/count: 4 substitutes"},
    {"SparseType", "/accessors/0/sparse",
     R"({"count": 1, "indices": {"bufferView": 2, "componentType": 5122}, "values": {"bufferView": 0}})",
     "/accessors/0/sparse/indices/componentType"},
    {"SparseView", "/accessors/0/sparse",
     R"({"count": 1, "indices": {"bufferView": 7, "componentType": 5123}, "values": {"bufferView": 0}})",
     "/accessors/0/sparse/indices/bufferView"},
    {"SparseRange", "/accessors/0/sparse",
     R"({"count": 3, "indices": {"bufferView": 2, "componentType": 5123, "byteOffset": 2}, "values": {"bufferView": 0}})",
     "/accessors/0/sparse/indices: 3 elements of 2 bytes"},
    {"SparseOrder", "/accessors/0/sparse",
     R"({"count": 3, "indices": {"bufferView": 2, "componentType": 5121}, "values": {"bufferView": 0}})",
     "/accessors/0/sparse/indices: sparse index 1 is 0 after 0"},
    {"SparseIndex", "/accessors/0/sparse",
     R"({"count": 1, "indices": {"bufferView": 1, "componentType": 5125, "byteOffset": 8}, "values": {"bufferView": 0}})",
     "/accessors/0/sparse/indices: sparse index 0 is 1065353216"},
    {"VertexIndex", "/accessors/2",
     R"({"bufferView": 1, "byteOffset": 8, "componentType": 5125, "count": 3, "type": "SCALAR"})",
     "/meshes/0/primitives/0/indices: index 0 refers to vertex 1065353216, expected 0..2"},
    {"Texture", "/materials/0/emissiveTexture", R"({"index": 0})",
     "/materials/0/emissiveTexture/index: texture index"},
    {"TextureSource", "/textures", R"([{"source": "x"}])", "/textures/0/source"},
    {"Sampler", "/textures", R"([{"sampler": 0}])", "/textures/0/sampler: sampler index 0"},
    {"Wrap", "/samplers", R"([{"wrapS": 1}])", "/samplers/0/wrapS"},
    {"BaseColor", "/materials/0/pbrMetallicRoughness", R"({"baseColorFactor": [1, 1, 1]})",
     "/materials/0/pbrMetallicRoughness/baseColorFactor: expected 4 numbers"},
    {"Metallic", "/materials/0/pbrMetallicRoughness", R"({"metallicFactor": "1"})",
     "metallicFactor: expected a number"},
    {"AlphaMode", "/materials/0/alphaMode", R"("GLASS")", "/materials/0/alphaMode: expected OPAQUE"},
    {"DoubleSided", "/materials/0/doubleSided", "1", "/materials/0/doubleSided: expected true or false"},
    {"Ior", "/materials/0/extensions", R"({"KHR_materials_ior": {"ior": []}})", "KHR_materials_ior/ior"},
    {"Strength", "/materials/0/extensions",
     R"({"KHR_materials_emissive_strength": {"emissiveStrength": 1e300}})",
     "emissiveStrength: 1e+300 does not fit a 32-bit float"},
    {"LightIndex", "/nodes/0/extensions", R"({"KHR_lights_punctual": {"light": 0}})",
     "/nodes/0/extensions/KHR_lights_punctual/light: light index 0"},
    {"Instancing", "/nodes/0/extensions", R"({"EXT_mesh_gpu_instancing": {"attributes": {"SCALE": 2}}})",
     "/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes/SCALE: expected an accessor of type VEC3"},
};

/// These parts are not used by the triangle until its node refers to them.
TEST(ReadGltf, BrokenCameraLightOrImage_ThrowsOnceUsed) {
  const auto complaint = [](const char* cameras, const char* lights, const char* images) {
    using Json = nlohmann::ordered_json;
    GltfDocument document = triangleDocument();
    const Json punctual = {{"KHR_lights_punctual", {{"lights", Json::parse(lights)}}}};
    document.json["cameras"] = Json::parse(cameras);
    document.json["extensions"] = punctual;
    document.json["images"] = Json::parse(images);
    if (!document.json["cameras"].empty()) document.json["nodes"][0]["camera"] = 0;
    if (lights != std::string("[]"))
      document.json["nodes"][0]["extensions"] = {{"KHR_lights_punctual", {{"light", 0}}}};
    document.json["textures"] = Json::parse(images == std::string("[]") ? "[]" : R"([{"source": 0}])");
    Warnings warnings;
    return inputErrorOf([&] { test::reload(document, warnings); });
  };
  const auto expect = [](const std::string& message, const char* part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  expect(complaint(R"([{"type": "fisheye"}])", "[]", "[]"), "/cameras/0/type: expected perspective");
  expect(complaint(R"([{"type": "perspective", "perspective": {"yfov": 0, "znear": 1}}])", "[]", "[]"),
         "/cameras/0/perspective/yfov: expected a positive number");
  expect(complaint("[]", R"([{"type": "area"}])", "[]"),
         "/extensions/KHR_lights_punctual/lights/0/type: expected point");
  expect(complaint("[]", R"([{"type": "spot"}])", "[]"), "\"spot\" is missing");
  expect(complaint("[]", "[]", R"([{"bufferView": 99}])"), "/images/0/bufferView: buffer view index 99");
}

INSTANTIATE_TEST_SUITE_P(Table, BrokenGltf, testing::ValuesIn(brokenCases),
                         [](const auto& instance) { return std::string(instance.param.name); });

std::string errorOfText(const std::string& text) {
  const TemporaryFolder folder;
  test::writeBytes(folder / "file.gltf", text);
  Warnings warnings;
  return inputErrorOf([&] { readGltf(folder / "file.gltf", warnings); });
}

TEST(ReadGltf, EmptyScene_IsAccepted) {
  const TemporaryFolder folder;
  test::writeBytes(folder / "file.gltf", R"({"asset":{"version":"2.0"}})");
  Warnings warnings;
  const GltfDocument document = readGltf(folder / "file.gltf", warnings);
  const CompiledScene scene = compileScene(loadScene(document, warnings), warnings);
  EXPECT_EQ(scene.vertexCount(), 0u);
  EXPECT_FALSE(document.json.contains("buffers"));
  EXPECT_TRUE(warnings.empty());
}

TEST(ReadGltf, MissingFileFolderAndEmptyFile_Throw) {
  const TemporaryFolder folder;
  Warnings warnings;
  EXPECT_NE(inputErrorOf([&] { readGltf(folder / "no.gltf", warnings); }).find("no such file"),
            std::string::npos);
  EXPECT_NE(inputErrorOf([&] { readGltf(folder.path(), warnings); }).find("not a regular file"),
            std::string::npos);
  EXPECT_NE(errorOfText("").find("empty"), std::string::npos);
}

TEST(ReadGltf, SyntaxError_NamesLineAndColumn) {
  EXPECT_NE(errorOfText("{\n  \"asset\": {,\n}").find("file.gltf: line 2, column 13: "), std::string::npos)
      << errorOfText("{\n  \"asset\": {,\n}");
  EXPECT_NE(errorOfText("{\n\"a\": 1e999}").find("line 2, column 6"), std::string::npos);
  EXPECT_NE(errorOfText("not json").find("line 1, column"), std::string::npos);
  EXPECT_NE(errorOfText("{\"a\": \"\xFF\"}").find("line 1, column"), std::string::npos);
}

TEST(ReadGltf, DeepNesting_Throws) {
  EXPECT_NE(errorOfText(std::string(1000000, '[')).find("nested deeper"), std::string::npos);
}

TEST(ReadGltf, BadGlbHeaders_Throw) {
  const TemporaryFolder folder;
  writeGlb(folder / "good.glb", triangleDocument());
  const std::string good = test::readBytes(folder / "good.glb");
  const auto errorOf = [&](const std::string& bytes) {
    test::writeBytes(folder / "bad.glb", bytes);
    Warnings warnings;
    return inputErrorOf([&] { readGltf(folder / "bad.glb", warnings); });
  };
  const auto patched = [&](std::size_t at, char value) {
    std::string bytes = good;
    bytes[at] = value;
    return bytes;
  };
  EXPECT_NE(errorOf(good.substr(0, 10)).find("truncated"), std::string::npos);
  EXPECT_NE(errorOf(good.substr(0, good.size() - 4)).find("header says"), std::string::npos);
  EXPECT_NE(errorOf(patched(4, 1)).find("version 1"), std::string::npos);
  EXPECT_NE(errorOf(patched(15, 0x7F)).find("chunk 0 says"), std::string::npos);
  EXPECT_NE(errorOf(patched(16, 'X')).find("JSON chunk"), std::string::npos);
  EXPECT_EQ(errorOf(good), "");
}

TEST(ReadGltf, UnknownExtensionUsed_Warns) {
  GltfDocument document = triangleDocument();
  document.json["extensionsUsed"] = {"XYZ_novelty", "KHR_materials_ior"};
  Warnings warnings;
  test::reload(document, warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("XYZ_novelty"), std::string::npos);
}

TEST(ReadGltf, ChainOf100000Nodes_DoesNotOverflowTheStack) {
  GltfDocument document = triangleDocument();
  auto& nodes = document.json["nodes"];
  constexpr int count = 100000;
  nodes = nlohmann::ordered_json::array();
  for (int i = 0; i + 1 < count; ++i) nodes.push_back({{"children", {i + 1}}});
  nodes.push_back({{"mesh", 0}});
  Warnings warnings;
  EXPECT_EQ(test::reload(document, warnings).meshNodes.size(), 1u);
  nodes[count - 1]["children"] = {0};
  EXPECT_NE(inputErrorOf([&] { test::reload(document, warnings); }).find("ancestor"), std::string::npos);
}

TEST(ReadGltf, IdleTextureWithoutImage_OnlyWarns) {
  GltfDocument document = triangleDocument();
  document.json["textures"] = nlohmann::ordered_json::array({{{"source", 0}}});
  Warnings warnings;
  test::reload(document, warnings);
  EXPECT_TRUE(test::anyContains(warnings, "/textures/0/source"));
}

}  // namespace
}  // namespace prelight
