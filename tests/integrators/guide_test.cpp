#include <gtest/gtest.h>

#include <cmath>

#include "support/devices.h"
#include "support/shot.h"

// Guides of a denoiser.
namespace prelight::test {
namespace {

Guides guidesOf(Shot shot) {
  shot.request.guides = true;
  reference::Film film(shot.request.width, shot.request.height);
  Progress progress;
  reference::ReferenceReport report;
  reference::renderReference(shot.inputs(), shot.request, sharedDevice(), progress, film, report);
  return report.guides;
}

void expectEverywhere(const Guides& guides, const glm::vec3& albedo, const glm::vec3& normal, float within) {
  ASSERT_FALSE(guides.albedo.empty());
  ASSERT_EQ(guides.albedo.size(), guides.normal.size());
  for (std::size_t i = 0; i < guides.albedo.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(guides.albedo[i][c], albedo[c], within) << i << " " << c;
      EXPECT_NEAR(guides.normal[i][c], normal[c], within) << i << " " << c;
    }
}

/// A floor of albedo 0.75 seen from above, half a metre wide.
Shot floorFromAbove() {
  return shotOf(ground(1, 1.0f), orthographicCamera({0, 1, 0}, {0, 0, 0}, 0.25), 4, 16);
}

/// A slab of another material, 0.2 m thick, between the camera and that floor.
Shot floorUnder(const CompiledMaterial& material) {
  Shot shot = floorFromAbove();
  append(shot.scene, box(1, {-0.9f, 0.4f, -0.9f}, {0.9f, 0.6f, 0.9f}, false));
  shot.scene.materials.push_back(material);
  for (std::size_t t = 2; t < shot.scene.triangleMaterials.size(); ++t)
    shot.scene.triangleMaterials[t] = static_cast<std::uint32_t>(shot.scene.materials.size() - 1);
  shot.scene.materials[0] = lambert(0.75f);
  return shot;
}

TEST(Guides, OfAFloor_AreItsAlbedoAndNormal) {
  Shot shot = floorFromAbove();
  shot.scene.materials[0] = lambert(0.75f);
  expectEverywhere(guidesOf(shot), glm::vec3(0.75f), {0, 1, 0}, 1e-6f);
}

TEST(Guides, OfLamps_KnowThatTheyShine) {
  Shot shot = floorFromAbove();
  shot.scene.materials[0] = emitter({0.25f, 9.0f, 0.0f});
  const Guides guides = guidesOf(shot);
  EXPECT_EQ(guides.albedo[5].y, 1.0f);
  EXPECT_LT(guides.albedo[5].z, guides.albedo[5].x);
}

TEST(Guides, BehindGlass_AreOfWhatIsSeenThroughIt) {
  // Glass of index 1 reflects nothing.
  expectEverywhere(guidesOf(floorUnder(glass(1.0f, true))), glm::vec3(0.75f), {0, 1, 0}, 1e-5f);
}

TEST(Guides, OfClearGlass_AreAlsoOfWhatItReflects) {
  const Guides guides = guidesOf(floorUnder(glass(1.5f, true)));
  for (const glm::vec3& albedo : guides.albedo) {
    EXPECT_GT(albedo.x, 0.4f);
    EXPECT_LT(albedo.x, 0.75f + 1e-5f);
  }
}

TEST(Guides, InMirrors_AreOfWhatTheyShow) {
  // The mirror's top face shows the space above the camera, which is empty.
  expectEverywhere(guidesOf(floorUnder(metal(1.0f, 0.0f))), glm::vec3(0.0f), glm::vec3(0.0f), 1e-6f);
}

TEST(Guides, OfRoughMetal_AreItsOwn) {
  const Guides guides = guidesOf(floorUnder(metal(0.8f, 0.5f)));
  for (std::size_t i = 0; i < guides.albedo.size(); ++i) {
    EXPECT_NEAR(guides.albedo[i].x, 0.8f, 0.05f);
    EXPECT_NEAR(guides.normal[i].y, 1.0f, 1e-6f);
  }
}

TEST(Guides, ByChanceOrOfFewSamples_AreNoisy) {
  Shot shot = floorFromAbove();
  shot.scene.materials[0] = lambert(0.75f);
  EXPECT_FALSE(guidesOf(shot).noisy);
  shot.request.samples = shot.request.samplesPerPass = 2;
  EXPECT_TRUE(guidesOf(shot).noisy);
  EXPECT_TRUE(guidesOf(floorUnder(glass(1.5f, true))).noisy);
  EXPECT_FALSE(guidesOf(floorUnder(metal(0.8f, 0.5f))).noisy);
}

TEST(Guides, ThatNobodyAskedFor_AreNotMade) {
  Shot shot = floorFromAbove();
  reference::Film film(shot.request.width, shot.request.height);
  Progress progress;
  reference::ReferenceReport report;
  reference::renderReference(shot.inputs(), shot.request, sharedDevice(), progress, film, report);
  EXPECT_TRUE(report.guides.albedo.empty());
}

}  // namespace
}  // namespace prelight::test
