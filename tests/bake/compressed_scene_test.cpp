// A compressed scene bakes to the same result as the uncompressed one.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>

#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "support/compressed_files.h"
#include "support/gltf_files.h"
#include "support/run_bake.h"

namespace prelight {
namespace {

/// Ambient occlusion of every vertex.
std::vector<float> occlusionOf(const CompiledScene& scene) {
  BakeRequest request;
  request.ao = true;
  request.effort.rays = 1024;
  return test::runBake(scene, request).bake.ao;
}

CompiledScene compiled(const GltfDocument& document) {
  Warnings warnings;
  return test::recompile(document, warnings);
}

TEST(CompressedScene, MeshoptThatKeepsCorners_BakesToTheSameBits) {
  const GltfDocument plain = makeBuiltinScene("cornell");
  const GltfDocument compressed = test::withMeshopt(plain, "EXT_meshopt_compression", "INDICES");
  EXPECT_EQ(occlusionOf(compiled(compressed)), occlusionOf(compiled(plain)));
}

TEST(CompressedScene, DracoInOrderWithoutQuantisation_BakesToTheSameBits) {
  const GltfDocument plain = makeBuiltinScene("cornell");
  EXPECT_EQ(occlusionOf(compiled(test::withDraco(plain, {false, 0, 0}))), occlusionOf(compiled(plain)));
}

/// Edgebreaker reorders vertices and triangles, which changes the rays that each vertex gets.
TEST(CompressedScene, DracoQuantised_BakesToTheSameWithinNoise) {
  const GltfDocument plain = makeBuiltinScene("shapes");
  const CompiledScene source = compiled(plain);
  const CompiledScene decoded = compiled(test::withDraco(plain, {true, 14, 12}));
  ASSERT_EQ(decoded.positions.size(), source.positions.size());
  const std::vector<float> expected = occlusionOf(source);
  const std::vector<float> got = occlusionOf(decoded);
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    std::size_t best = 0;
    float least = INFINITY;
    for (std::size_t j = 0; j < expected.size(); ++j) {
      const float distance = glm::length(decoded.positions[i] - source.positions[j]) +
                             0.1f * glm::length(decoded.normals[i] - source.normals[j]);
      if (distance < least) best = j;
      least = std::min(least, distance);
    }
    const double difference = double(got[i]) - double(expected[best]);
    sum += difference;
    squares += difference * difference;
  }
  const auto count = static_cast<double>(got.size());
  EXPECT_LT(std::abs(sum / count), 0.001);
  EXPECT_LT(std::sqrt(squares / count), 0.01);
}

}  // namespace
}  // namespace prelight
