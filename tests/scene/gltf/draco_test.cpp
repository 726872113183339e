// Scenes that the test compresses with libdraco, compared with the uncompressed ones.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/glm.hpp>

#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "support/compressed_files.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

/// Largest differences over all vertices from the nearest vertex of the other primitive.
struct Difference {
  float position = 0.0f;
  float normal = 0.0f;
  float texCoord = 0.0f;
};

/// Index of the vertex of `primitive` that is nearest in position and normal.
std::size_t nearest(const Primitive& primitive, const glm::vec3& position, const glm::vec3& normal) {
  std::size_t best = 0;
  float least = INFINITY;
  for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
    const float distance =
        glm::length(primitive.positions[i] - position) +
        (primitive.normals.empty() ? 0.0f : 0.1f * glm::length(primitive.normals[i] - normal));
    if (distance < least) best = i;
    least = std::min(least, distance);
  }
  return best;
}

Difference differenceOf(const Primitive& decoded, const Primitive& plain) {
  Difference difference;
  for (std::size_t i = 0; i < decoded.positions.size(); ++i) {
    const glm::vec3 normal = decoded.normals.empty() ? glm::vec3(0.0f) : decoded.normals[i];
    const std::size_t j = nearest(plain, decoded.positions[i], normal);
    difference.position =
        std::max(difference.position, glm::length(decoded.positions[i] - plain.positions[j]));
    if (!plain.normals.empty())
      difference.normal = std::max(difference.normal, glm::length(normal - plain.normals[j]));
    if (!plain.texCoords0.empty())
      difference.texCoord =
          std::max(difference.texCoord, glm::length(decoded.texCoords0[i] - plain.texCoords0[j]));
  }
  return difference;
}

double areaOf(const Primitive& primitive) {
  double area = 0.0;
  for (const glm::uvec3& t : primitive.triangles)
    area += 0.5 * glm::length(glm::cross(glm::dvec3(primitive.positions[t.y] - primitive.positions[t.x]),
                                         glm::dvec3(primitive.positions[t.z] - primitive.positions[t.x])));
  return area;
}

class Draco : public testing::TestWithParam<bool> {};

TEST_P(Draco, Builtin_DiffersByQuantisationAlone) {
  const GltfDocument plain = makeBuiltinScene("shapes");
  Warnings warnings;
  const Scene expected = loadScene(plain, warnings);
  const test::DracoEncoding encoding{GetParam(), 14, 12};
  const Scene scene = test::reload(test::withDraco(plain, encoding), warnings);
  EXPECT_THAT(warnings, testing::IsEmpty());
  ASSERT_EQ(scene.meshes.size(), expected.meshes.size());
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    for (std::size_t p = 0; p < scene.meshes[m].primitives.size(); ++p) {
      const Primitive& decoded = scene.meshes[m].primitives[p];
      const Primitive& source = expected.meshes[m].primitives[p];
      ASSERT_EQ(decoded.triangles.size(), source.triangles.size()) << m;
      glm::vec3 low(INFINITY), high(-INFINITY);
      for (const glm::vec3& position : source.positions) {
        low = glm::min(low, position);
        high = glm::max(high, position);
      }
      const glm::vec3 extent = high - low;
      // Half a step of the grid along each axis.
      const float step = std::max({extent.x, extent.y, extent.z}) / float((1 << encoding.positionBits) - 1);
      const Difference difference = differenceOf(decoded, source);
      EXPECT_LE(difference.position, 0.5f * std::sqrt(3.0f) * step * 1.01f + 1e-6f) << m;
      // Half a step h along both axes of the unfolded octahedron moves its point by sqrt(6) h. The point is
      // at least 1 / sqrt(3) from the centre.
      const float half = 1.0f / float((1 << encoding.normalBits) - 1);
      EXPECT_LE(difference.normal, std::sqrt(18.0f) * half * 1.01f) << m;
      EXPECT_NEAR(areaOf(decoded), areaOf(source), 1e-3 * areaOf(source)) << m;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, Draco, testing::Bool(),
                         [](const auto& method) { return method.param ? "Edgebreaker" : "Sequential"; });

TEST(DracoFile, WithoutQuantisationAndInOrder_IsTheSameToTheLastBit) {
  const GltfDocument plain = makeBuiltinScene("cornell");
  Warnings warnings;
  const Scene expected = loadScene(plain, warnings);
  const Scene scene = test::reload(test::withDraco(plain, {false, 0, 0}), warnings);
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    EXPECT_EQ(scene.meshes[m].primitives[0].positions, expected.meshes[m].primitives[0].positions);
    EXPECT_EQ(scene.meshes[m].primitives[0].normals, expected.meshes[m].primitives[0].normals);
    EXPECT_EQ(scene.meshes[m].primitives[0].triangles, expected.meshes[m].primitives[0].triangles);
  }
}

