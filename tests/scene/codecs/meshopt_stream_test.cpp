#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "scene/codecs/meshopt_stream.h"
#include "support/compressed_files.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A stream of zeros is as short as a stream can be.
TEST(LeastMeshoptBytes, IsBelowEveryStream) {
  for (const std::size_t stride : {4u, 16u, 252u, 256u}) {
    for (const std::size_t count : {1u, 16u, 257u, 5000u}) {
      const Bytes data(count * stride);
      const MeshoptLayout layout{MeshoptMode::Attributes, MeshoptFilter::None, count, stride};
      EXPECT_LE(leastMeshoptBytes(layout), test::meshoptAttributes(data.data(), count, stride).size());
    }
  }
  for (const std::size_t triangles : {1u, 100u, 4000u}) {
    std::vector<std::uint32_t> strip;
    for (std::uint32_t t = 0; t < triangles; ++t) strip.insert(strip.end(), {t, t + 1, t + 2});
    const MeshoptLayout layout{MeshoptMode::Triangles, MeshoptFilter::None, strip.size(), 4};
    EXPECT_LE(leastMeshoptBytes(layout), test::meshoptTriangles(strip).size());
    EXPECT_LE(leastMeshoptBytes({MeshoptMode::Indices, MeshoptFilter::None, strip.size(), 4}),
              test::meshoptSequence(strip).size());
  }
}

TEST(DecodeMeshopt, MoreThanTheStreamCanHold_IsRefusedBeforeMemoryIsTaken) {
  const Bytes stream(1000, 0xa0);
  const std::uint64_t many = std::uint64_t{1} << 40;
  for (const MeshoptMode mode : {MeshoptMode::Attributes, MeshoptMode::Triangles, MeshoptMode::Indices}) {
    const std::string error = test::inputErrorOf([&] {
      (void)decodeMeshopt(stream, {mode, MeshoptFilter::None, 3 * many, 4}, "a.glb: /bufferViews/0");
    });
    EXPECT_THAT(error,
                testing::AllOf(testing::HasSubstr("a.glb: /bufferViews/0"), testing::HasSubstr("at least")));
  }
}

/// Deterministic damage gives bytes or an InputError, nothing else; the sanitizer build detects other faults.
TEST(DecodeMeshopt, DamagedStreams_DecodeOrThrow) {
  std::mt19937 random(3);
  std::vector<std::uint32_t> indices;
  for (std::uint32_t t = 0; t < 200; ++t) indices.insert(indices.end(), {t, t + 1, (t * 7) % 150});
  Bytes vertices(16 * 150);
  for (auto& byte : vertices) byte = static_cast<std::uint8_t>(random() % 7);
  const std::vector<std::pair<Bytes, MeshoptLayout>> streams = {
      {test::meshoptAttributes(vertices.data(), 150, 16),
       {MeshoptMode::Attributes, MeshoptFilter::Exponential, 150, 16}},
      {test::meshoptAttributes(vertices.data(), 300, 8),
       {MeshoptMode::Attributes, MeshoptFilter::Quaternion, 300, 8}},
      {test::meshoptTriangles(indices), {MeshoptMode::Triangles, MeshoptFilter::None, indices.size(), 2}},
      {test::meshoptSequence(indices), {MeshoptMode::Indices, MeshoptFilter::None, indices.size(), 4}}};
  int decoded = 0, refused = 0;
  for (int i = 0; i < 4000; ++i) {
    auto [stream, layout] = streams[static_cast<std::size_t>(i) % streams.size()];
    for (auto flips = 1 + random() % 3; flips > 0; --flips)
      stream[random() % stream.size()] = static_cast<std::uint8_t>(random());
    if (random() % 8 == 0) stream.resize(1 + random() % stream.size());
    if (random() % 8 == 0) stream[0] = 0xa1;
    try {
      EXPECT_EQ(decodeMeshopt(stream, layout, "x").size(), layout.bytes());
      ++decoded;
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(decoded, 500);
  EXPECT_GT(refused, 500);
}

}  // namespace
}  // namespace prelight
