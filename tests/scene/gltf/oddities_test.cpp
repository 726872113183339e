// Breaking a rule that nothing depends on gives a warning with its place, once per rule. Correct files give
// none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "scene/gltf/gltf_document.h"
#include "scene/gltf/gltf_oddities.h"
#include "scene/gltf/load/loader.h"
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
  GltfDocument document = test::triangleDocument();
  document.json["accessors"][0]["min"] = {0, 0, 0};
  document.json["accessors"][0]["max"] = {1, 1, 0};
  const test::TemporaryFolder folder;
  writeGlb(folder / "a.glb", document);
  Warnings warnings;
  (void)readGltf(folder / "a.glb", warnings, {.tellOddities = true});
  EXPECT_THAT(warnings, testing::IsEmpty());
}

/// Oddities are reported only on request.
TEST(Oddities, ValuesOutsideOfTheirLimits_AreTold) {
  GltfDocument document = test::triangleDocument();
  document.json["accessors"][0]["min"] = {0, 0, 0};
  document.json["accessors"][0]["max"] = {0.5, 1, 0};
  const int accessor = test::appendFloats(document, {NAN, 1, 2}, "SCALAR");
  const test::TemporaryFolder folder;
  writeGlb(folder / "a.glb", document);
  Warnings silent, warnings;
  (void)readGltf(folder / "a.glb", silent);
  (void)readGltf(folder / "a.glb", warnings, {.tellOddities = true});
  EXPECT_THAT(silent, testing::IsEmpty());
  EXPECT_THAT(warnings,
              testing::ElementsAre(testing::HasSubstr("/accessors/0: values outside of min and max"),
                                   testing::HasSubstr("/accessors/" + std::to_string(accessor) +
                                                      ": values that are not finite")));
}

TEST(Oddities, PictureThatIsNone_IsTold) {
  GltfDocument document = test::triangleDocument();
  document.json["accessors"][0]["min"] = {0, 0, 0};
  document.json["accessors"][0]["max"] = {1, 1, 0};
  document.json["images"] = {{{"bufferView", 0}, {"mimeType", "image/png"}}};
  const test::TemporaryFolder folder;
  writeGlb(folder / "a.glb", document);
  Warnings warnings;
  (void)readGltf(folder / "a.glb", warnings, {.tellOddities = true});
  EXPECT_THAT(warnings, testing::ElementsAre(testing::HasSubstr("/images/0: data that are no picture")));
}

TEST(Oddities, Meshes_NamePlaceAndRule) {
  const std::string place = "/meshes/0/primitives/0";
  const auto withPrimitive = [](const std::string& primitive, const std::string& rest) {
    return R"({"meshes": [{"primitives": [)" + primitive + "]}]" + rest + "}";
  };
  expectOdd(withPrimitive(R"({"attributes": {"POSITION": 0}})", R"(, "accessors": [{"type": "VEC3"}])"),
            place + "/attributes/POSITION: positions without min and max");
  expectOdd(withPrimitive(R"({"attributes": {"NORMAL": 0}})",
                          R"(, "accessors": [{"bufferView": 0, "byteOffset": 2}])"),
            place + "/attributes/NORMAL: vertices that do not begin");
  expectOdd(withPrimitive(R"({"attributes": {"_A": 0}})", R"(, "accessors": [{"componentType": 5125}])"),
            place + "/attributes/_A: vertices of 32-bit");
  expectOdd(withPrimitive(
                R"({"attributes": {}, "indices": 0})",
                R"(, "accessors": [{"bufferView": 0}], "bufferViews": [{"byteStride": 4, "byteLength": 8}])"),
            place + "/indices: indices in a buffer view with a byteStride");
  expectOdd(withPrimitive(R"({"attributes": {}, "material": 0})",
                          R"(, "materials": [{"normalTexture": {"texCoord": 1}}])"),
            place + "/material: a material with textures");
}

