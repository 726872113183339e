#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "prelight/error.h"
#include "scene/builtin/builtin.h"
#include "scene/codecs/draco_mesh.h"
#include "support/compressed_files.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Draco data of the first primitive, compressed by the test.
Bytes dracoBytes(const GltfDocument& plain, const test::DracoEncoding& encoding) {
  const GltfDocument document = test::withDraco(plain, encoding);
  const auto& extension =
      document.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
  const auto& view = document.json["bufferViews"][extension["bufferView"].get<std::size_t>()];
  const auto begin = document.bin.begin() + view["byteOffset"].get<std::ptrdiff_t>();
  return {begin, begin + view["byteLength"].get<std::ptrdiff_t>()};
}

constexpr std::uint64_t plenty = std::uint64_t{1} << 26;

void appendVarint(Bytes& bytes, std::uint64_t number) {
  for (; number >= 128; number >>= 7) bytes.push_back(static_cast<std::uint8_t>(number | 128));
  bytes.push_back(static_cast<std::uint8_t>(number));
}

/// Header of a version 2.2 mesh that claims numbers of triangles and vertices, followed by zeros.
Bytes claim(bool edgebreaker, std::uint64_t triangles, std::uint64_t vertices) {
  Bytes bytes = {'D', 'R', 'A', 'C', 'O', 2, 2, 1, std::uint8_t(edgebreaker ? 1 : 0), 0, 0};
  if (edgebreaker) {
    bytes.push_back(0);  // The standard traversal.
    appendVarint(bytes, vertices);
    appendVarint(bytes, triangles);
    bytes.push_back(1);
    appendVarint(bytes, triangles);
    appendVarint(bytes, 0);
  } else {
    appendVarint(bytes, triangles);
    appendVarint(bytes, vertices);
    bytes.push_back(0);
  }
  bytes.resize(bytes.size() + 2000);
  return bytes;
}

/// A version 2.2 mesh of one triangle with one attribute of this data type (Draco's number) and the values 0,
/// 1 and 2, in sequential encoding without compression.
Bytes triangleWith(std::uint8_t dataType) {
  return {'D', 'R', 'A', 'C',      'O', 2, 2, 1, 0,
          0,   0,   1,   3,        1,   0, 1, 2,  // one triangle, three vertices, plain indices
          1,   1,   0,   dataType, 1,   0, 0,     // one decoder of one attribute: positions of one component,
                                                  // number 0
          0,   0,   1,   2};                      // stored plainly
}

/// A bool of 2 is undefined behaviour where it is read (found by fuzzing).
TEST(DracoMesh, AttributeOfBools_IsRefused) {
  constexpr std::uint8_t uint8 = 2, boolean = 11;
  constexpr std::uint64_t bytes = 5121;
  const DracoValues wanted{0, bytes, 1};
  EXPECT_EQ(decodeDraco(triangleWith(uint8), plenty, "a")->values(wanted, "a"), (Bytes{0, 1, 2}));
  const auto mesh = decodeDraco(triangleWith(boolean), plenty, "a");
  EXPECT_THAT(test::inputErrorOf([&] { (void)mesh->values(wanted, "a.glb: /meshes/0"); }),
              testing::HasSubstr("attribute 0 of the Draco data has values of type bool"));
}

TEST(DracoMesh, ClaimsOfBillions_AreRefusedBeforeMemoryIsTaken) {
  for (const bool edgebreaker : {false, true}) {
    const Bytes bytes = claim(edgebreaker, 1000000000, 1500000000);
    const std::string error =
        test::inputErrorOf([&] { const auto mesh = decodeDraco(bytes, plenty, "a.glb: /meshes/0"); });
    EXPECT_THAT(error, testing::AllOf(testing::HasSubstr("a.glb: /meshes/0: the Draco data claim a mesh of"),
                                      testing::HasSubstr("at most")));
  }
}

TEST(DracoMesh, MoreThanIsLeft_IsRefused) {
  const Bytes bytes = dracoBytes(makeBuiltinScene("shapes"), {});
  EXPECT_NO_THROW(const auto mesh = decodeDraco(bytes, plenty, "x"));
  EXPECT_THROW(const auto mesh = decodeDraco(bytes, 100, "x"), InputError);
}

TEST(DracoMesh, Points_AreRefused) {
  Bytes bytes = dracoBytes(test::triangleDocument(), {});
  bytes[7] = 0;
  EXPECT_THAT(test::inputErrorOf([&] { const auto mesh = decodeDraco(bytes, plenty, "x"); }),
              testing::HasSubstr("hold points"));
}

/// Deterministic damage gives a mesh or an InputError, nothing else, and takes no more memory than allowed.
TEST(DracoMesh, DamagedData_DecodeOrThrow) {
  std::mt19937 random(9);
  const std::vector<Bytes> sources = {dracoBytes(test::triangleDocument(), {}),
                                      dracoBytes(makeBuiltinScene("shapes"), {true, 10, 8}),
                                      dracoBytes(makeBuiltinScene("cornell"), {false, 11, 8})};
  int decoded = 0, refused = 0;
  for (int i = 0; i < 3000; ++i) {
    Bytes bytes = sources[static_cast<std::size_t>(i) % sources.size()];
    const std::size_t reach = random() % 2 == 0 ? std::min<std::size_t>(bytes.size(), 64) : bytes.size();
    for (auto flips = 1 + random() % 3; flips > 0; --flips)
      bytes[random() % reach] = static_cast<std::uint8_t>(random());
    if (random() % 8 == 0) bytes.resize(1 + random() % bytes.size());
    try {
      const auto mesh = decodeDraco(bytes, plenty, "x");
      for (const std::uint32_t vertex : mesh->indices()) ASSERT_LT(vertex, mesh->vertices()) << i;
      (void)mesh->values({0, 5126, 3}, "x");
      ++decoded;
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(decoded, 100);
  EXPECT_GT(refused, 500);
}

}  // namespace
}  // namespace prelight