TEST(DracoFile, Written_HasPlainAccessorsAndNoExtension) {
  const test::TemporaryFolder folder;
  const GltfDocument plain = makeBuiltinScene("shapes");
  writeGlb(folder / "draco.glb", test::withDraco(plain, {}));
  Warnings warnings;
  const GltfDocument document = readGltf(folder / "draco.glb", warnings);
  const std::string json = document.json.dump();
  EXPECT_EQ(json.find("draco"), std::string::npos);
  EXPECT_FALSE(document.json.contains("extensionsRequired"));
  // Every part keeps its index, every view lies in the buffer, and the compressed bytes are gone.
  EXPECT_EQ(document.json["accessors"].size(), plain.json["accessors"].size());
  for (const Json& view : document.json["bufferViews"])
    EXPECT_LE(view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>(),
              document.bin.size());
  writeGlb(folder / "written.glb", document);
  Warnings again;
  const Scene written = loadScene(readGltf(folder / "written.glb", again), again);
  const Scene read = loadScene(document, warnings);
  EXPECT_THAT(again, testing::IsEmpty());
  EXPECT_EQ(written.meshes[0].primitives[0].positions, read.meshes[0].primitives[0].positions);
}

/// With KHR_mesh_quantization the node scales 16-bit positions.
TEST(DracoFile, QuantisedPositions_AreScaledByTheNode) {
  GltfDocument document = test::triangleDocument();
  const std::vector<std::uint16_t> positions = {0, 0, 0, 0, 16383, 0, 0, 0, 0, 16383, 0, 0};
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(positions.data());
  const int accessor =
      test::appendBytes(document, std::vector<std::uint8_t>(bytes, bytes + 24), "VEC3", 3, 5123);
  const auto view = document.json["accessors"][accessor]["bufferView"].get<std::size_t>();
  document.json["bufferViews"][view]["byteStride"] = 8;
  document.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = accessor;
  document.json["nodes"][0]["scale"] = {1.0 / 16383.0, 1.0 / 16383.0, 1.0 / 16383.0};
  document.json["extensionsUsed"] = {"KHR_mesh_quantization"};
  document.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  for (const bool edgebreaker : {false, true}) {
    Warnings warnings;
    const CompiledScene scene = test::recompile(test::withDraco(document, {edgebreaker, 0, 10}), warnings);
    EXPECT_THAT(warnings, testing::IsEmpty());
    ASSERT_EQ(scene.positions.size(), 3u);
    const glm::vec3 a = scene.positions[0], b = scene.positions[1], c = scene.positions[2];
    EXPECT_NEAR(glm::length(glm::cross(b - a, c - a)), 1.0f, 1e-6f);
  }
}

/// A triangle with Draco data besides uncompressed data, and the extension not required.
GltfDocument triangleWithBoth() {
  GltfDocument document = test::triangleDocument();
  const GltfDocument compressed = test::withDraco(document, {true, 4, 4});
  document.bin.assign(compressed.bin.begin(), compressed.bin.end());
  const GltfDocument plain = test::triangleDocument();
  std::copy(plain.bin.begin(), plain.bin.end(), document.bin.begin());
  document.json["bufferViews"] = compressed.json["bufferViews"];
  document.json["buffers"] = compressed.json["buffers"];
  document.json["meshes"][0]["primitives"][0]["extensions"] =
      compressed.json["meshes"][0]["primitives"][0]["extensions"];
  document.json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
  return document;
}

TEST(DracoFile, WithUncompressedDataBeside_KeepsThose) {
  Warnings warnings;
  const Scene scene = test::reload(triangleWithBoth(), warnings);
  const Scene expected = test::reload(test::triangleDocument(), warnings);
  EXPECT_EQ(scene.meshes[0].primitives[0].positions, expected.meshes[0].primitives[0].positions);
  EXPECT_THAT(warnings, testing::IsEmpty());
}

TEST(DracoFile, SharedByPrimitives_IsDecodedOnce) {
  GltfDocument document = test::withDraco(test::triangleDocument(), {});
  auto& primitives = document.json["meshes"][0]["primitives"];
  primitives.push_back(Json(primitives[0]));
  const test::TemporaryFolder folder;
  writeGlb(folder / "a.glb", document);
  Warnings warnings;
  const GltfDocument read = readGltf(folder / "a.glb", warnings);
  EXPECT_EQ(read.json["meshes"][0]["primitives"][0], read.json["meshes"][0]["primitives"][1]);
  EXPECT_EQ(read.json["accessors"].size(), 3u);
}

