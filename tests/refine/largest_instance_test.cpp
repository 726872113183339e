#include "refine/largest_instance.h"

#include <gtest/gtest.h>

#include "scene/gltf/load/loader.h"
#include "support/bent_bar.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

std::optional<glm::dmat3> largestOf(const GltfDocument& document) {
  Warnings warnings;
  Scene scene = loadScene(document, warnings);
  const CompiledScene compiled = compileScene(scene, warnings);
  return largestInstance(scene, compiled, 0);
}

TEST(LargestInstance, MeshOfTwoNodes_IsThatOfTheLargerOne) {
  GltfDocument document = test::triangleDocument();
  document.json["nodes"] = {{{"mesh", 0}, {"scale", {0.1, 0.1, 0.1}}},
                            {{"mesh", 0}, {"scale", {2.0, 10.0, 2.0}}}};
  document.json["scenes"][0]["nodes"] = {0, 1};
  const auto largest = largestOf(document);
  ASSERT_TRUE(largest);
  EXPECT_NEAR(glm::length((*largest)[0]), 2.0, 1e-6);
  EXPECT_NEAR(glm::length((*largest)[1]), 10.0, 1e-6);
}

TEST(LargestInstance, Skin_HasTheScaleOfItsJoints) {
  GltfDocument document = test::bentBar();
  document.json["nodes"][0]["scale"] = {0.01, 0.01, 0.01};
  const auto largest = largestOf(document);
  ASSERT_TRUE(largest);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(glm::length((*largest)[c]), 0.01, 1e-6);
}

TEST(LargestInstance, MeshThatNothingDraws_HasNone) {
  GltfDocument document = test::triangleDocument();
  document.json["nodes"][0].erase("mesh");
  EXPECT_FALSE(largestOf(document));
}

}  // namespace
}  // namespace prelight