TEST(Oddities, EmptyArrays_AreCounted) {
  expectOdd(
      R"({"nodes": [{"children": []}, {"children": []}], "meshes": []})",
      "a.gltf: /nodes/0/children: an empty array, expected one element at least; also in 2 more places");
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
  expectOdd(R"({"images": [{"uri": "a.webp", "mimeType": "image/webp"}]})", "/images/0: a picture of a type");
  expectOdd(R"({"images": [{"uri": "data:image/png;base64,AA==", "mimeType": "image/jpeg"}]})",
            "/images/0/mimeType");
  expectOdd(R"({"buffers": [{"uri": "data:text/plain,a"}]})", "/buffers/0/uri: a MIME type other than");
  expectOdd(R"({"nodes": [{"rotation": [0, 0, 0, 2]}]})", "/nodes/0/rotation");
  expectOdd(R"({"nodes": [{"matrix": [1], "scale": [1, 1, 1]}]})", "/nodes/0/matrix");
  expectOdd(R"({"cameras": [{"perspective": {"znear": 2, "zfar": 1}}]})", "zfar is not beyond znear");
  expectOdd(R"({"meshes": [{"primitives": [{"attributes": {"COLOUR": 0}}]}]})",
            "/meshes/0/primitives/0/attributes/COLOUR: an attribute with an unknown name");
}

TEST(Oddities, ViewsOfSeveralUses_AreTold) {
  expectOdd(R"({"meshes": [{"primitives": [{"attributes": {"_A": 0, "_B": 1}}]}],
                "accessors": [{"bufferView": 0}, {"bufferView": 0}], "bufferViews": [{}]})",
            "/meshes/0/primitives/0/attributes/_B: vertices of two accessors");
  expectOdd(R"({"meshes": [{"primitives": [{"attributes": {"_A": 0}, "indices": 1}]}],
                "accessors": [{"bufferView": 0}, {"bufferView": 0}], "bufferViews": [{}]})",
            "/meshes/0/primitives/0/indices: vertices and indices in one");
  expectOdd(R"({"buffers": [{"uri": "data:application/octet-stream;;base64,AA=="}]})",
            "/buffers/0/uri: a data URI with an empty parameter");
}

TEST(Oddities, Tangents_AreOfTheFileOrOfANormalTexture) {
  const std::string mesh = R"({"meshes": [{"primitives": [{"attributes": {"TEXCOORD_0": 0}, "material": 0}]}],
      "extensionsUsed": ["KHR_materials_clearcoat"], "materials": [{"extensions": {"KHR_materials_clearcoat":
      {"clearcoatNormalTexture": {}}})";
  expectOdd(mesh + "}]}", "/meshes/0/primitives/0/material: a material that needs tangents");
  EXPECT_THAT(odditiesOf(mesh + R"(, "normalTexture": {}}]})"), testing::IsEmpty());
}

TEST(Oddities, Skins_NamePlaceAndRule) {
  const std::string nodes = R"({"nodes": [{"children": [1]}, {}, {}], "skins": [)";
  expectOdd(nodes + R"({"joints": [0, 1], "skeleton": 2}]})",
            "/skins/0/skeleton: a skeleton that is not above");
  EXPECT_THAT(odditiesOf(nodes + R"({"joints": [0, 1], "skeleton": 0}]})"), testing::IsEmpty());
  expectOdd(R"({"nodes": [{}], "skins": [{"joints": [0], "inverseBindMatrices": 0}], "accessors":
                [{"bufferView": 0}], "bufferViews": [{"byteStride": 64, "byteLength": 64}]})",
            "/skins/0/inverseBindMatrices: matrices in a buffer view with a byteStride");
}