TEST(DracoFile, AccessorOfAnotherMesh_IsCopied) {
  GltfDocument document = test::withDraco(test::triangleDocument(), {});
  auto& primitives = document.json["meshes"][0]["primitives"];
  primitives.push_back(Json(primitives[0]));
  const GltfDocument other = makeBuiltinScene("cornell");
  GltfDocument quad = test::withDraco(other, {});
  const auto& source = quad.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
  const Json& view = quad.json["bufferViews"][source["bufferView"].get<std::size_t>()];
  const auto begin = quad.bin.begin() + view["byteOffset"].get<std::ptrdiff_t>();
  const std::vector<std::uint8_t> bytes(begin, begin + view["byteLength"].get<std::ptrdiff_t>());
  const std::size_t offset = (document.bin.size() + 3) / 4 * 4;
  document.bin.resize(offset);
  document.bin.insert(document.bin.end(), bytes.begin(), bytes.end());
  document.json["buffers"][0]["byteLength"] = document.bin.size();
  document.json["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}});
  primitives[1]["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", document.json["bufferViews"].size() - 1}, {"attributes", source["attributes"]}};
  Warnings warnings;
  const Scene scene = test::reload(document, warnings);
  EXPECT_EQ(scene.meshes[0].primitives[0].positions.size(), 3u);
  EXPECT_EQ(scene.meshes[0].primitives[1].positions.size(), 1089u);
  EXPECT_TRUE(test::anyContains(warnings, "the Draco data hold 1089 elements, the file says 3"));
}

std::string errorOf(const GltfDocument& document) {
  return test::inputErrorOf([&] {
    Warnings warnings;
    (void)test::reload(document, warnings);
  });
}

// The file claims three of each, but the Draco data hold more positions than normals.
TEST(DracoFile, SharedWithAPrimitiveOfFewerNormals_IsRefused) {
  GltfDocument document = test::withDraco(makeBuiltinScene("cornell"), {});
  auto& primitives = document.json["meshes"][0]["primitives"];
  for (const auto& attribute : primitives[0]["attributes"].items())
    document.json["accessors"][attribute.value().get<std::size_t>()]["count"] = 3;
  const std::size_t offset = (document.bin.size() + 3) / 4 * 4, bytes = 36;
  document.bin.resize(offset + bytes);
  document.json["buffers"][0]["byteLength"] = document.bin.size();
  document.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes}});
  document.json["accessors"].push_back({{"bufferView", document.json["bufferViews"].size() - 1},
                                        {"componentType", 5126},
                                        {"count", 3},
                                        {"type", "VEC3"}});
  primitives.push_back({{"attributes",
                         {{"POSITION", primitives[0]["attributes"]["POSITION"]},
                          {"NORMAL", document.json["accessors"].size() - 1}}}});
  EXPECT_THAT(errorOf(document), testing::HasSubstr("/meshes/0/primitives/1/attributes/NORMAL"));
}

TEST(DracoFile, Broken_NamesPlaceAndWhatToDo) {
  const GltfDocument good = test::withDraco(test::triangleDocument(), {});
  const auto changed = [&](auto change) {
    GltfDocument document = good;
    change(document, document.json["meshes"][0]["primitives"][0]);
    return errorOf(document);
  };
  const std::string name = "KHR_draco_mesh_compression";
  const std::string place = "/meshes/0/primitives/0/extensions/" + name;
  EXPECT_THAT(changed([&](auto&, Json& p) { p["extensions"][name].erase("bufferView"); }),
              testing::HasSubstr(place));
  EXPECT_THAT(changed([&](auto&, Json& p) { p["extensions"][name]["bufferView"] = 99; }),
              testing::HasSubstr("out of range"));
  EXPECT_THAT(changed([&](auto&, Json& p) { p["extensions"][name]["attributes"]["POSITION"] = 77; }),
              testing::HasSubstr("the Draco data have no attribute 77"));
  EXPECT_THAT(changed([&](auto&, Json& p) { p["extensions"][name]["attributes"]["TANGENT"] = 0; }),
              testing::HasSubstr("no attribute of that name"));
  EXPECT_THAT(changed([&](auto&, Json& p) { p["mode"] = 1; }), testing::HasSubstr("expected 4 or 5"));
  EXPECT_THAT(changed([&](GltfDocument& d, Json&) { d.json["accessors"][0]["type"] = "VEC4"; }),
              testing::HasSubstr("POSITION"));
  EXPECT_THAT(changed([&](GltfDocument& d, Json& p) {
                const auto view = p["extensions"][name]["bufferView"].template get<std::size_t>();
                d.bin[d.json["bufferViews"][view]["byteOffset"].template get<std::size_t>()] = 'X';
              }),
              testing::AllOf(testing::HasSubstr("no data of Draco"), testing::HasSubstr("without Draco")));
}

}  // namespace
}  // namespace prelight
