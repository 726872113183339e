#include "benchmarks/scenes/compared_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "benchmarks/suites/techniques/compared_techniques.h"
#include "occluders/occluder_vectors.h"

namespace prelight::benchmarks {
namespace {

TEST(ComparedScenes, Crowd_HasTheThesisNumberOfVerticesAndLights) {
  const ComparedScene crowd = makeCrowd(25, 20);
  EXPECT_NEAR(crowd.scene.compiled.vertexCount(), 25000, 2500);
  EXPECT_NEAR(crowd.scene.compiled.triangleCount(), 52000, 5200);
  EXPECT_EQ(crowd.scene.compiled.lights.size(), 20u);
  EXPECT_EQ(makeCrowd(25, 20).document.bin, crowd.document.bin);
  // Transfer knows shadows only of lights with nothing behind them.
  for (const Light& light : crowd.scene.compiled.lights)
    EXPECT_GT(light.position.y - crowd.scene.compiled.origin.y, crowd.scene.compiled.boundsMax.y);
}

TEST(ComparedScenes, ShinyShapes_NeedSpecularVectorsAndShapesDoNot) {
  const auto mirrors = [](const ComparedScene& scene) {
    const std::vector<OccluderVector> needed = neededVectors(scene.scene.compiled);
    return std::find(needed.begin(), needed.end(), OccluderVector::SpecularNormal) != needed.end();
  };
  EXPECT_FALSE(mirrors(makeShapes()));
  EXPECT_TRUE(mirrors(makeShinyShapes()));
}

TEST(ComparedScenes, EveningSky_IsRadianceWithASun) {
  const Environment sky = makeEveningSky(64);
  ASSERT_EQ(sky.radiance.size(), 64u * 128u);
  float brightest = 0.0f;
  for (const glm::vec3& texel : sky.radiance) {
    EXPECT_GE(std::min({texel.r, texel.g, texel.b}), 0.0f);
    brightest = std::max(brightest, texel.g);
  }
  EXPECT_GT(brightest, 50.0f);
}

TEST(Techniques, SpecularOccluders_NeedSpecularVectors) {
  Bake bake;
  bake.occluders.emplace();
  bake.occluders->stored = {OccluderVector::Position, OccluderVector::Occlusion,
                            OccluderVector::DiffuseNormal, OccluderVector::DiffuseColor};
  int diffuse = 0, specular = 0;
  for (const Technique& technique : comparedTechniques(6, 32)) {
    if (technique.render.shading != viewer::Shading::Vo) continue;
    EXPECT_EQ(canShow(technique, bake), !showsMirrors(technique)) << technique.name;
    ++(showsMirrors(technique) ? specular : diffuse);
  }
  EXPECT_EQ(diffuse, 2);
  EXPECT_EQ(specular, 1);
}

TEST(Techniques, EveryShading_IsComparedSomewhere) {
  const std::vector<Technique> all = comparedTechniques(6, 32);
  for (const viewer::ShadingInfo& info : viewer::shadings())
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const Technique& technique) {
      return technique.render.shading == info.shading && technique.scenes != 0;
    })) << info.name();
}

TEST(Techniques, Orders_AreBounded) {
  for (const Technique& technique : comparedTechniques(3, 32)) {
    EXPECT_LE(technique.request.sh.order, 3) << technique.name;
    EXPECT_LE(technique.request.ch.order, 3) << technique.name;
    EXPECT_LE(technique.request.glossy.order, 3) << technique.name;
  }
  EXPECT_GT(comparedTechniques(6, 32).size(), comparedTechniques(3, 32).size());
}

}  // namespace
}  // namespace prelight::benchmarks
