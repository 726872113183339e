#include "viewer/scene/triangle_blocks.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

namespace prelight::viewer {
namespace {

constexpr std::uint32_t blockSize = TriangleBlocks::trianglesOfABlock;

/// Small triangles around a centre, as many as fill a block.
void addBlock(CompiledScene& scene, const glm::vec3& center, float radius, std::mt19937& random,
              std::uint32_t count = blockSize) {
  std::uniform_real_distribution<float> place(-radius, radius);
  for (std::uint32_t t = 0; t < count; ++t) {
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (int k = 0; k < 3; ++k)
      scene.positions.push_back(center + glm::vec3(place(random), place(random), place(random)));
    scene.triangles.emplace_back(first, first + 1, first + 2);
  }
}

std::vector<bool> drawn(const ShownTriangles& shown, const TriangleRange& range, std::size_t all) {
  std::vector<bool> triangles(all, false);
  std::uint32_t last = range.first;
  shown.forEach(range, [&](const TriangleRange& part) {
    EXPECT_GE(part.first, last);
    EXPECT_GT(part.count, 0u);
    last = part.first + part.count;
    EXPECT_LE(last, range.first + range.count);
    for (std::uint32_t t = part.first; t < last; ++t) triangles[t] = true;
  });
  return triangles;
}

TEST(ShownTriangles, BlocksBesideTheView_AreLeftOut) {
  std::mt19937 random(1);
  CompiledScene scene;
  const std::array<glm::vec3, 5> centers = {
      {{0, 0, -5}, {20, 0, -5}, {0, 1, -6}, {0, 0, 5}, {0, -20, -5}}};  // seen, beside, seen, behind, below
  for (const glm::vec3& center : centers) addBlock(scene, center, 0.5f, random);
  const glm::mat4 clip = glm::perspective(1.0f, 1.0f, 0.1f, 100.0f);
  const ShownTriangles shown(TriangleBlocks(scene), clip);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ranges;
  shown.forEach({10, 5 * blockSize - 20},
                [&](const TriangleRange& part) { ranges.emplace_back(part.first, part.count); });
  const std::vector<std::pair<std::uint32_t, std::uint32_t>> expected = {{10, blockSize - 10},
                                                                         {2 * blockSize, blockSize}};
  EXPECT_EQ(ranges, expected);
}

TEST(ShownTriangles, WholeSceneInView_IsOneRange) {
  std::mt19937 random(2);
  CompiledScene scene;
  for (int i = 0; i < 4; ++i) addBlock(scene, glm::vec3(0.0f), 1.0f, random);
  addBlock(scene, glm::vec3(0.0f), 1.0f, random, 7);
  const glm::mat4 clip = glm::ortho(-2.0f, 2.0f, -2.0f, 2.0f, -2.0f, 2.0f);
  int ranges = 0;
  ShownTriangles(TriangleBlocks(scene), clip).forEach({0, scene.triangleCount()}, [&](auto part) {
    EXPECT_EQ(part.count, scene.triangleCount());
    ++ranges;
  });
  EXPECT_EQ(ranges, 1);
}

class RandomViews : public testing::TestWithParam<bool> {};

TEST_P(RandomViews, WhatReachesIntoThePicture_IsDrawn) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-10.0f, 10.0f), weight(0.0f, 1.0f);
  CompiledScene scene;
  const auto point = [&] { return glm::vec3(place(random), place(random), place(random)); };
  for (int i = 0; i < 40; ++i) addBlock(scene, point(), 0.3f + weight(random), random);
  const TriangleBlocks blocks(scene);
  std::size_t left = 0;
  for (int view = 0; view < 50; ++view) {
    const glm::mat4 projection = GetParam()
                                     ? glm::perspective(0.2f + 2.0f * weight(random), 1.5f, 0.01f, 3.0f)
                                     : glm::ortho(-3.0f, 3.0f, -2.0f, 2.0f, 0.1f, 3.0f);
    const glm::mat4 clip = projection * glm::lookAt(point(), point(), glm::vec3(0, 1, 0));
    const std::vector<bool> shown =
        drawn(ShownTriangles(blocks, clip), {0, scene.triangleCount()}, scene.triangles.size());
    for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
      const glm::uvec3 corners = scene.triangles[t];
      for (int k = 0; k < 3 && !shown[t]; ++k) {
        const glm::vec4 seen = clip * glm::vec4(scene.positions[corners[k]], 1.0f);
        EXPECT_FALSE(std::abs(seen.x) <= seen.w && std::abs(seen.y) <= seen.w) << t;
      }
      left += shown[t] ? 0 : 1;
    }
  }
  EXPECT_GT(left, scene.triangles.size() * 20);
}

INSTANTIATE_TEST_SUITE_P(Projections, RandomViews, testing::Bool(), [](const auto& info) {
  return info.param ? std::string("Perspective") : std::string("Orthographic");
});

}  // namespace
}  // namespace prelight::viewer
