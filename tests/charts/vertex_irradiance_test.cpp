#include "charts/vertex_irradiance.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "charts/light_map_lookup.h"
#include "charts/make_light_map_layout.h"
#include "support/materials.h"
#include "support/scenes.h"

namespace prelight::test {
namespace {

/// A ground with a light map that is filled by a function of position.
struct MappedGround {
  CompiledScene scene = ground(8, 1.0f);
  LightMap map;

  template <typename Irradiance>
  explicit MappedGround(const Irradiance& irradiance) {
    scene.materials[0] = lambert(0.5f);
    LightMapLayoutRequest request;
    request.texels = 4096;
    map.layout = makeLightMapLayout({}, scene, request);
    map.values.assign(3 * map.layout.texelCount(), 0.0f);
    for (const LightMapTexel& texel : map.layout.texels) {
      const glm::uvec3& t = scene.triangles[texel.face];
      const glm::vec3 p = (1.0f - texel.b1 - texel.b2) * scene.positions[t.x] +
                          texel.b1 * scene.positions[t.y] + texel.b2 * scene.positions[t.z];
      for (std::size_t c = 0; c < 3; ++c)
        map.values[3 * texel.texel + c] = static_cast<float>(c + 1) * irradiance(p);
    }
  }

  std::vector<glm::vec3> fit() const { return irradianceOfVertices(scene, makeFitMesh(scene), map); }
};

TEST(VertexIrradiance, LinearMap_ComesOutAtEveryVertex) {
  const auto linear = [](const glm::vec3& p) { return 3.0f + p.x - 0.5f * p.z; };
  const MappedGround ground(linear);
  const std::vector<glm::vec3> found = ground.fit();
  ASSERT_EQ(found.size(), ground.scene.vertexCount());
  for (std::size_t v = 0; v < found.size(); ++v)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(found[v][c], float(c + 1) * linear(ground.scene.positions[v]), 0.02f * float(c + 1));
}

TEST(VertexIrradiance, DarkSpot_NeverTurnsNegative) {
  const MappedGround ground([](const glm::vec3& p) { return glm::length(p) < 0.3f ? 0.0f : 5.0f; });
  for (const glm::vec3& e : ground.fit()) EXPECT_GE(e.x, 0.0f);
}

TEST(VertexIrradiance, SurfaceWithoutChart_IsDark) {
  MappedGround ground([](const glm::vec3&) { return 1.0f; });
  std::fill(ground.map.layout.chartOf.begin(), ground.map.layout.chartOf.end(), LightMapLayout::noChart);
  for (const glm::vec3& e : ground.fit()) EXPECT_EQ(e, glm::vec3(0.0f));
}

}  // namespace
}  // namespace prelight::test
