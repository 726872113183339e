// What breaks a rule that nothing depends on is a warning with its place, once for each rule; what is right,
// none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/gltf/gltf_document.h"
#include "scene/gltf/gltf_oddities.h"
#include "scene/gltf/loader.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

Warnings odditiesOf(const std::string& json) {
  Warnings warnings;
  warnOfOddities(Json::parse(json), "a.gltf", warnings);
  return warnings;
}

void expectOdd(const std::string& json, const std::string& text) {
  EXPECT_THAT(odditiesOf(json), testing::ElementsAre(testing::HasSubstr(text))) << json;
}

TEST(Oddities, RightFile_HasNone) {
  EXPECT_THAT(odditiesOf(test::triangleDocument().json.dump()), testing::IsEmpty());
}

TEST(Oddities, EmptyArrays_AreCounted) {
  expectOdd(R"({"nodes": [{"children": []}, {"children": []}], "meshes": []})",
            "a.gltf: /nodes/0/children: an empty array, expected one element at least; so in 2 more places");
}

TEST(Oddities, Extensions_AreListedAndInTheirPlace) {
  expectOdd(R"({"nodes": [{"extensions": {"EXT_other": {}}}]})",
            "/nodes/0/extensions/EXT_other: an extension that");
  expectOdd(
      R"({"extensionsUsed": ["KHR_materials_ior"], "nodes": [{"extensions": {"KHR_materials_ior": {}}}]})",
      "/nodes/0/extensions/KHR_materials_ior: an extension that has no place here");
  expectOdd(R"({"extensionsUsed": ["EXT_a"], "extensions": {"EXT_a": 3}})",
            "/extensions/EXT_a: an extension that is no object");
  expectOdd(R"({"extensionsUsed": ["EXT_a", "EXT_a"]})",
            "/extensionsUsed/1: an extension that is listed twice");
  EXPECT_THAT(odditiesOf(R"({"extensionsUsed": ["KHR_texture_transform"], "materials": [{"normalTexture":
                {"extensions": {"KHR_texture_transform": {}}}}], "extras": {"anything": []}})"),
              testing::IsEmpty());
}

TEST(Oddities, Parts_NamePlaceAndRule) {
  expectOdd(R"({"accessors": [{"byteOffset": 4}]})", "/accessors/0/byteOffset: a byteOffset without");
  expectOdd(R"({"accessors": [{"componentType": 5126, "normalized": true}]})", "/accessors/0/normalized");
  expectOdd(R"({"bufferViews": [{"byteLength": 8, "byteStride": 16}]})",
            "/bufferViews/0/byteStride: a byteStride that is longer");
  expectOdd(R"({"bufferViews": [{"byteLength": 80, "byteStride": 16, "target": 34963}]})",
            "not for vertices");
  expectOdd(R"({"images": [{}]})", "/images/0: an image names either");
  expectOdd(R"({"images": [{"bufferView": 0}]})", "without a mimeType");
  expectOdd(R"({"nodes": [{"rotation": [0, 0, 0, 2]}]})", "/nodes/0/rotation");
  expectOdd(R"({"nodes": [{"matrix": [1], "scale": [1, 1, 1]}]})", "/nodes/0/matrix");
  expectOdd(R"({"nodes": [{"skin": 0}]})", "/nodes/0/skin: skin without a mesh");
  expectOdd(R"({"cameras": [{"perspective": {"znear": 2, "zfar": 1}}]})", "zfar is not beyond znear");
  expectOdd(R"({"meshes": [{"primitives": [{"attributes": {"COLOUR": 0}}]}]})",
            "/meshes/0/primitives/0/attributes/COLOUR: an attribute of no known name");
}

std::string errorOf(const std::string& name, const std::string& bytes) {
  return test::inputErrorOf([&] {
    Warnings warnings;
    (void)parseGltf(std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), name,
                    warnings);
  });
}

TEST(ReadGltf, OtherFormats_NameAConverter) {
  EXPECT_THAT(errorOf("a/tree.obj", "# tree\nv 0 0 0\n"),
              testing::AllOf(testing::HasSubstr("Wavefront OBJ"),
                             testing::HasSubstr("assimp export tree.obj OUT.glb")));
  EXPECT_THAT(errorOf("scan.PLY", "ply\nformat ascii 1.0\n"), testing::HasSubstr("the file is PLY"));
  EXPECT_THAT(errorOf("part.stl", std::string(90, '\0')), testing::HasSubstr("the file is STL"));
  EXPECT_THAT(errorOf("set.usda", "#usda 1.0\n"),
              testing::AllOf(testing::HasSubstr("USD"), testing::HasSubstr("Blender")));
  EXPECT_THAT(errorOf("unnamed", "PXR-USDC\0\0"), testing::HasSubstr("USD"));
  EXPECT_THAT(errorOf("scene.gltf", "nonsense"), testing::HasSubstr("line 1"));
}

}  // namespace
}  // namespace prelight
