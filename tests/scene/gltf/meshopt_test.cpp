// Buffer views that the test compresses with libmeshoptimizer, compared with the original data.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <cmath>
#include <cstring>

#include "scene/builtin/builtin.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/load/loader.h"
#include "support/compressed_files.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

class MeshoptName : public testing::TestWithParam<const char*> {};

TEST_P(MeshoptName, Builtin_IsTheSameToTheLastBit) {
  const GltfDocument plain = makeBuiltinScene("shapes");
  Warnings warnings;
  const Scene expected = loadScene(plain, warnings);
  const Scene scene = test::reload(test::withMeshopt(plain, GetParam()), warnings);
  EXPECT_THAT(warnings, testing::IsEmpty());
  ASSERT_EQ(scene.meshes.size(), expected.meshes.size());
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const Primitive& decoded = scene.meshes[m].primitives[0];
    const Primitive& source = expected.meshes[m].primitives[0];
    EXPECT_EQ(decoded.positions, source.positions) << m;
    EXPECT_EQ(decoded.normals, source.normals) << m;
    ASSERT_EQ(decoded.triangles.size(), source.triangles.size()) << m;
    // The codec may start a triangle at another corner.
    for (std::size_t t = 0; t < source.triangles.size(); ++t) {
      const glm::uvec3 a = source.triangles[t], b = decoded.triangles[t];
      EXPECT_TRUE(a == b || a == glm::uvec3(b.y, b.z, b.x) || a == glm::uvec3(b.z, b.x, b.y))
          << m << " " << t;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Names, MeshoptName,
                         testing::Values("EXT_meshopt_compression", "KHR_meshopt_compression"),
                         [](const auto& name) { return std::string(name.param).substr(0, 3); });

TEST(Meshopt, Written_HasPlainViewsAndNoExtension) {
  const test::TemporaryFolder folder;
  const GltfDocument plain = makeBuiltinScene("cornell");
  writeGlb(folder / "meshopt.glb", test::withMeshopt(plain));
  Warnings warnings;
  const GltfDocument document = readGltf(folder / "meshopt.glb", warnings);
  EXPECT_EQ(document.json.dump().find("meshopt"), std::string::npos);
  EXPECT_EQ(document.json["buffers"].size(), 1u);
  // Neither the compressed nor the fallback bytes are left, but only the bytes that views show, aligned.
  EXPECT_LE(document.bin.size(), plain.bin.size() + 16 * plain.json["bufferViews"].size());
  EXPECT_EQ(document.json["bufferViews"].size(), plain.json["bufferViews"].size());
}

TEST(Meshopt, FallbackBufferThatIsMissing_IsNotRead) {
  GltfDocument document = test::withMeshopt(test::triangleDocument());
  document.json["buffers"][1]["uri"] = "not-there.bin";
  Warnings warnings;
  EXPECT_EQ(test::reload(document, warnings).meshes[0].primitives[0].positions.size(), 3u);
  EXPECT_THAT(warnings, testing::IsEmpty());
}

/// Reader of an accessor whose view was compressed with `layout`, after a round trip through a file.
AccessorReader decodedAccessor(GltfDocument& read, GltfDocument document, std::size_t accessor,
                               const std::vector<std::uint8_t>& stream, const Json& layout) {
  const auto view = document.json["accessors"][accessor]["bufferView"].get<std::size_t>();
  test::compressView(document, view, stream, layout);
  const test::TemporaryFolder folder;
  writeGlb(folder / "a.glb", document);
  Warnings warnings;
  read = readGltf(folder / "a.glb", warnings);
  EXPECT_THAT(warnings, testing::IsEmpty());
  return AccessorReader(read, accessor);
}

/// A document whose last accessor has `count` elements of `bytes` bytes.
GltfDocument documentWith(const std::string& type, int componentType, bool normalized, std::size_t count,
                          std::size_t bytes, int& accessor) {
  GltfDocument document = test::triangleDocument();
  accessor =
      test::appendBytes(document, std::vector<std::uint8_t>(count * bytes), type, count, componentType);
  if (normalized) document.json["accessors"][accessor]["normalized"] = true;
  document.json["extensionsUsed"] = {"EXT_meshopt_compression"};
  document.json["extensionsRequired"] = {"EXT_meshopt_compression"};
  return document;
}

TEST(Meshopt, Octahedral_GivesUnitVectors) {
  constexpr std::size_t count = 40;
  std::vector<float> normals;
  for (std::size_t i = 0; i < count; ++i) {
    const float a = 0.7f * float(i), z = 1.0f - 2.0f * (float(i) + 0.5f) / float(count);
    const float r = std::sqrt(1.0f - z * z);
    normals.insert(normals.end(), {r * std::cos(a), r * std::sin(a), z, i % 2 == 0 ? 1.0f : -1.0f});
  }
  for (const std::size_t stride : {std::size_t{4}, std::size_t{8}}) {
    std::vector<std::uint8_t> filtered(count * stride);
    const int bits = stride == 4 ? 8 : 12;
    meshopt_encodeFilterOct(filtered.data(), count, stride, bits, normals.data());
    int accessor = 0;
    GltfDocument read;
    const GltfDocument document =
        documentWith("VEC4", stride == 4 ? 5120 : 5122, true, count, stride, accessor);
    const Json layout = {
        {"count", count}, {"byteStride", stride}, {"mode", "ATTRIBUTES"}, {"filter", "OCTAHEDRAL"}};
    const std::vector<float> values =
        decodedAccessor(read, document, accessor, test::meshoptAttributes(filtered.data(), count, stride),
                        layout)
            .floats();
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_NEAR(values[i], normals[i], stride == 4 ? 0.02f : 0.002f) << i;
  }
}

TEST(Meshopt, Quaternion_GivesTheRotationOrItsNegative) {
  constexpr std::size_t count = 25;
  std::vector<float> rotations;
  for (std::size_t i = 0; i < count; ++i) {
    const float a = 0.25f * float(i), b = 0.6f * float(i);
    rotations.insert(rotations.end(), {std::sin(a) * std::cos(b), std::sin(a) * std::sin(b) * 0.6f,
                                       std::sin(a) * std::sin(b) * 0.8f, std::cos(a)});
  }
  std::vector<std::uint8_t> filtered(count * 8);
  meshopt_encodeFilterQuat(filtered.data(), count, 8, 14, rotations.data());
  int accessor = 0;
  GltfDocument read;
  const GltfDocument document = documentWith("VEC4", 5122, true, count, 8, accessor);
  const Json layout = {{"count", count}, {"byteStride", 8}, {"mode", "ATTRIBUTES"}, {"filter", "QUATERNION"}};
  const std::vector<float> values =
      decodedAccessor(read, document, accessor, test::meshoptAttributes(filtered.data(), count, 8), layout)
          .floats();
  for (std::size_t i = 0; i < count; ++i) {
    float dot = 0.0f;
    for (std::size_t c = 0; c < 4; ++c) dot += values[4 * i + c] * rotations[4 * i + c];
    EXPECT_NEAR(std::abs(dot), 1.0f, 1e-3f) << i;
  }
}

/// The numbers as the EXPONENTIAL filter stores them, each with its own exponent.
std::vector<std::uint8_t> exponentials(const std::vector<float>& numbers) {
  std::vector<std::uint8_t> filtered(numbers.size() * 4);
#if MESHOPTIMIZER_VERSION < 190
  meshopt_encodeFilterExp(filtered.data(), numbers.size(), 4, 20, numbers.data());
#else
  meshopt_encodeFilterExp(filtered.data(), numbers.size(), 4, 20, numbers.data(), meshopt_EncodeExpSeparate);
#endif
  return filtered;
}

TEST(Meshopt, Exponential_GivesFloats) {
  const std::vector<float> numbers = {1.5f, -2.25f, 1e-3f, 4096.0f, -0.125f, 3.0f, 0.0f, 7e5f, 9.0f};
  const std::vector<std::uint8_t> filtered = exponentials(numbers);
  int accessor = 0;
  GltfDocument read;
  const GltfDocument document = documentWith("SCALAR", 5126, false, numbers.size(), 4, accessor);
  const Json layout = {
      {"count", numbers.size()}, {"byteStride", 4}, {"mode", "ATTRIBUTES"}, {"filter", "EXPONENTIAL"}};
  const std::vector<float> values =
      decodedAccessor(read, document, accessor, test::meshoptAttributes(filtered.data(), numbers.size(), 4),
                      layout)
          .floats();
  for (std::size_t i = 0; i < numbers.size(); ++i)
    EXPECT_NEAR(values[i], numbers[i], std::abs(numbers[i]) * 2e-6f) << i;
}

TEST(Meshopt, IndexSequence_GivesTheIndices) {
  const std::vector<std::uint32_t> indices = {0, 5, 2, 70000, 3, 3, 1, 0, 900};
  int accessor = 0;
  GltfDocument read;
  const GltfDocument document = documentWith("SCALAR", 5125, false, indices.size(), 4, accessor);
  const Json layout = {{"count", indices.size()}, {"byteStride", 4}, {"mode", "INDICES"}};
  EXPECT_EQ(
      decodedAccessor(read, document, accessor, test::meshoptSequence(indices), layout).unsignedIntegers(),
      indices);
}

/// The 16-bit positions of KHR_mesh_quantization have a stride of 8, as gltfpack writes them.
TEST(Meshopt, QuantisedPositions_AreScaledByTheNode) {
  GltfDocument document = test::triangleDocument();
  const std::vector<std::uint16_t> positions = {0, 0, 0, 0, 16383, 0, 0, 0, 0, 16383, 0, 0};
  const auto bytes = reinterpret_cast<const std::uint8_t*>(positions.data());
  const int accessor =
      test::appendBytes(document, std::vector<std::uint8_t>(bytes, bytes + 24), "VEC3", 3, 5123);
  const auto view = document.json["accessors"][accessor]["bufferView"].get<std::size_t>();
  document.json["bufferViews"][view]["byteStride"] = 8;
  document.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = accessor;
  document.json["nodes"][0]["scale"] = {1.0 / 16383.0, 1.0 / 16383.0, 1.0 / 16383.0};
  document.json["extensionsUsed"] = {"EXT_meshopt_compression", "KHR_mesh_quantization"};
  document.json["extensionsRequired"] = document.json["extensionsUsed"];
  test::compressView(document, view, test::meshoptAttributes(positions.data(), 3, 8),
                     {{"count", 3}, {"byteStride", 8}, {"mode", "ATTRIBUTES"}});
  Warnings warnings;
  const CompiledScene scene = test::recompile(document, warnings);
  EXPECT_THAT(warnings, testing::IsEmpty());
  ASSERT_EQ(scene.positions.size(), 3u);
  EXPECT_NEAR(glm::length(scene.positions[1] - scene.positions[0]), 1.0f, 1e-6f);
  EXPECT_NEAR(glm::length(scene.positions[2] - scene.positions[0]), 1.0f, 1e-6f);
}

std::string errorWith(const std::function<void(Json&, GltfDocument&)>& change) {
  GltfDocument document = test::withMeshopt(test::triangleDocument());
  change(document.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"], document);
  return test::inputErrorOf([&] {
    Warnings warnings;
    (void)test::reload(document, warnings);
  });
}

TEST(Meshopt, Broken_NamesPlaceAndRule) {
  const std::string place = "/bufferViews/0/extensions/EXT_meshopt_compression";
  const auto set = [](const char* key, const Json& value) {
    return errorWith([&](Json& extension, GltfDocument&) { extension[key] = value; });
  };
  EXPECT_THAT(set("mode", "LINES"),
              testing::HasSubstr(place + "/mode: expected one of ATTRIBUTES, TRIANGLES, INDICES"));
  EXPECT_THAT(set("filter", "BLUR"), testing::HasSubstr(place + "/filter"));
  EXPECT_THAT(set("buffer", 9), testing::HasSubstr("out of range"));
  EXPECT_THAT(set("byteStride", 10), testing::HasSubstr("a multiple of 4 in 4..256"));
  EXPECT_THAT(set("filter", "OCTAHEDRAL"), testing::HasSubstr("4 or 8 with this filter"));
  EXPECT_THAT(set("count", 0), testing::HasSubstr("positive"));
  EXPECT_THAT(set("count", 4), testing::HasSubstr("expected the 36 bytes"));
  EXPECT_THAT(set("byteOffset", 100000), testing::HasSubstr("do not lie in buffer 0"));
  EXPECT_THAT(errorWith([](Json& extension, GltfDocument& document) {
                document.bin[extension["byteOffset"].get<std::size_t>()] = 0xa7;
              }),
              testing::AllOf(testing::HasSubstr("header byte 0xa7"), testing::HasSubstr("without meshopt")));
}

TEST(Meshopt, BrokenButUnused_IsAWarning) {
  GltfDocument document = test::triangleDocument();
  const int accessor = test::appendBytes(document, std::vector<std::uint8_t>(12), "SCALAR", 3, 5126);
  const auto view = document.json["accessors"][accessor]["bufferView"].get<std::size_t>();
  document.json["extensionsUsed"] = {"EXT_meshopt_compression"};
  test::compressView(document, view, std::vector<std::uint8_t>(40, 0xFF),
                     {{"count", 3}, {"byteStride", 4}, {"mode", "ATTRIBUTES"}});
  Warnings warnings;
  EXPECT_EQ(test::reload(document, warnings).meshes[0].primitives[0].positions.size(), 3u);
  EXPECT_TRUE(test::anyContains(warnings, "nothing uses it"));
}

}  // namespace
}  // namespace prelight