TEST(Oddities, Variants_NamePlaceAndRule) {
  const auto withMappings = [](const std::string& mappings) {
    return R"({"extensionsUsed": ["KHR_materials_variants"], "extensions": {"KHR_materials_variants":
               {"variants": [{"name": "a"}]}}, "materials": [{}], "meshes": [{"primitives": [{"attributes": {},
               "extensions": {"KHR_materials_variants": {"mappings": [)" +
           mappings + "]}}}]}]}";
  };
  const std::string place = "/meshes/0/primitives/0/extensions/KHR_materials_variants/mappings/";
  expectOdd(withMappings(R"({"material": 1, "variants": [0]})"),
            place + "0/material: a variant with a material");
  expectOdd(withMappings(R"({"material": 0, "variants": [1]})"),
            place + "0/variants/0: a variant that the file");
  expectOdd(withMappings(R"({"material": 0, "variants": [0]}, {"material": 0, "variants": [0]})"),
            place + "1/variants/0: a variant that has a material already");
  expectOdd(R"({"extensionsUsed": ["KHR_materials_variants"], "extensions": {"KHR_materials_variants": {}}})",
            "/extensions/KHR_materials_variants: an extension without its variants");
}

/// Warnings about the triangle after `add` has added to it.
Warnings oddValuesOf(const std::function<void(GltfDocument&)>& add) {
  GltfDocument document = test::triangleDocument();
  document.json["accessors"][0]["min"] = {0, 0, 0};
  document.json["accessors"][0]["max"] = {1, 1, 0};
  add(document);
  const test::TemporaryFolder folder;
  writeGlb(folder / "a.glb", document);
  Warnings warnings;
  (void)readGltf(folder / "a.glb", warnings, {.tellOddities = true});
  return warnings;
}

void addAttribute(GltfDocument& document, const std::string& name, const std::vector<float>& values,
                  const std::string& type) {
  document.json["meshes"][0]["primitives"][0]["attributes"][name] =
      test::appendFloats(document, values, type);
}

TEST(Oddities, NumbersOfVertices_AreTold) {
  const std::string place = "/meshes/0/primitives/0/attributes/";
  const auto expectTold = [](const std::function<void(GltfDocument&)>& add, const std::string& text) {
    EXPECT_THAT(oddValuesOf(add), testing::ElementsAre(testing::HasSubstr(text)));
  };
  expectTold(
      [](GltfDocument& d) {
        addAttribute(d, "COLOR_0", {0, 1, 0.5f, 1.5f, 0, 0, 0, 0, 0}, "VEC3");
      },
      place + "COLOR_0: colours outside of 0..1");
  expectTold(
      [](GltfDocument& d) {
        addAttribute(d, "NORMAL", {1, 1, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
      },
      place + "NORMAL: vectors that are not of length 1");
  expectTold(
      [](GltfDocument& d) {
        addAttribute(d, "TANGENT", {1, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 1}, "VEC4");
      },
      place + "TANGENT: tangents whose w");
  expectTold(
      [](GltfDocument& d) {
        const std::vector<float> ones(16, 1.0f);
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(ones.data());
        const int matrices = test::appendBytes(d, {bytes, bytes + 64}, "MAT4", 1, 5126);
        d.json["skins"] = {{{"joints", {0}}, {"inverseBindMatrices", matrices}}};
      },
      "/skins/0/inverseBindMatrices: a matrix whose last row");
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

/// Files are recognised by their first bytes, whatever their names.
TEST(ReadGltf, WhatIsNoModel_IsNamed) {
  const std::vector<std::pair<std::string, std::string>> files = {
      {"\x89PNG\r\n\x1A\n", "a PNG picture"},
      {"\xFF\xD8\xFF\xE0", "a JPEG picture"},
      {"v/1\x01\x02", "an OpenEXR picture"},
      {"#?RADIANCE\n", "a Radiance picture"},
      {"<!DOCTYPE html><html>", "a web page"},
      {"version https://git-lfs.github.com/spec/v1\n", "Git LFS"},
      {"\x1F\x8B\x08", "packed by gzip"},
      {"PK\x03\x04", "a zip archive"},
      {"\xFF\xFE{", "UTF-16"}};
  for (const auto& [bytes, name] : files)
    for (const char* file : {"scene.gltf", "scene.obj", "unnamed"})
      EXPECT_THAT(errorOf(file, bytes + "rest"),
                  testing::AllOf(testing::HasSubstr(name), testing::HasSubstr("expected glTF 2.0")))
          << file;
  EXPECT_THAT(errorOf("set.usdz", "PK\x03\x04"), testing::HasSubstr("USD"));
}

}  // namespace
}  // namespace prelight
