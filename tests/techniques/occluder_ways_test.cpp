#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "occluders/occluder_record.h"
#include "support/run_bake.h"
#include "support/scenes.h"

namespace prelight {
namespace {

/// The record of a vertex for an occluder, accessed by names of vectors.
class RecordOf {
 public:
  RecordOf(const OccluderTransfer& transfer, std::uint32_t vertex, std::uint32_t occluder)
      : transfer_(transfer) {
    for (std::uint32_t r = transfer.offsets[vertex]; r < transfer.offsets[vertex + 1]; ++r)
      if (transfer.occluders[r] == occluder) record_ = r;
  }

  bool exists() const { return record_ < transfer_.recordCount(); }

  glm::dvec4 operator[](OccluderVector vector) const {
    return glm::dvec4(transfer_.vectors.at(record_ * transfer_.stored.size() + placeOf(transfer_, vector)));
  }

 private:
  const OccluderTransfer& transfer_;
  std::size_t record_ = std::numeric_limits<std::size_t>::max();
};

test::BakeResult bake(const CompiledScene& scene, std::uint64_t rays = 4096) {
  BakeRequest request;
  request.ao = request.occluders.wanted = true;
  request.effort.rays = rays;
  return test::runBake(scene, request);
}

CompiledMaterial gold() {
  CompiledMaterial material;
  material.metallic = 1.0f;
  material.roughness = 0.0f;
  material.baseColor = {1.0f, 0.75f, 0.25f};
  return material;
}

CompiledMaterial glass(bool solid) {
  CompiledMaterial material;
  material.baseColor = {1.0f, 0.5f, 0.25f};
  material.transmission = 1.0f;
  material.specular = 1.0f;
  material.roughness = 0.0f;
  material.solid = solid;
  return material;
}

/// A square wall that faces +X at x = -0.5.
CompiledScene wall(const CompiledMaterial& material) {
  CompiledScene scene =
      test::sceneOf({{-0.5f, 0, 1}, {-0.5f, 0, -1}, {-0.5f, 2, -1}, {-0.5f, 2, 1}}, {{0, 1, 2}, {0, 2, 3}});
  scene.materials[0] = material;
  return scene;
}

constexpr std::uint32_t middle = 12;  // Middle vertex of test::ground(4, ...).

TEST(OccluderWays, MirrorWithOpenReflection_KeepsItsNormalAndColour) {
  CompiledScene scene = test::ground(4, 0.4f);
  test::append(scene, wall(gold()));
  const OccluderTransfer transfer = *bake(scene).bake.occluders;
  const RecordOf seen(transfer, middle, 1);
  ASSERT_TRUE(seen.exists());
  const glm::dvec4 normal = seen[OccluderVector::SpecularNormal];
  EXPECT_NEAR(normal.w, seen[OccluderVector::Occlusion].w, 1e-6) << "rays that rise go on rising";
  EXPECT_GT(normal.w, 0.05);
  EXPECT_NEAR(normal.x, normal.w, 1e-6);
  const glm::dvec4 color = seen[OccluderVector::SpecularColor];
  EXPECT_NEAR(color.r, 1.0, 1e-5);
  // All channels rise towards 1 by the same share: the mean of Schlick's term over the directions in which
  // the plate is seen.
  const double rise = (color.g - 0.75) / 0.25;
  EXPECT_NEAR(color.b, 0.25 + 0.75 * rise, 1e-5);
  EXPECT_GT(rise, 0.01);
  EXPECT_LT(rise, 0.3);
}

// Half of the plate's reflections hit a second wall that faces it.
TEST(OccluderWays, MirrorThatSeesSomething_CountsOnlyWhatIsOpen) {
  CompiledScene scene = test::ground(4, 0.4f);
  test::append(scene, wall(gold()));
  CompiledScene opposite =
      test::sceneOf({{0.5f, 0, -9}, {0.5f, 0, 0}, {0.5f, 9, 0}, {0.5f, 9, -9}}, {{0, 1, 2}, {0, 2, 3}});
  for (glm::uvec3& t : opposite.triangles) std::swap(t.y, t.z);
  test::append(scene, opposite);
  const OccluderTransfer transfer = *bake(scene, 16384).bake.occluders;
  const RecordOf seen(transfer, middle, 1);
  ASSERT_TRUE(seen.exists());
  // From the middle, rays to either half of the wall (z < 0, z > 0) are reflected within that half.
  EXPECT_NEAR(seen[OccluderVector::SpecularNormal].w / seen[OccluderVector::Occlusion].w, 0.5, 0.04);
}

TEST(OccluderWays, MirrorAbove_ShowsTheGroundAndCountsForNothing) {
  CompiledScene scene = test::ground(4, 0.4f);
  CompiledScene lid = test::ground(1, 3.0f, 0.2f);
  for (glm::uvec3& t : lid.triangles) std::swap(t.y, t.z);
  lid.materials[0] = gold();
  test::append(scene, lid);
  CompiledScene floor = test::ground(1, 9.0f, -0.1f);
  test::append(scene, floor);
  const OccluderTransfer transfer = *bake(scene).bake.occluders;
  const RecordOf seen(transfer, middle, 1);
  ASSERT_TRUE(seen.exists());
  EXPECT_EQ(seen[OccluderVector::SpecularNormal].w, 0.0);
  EXPECT_GT(seen[OccluderVector::Occlusion].w, 0.9);
}

// Under a roof no direction is free. With a light inside the scene, directions to sufficiently distant
// surfaces are.
TEST(OccluderWays, LightInsideTheScene_MakesARoomFree) {
  CompiledScene scene = test::ground(4, 0.4f);
  test::append(scene, wall(gold()));
  test::append(scene, wall(glass(false)));
  for (std::uint32_t v = scene.primitives[2].firstVertex; v < scene.vertexCount(); ++v)
    scene.positions[v].x = 0.5f;
  test::append(scene, test::box(1, {-3, -3, -3}, {3, 3, 3}, true));
  const OccluderTransfer closed = *bake(scene, 1024).bake.occluders;
  EXPECT_EQ(RecordOf(closed, middle, 1)[OccluderVector::SpecularNormal].w, 0.0);
  EXPECT_EQ(RecordOf(closed, middle, 2)[OccluderVector::Caustic].w, 0.0);
  scene.lights.emplace_back();  // A point light in the middle.
  const OccluderTransfer lit = *bake(scene, 1024).bake.occluders;
  const RecordOf mirror(lit, middle, 1), pane(lit, middle, 2);
  EXPECT_GT(mirror[OccluderVector::SpecularNormal].w, 0.3 * mirror[OccluderVector::Occlusion].w);
  EXPECT_LT(mirror[OccluderVector::SpecularNormal].w, mirror[OccluderVector::Occlusion].w)
      << "some of what is mirrored is the pane";
  EXPECT_GT(pane[OccluderVector::Caustic].w, 0.3 * pane[OccluderVector::Occlusion].w);
}

TEST(OccluderWays, Dielectric_ReflectsByTheAngle) {
  CompiledScene scene = test::ground(4, 0.4f);
  CompiledMaterial polished;
  polished.roughness = 0.0f;
  polished.specular = 1.0f;
  test::append(scene, wall(polished));
  const OccluderTransfer transfer = *bake(scene).bake.occluders;
  const glm::dvec4 color = RecordOf(transfer, middle, 1)[OccluderVector::SpecularColor];
  EXPECT_GT(color.r, 0.04);  // Along the normal.
  EXPECT_LT(color.r, 0.3);
  EXPECT_EQ(color.r, color.g);
}

TEST(OccluderWays, Pane_LetsLightStraightThrough) {
  CompiledScene scene = test::ground(4, 0.4f);
  test::append(scene, wall(glass(false)));
  const OccluderTransfer transfer = *bake(scene).bake.occluders;
  const RecordOf seen(transfer, middle, 1);
  const glm::dvec4 occlusion = seen[OccluderVector::Occlusion], caustic = seen[OccluderVector::Caustic];
  EXPECT_NEAR(glm::length(caustic - occlusion), 0.0, 1e-6);
  const glm::dvec4 color = seen[OccluderVector::Transmissive];
  EXPECT_LT(color.r, 0.93);  // 8 % are reflected along the normal, more at other angles.
  EXPECT_GT(color.r, 0.75);
  EXPECT_NEAR(color.g / color.r, 0.5, 1e-4);
  EXPECT_NEAR(color.b / color.r, 0.25, 1e-4);
}

TEST(OccluderWays, PaneBeforeAWall_LetsNothingThrough) {
  CompiledScene scene = test::ground(4, 0.4f);
  test::append(scene, wall(glass(false)));
  CompiledScene behind = wall(CompiledMaterial());
  for (glm::vec3& p : behind.positions) p = {-0.7f, 3.0f * p.y, 3.0f * p.z};
  test::append(scene, behind);
  const OccluderTransfer transfer = *bake(scene).bake.occluders;
  const RecordOf seen(transfer, middle, 1);
  EXPECT_EQ(seen[OccluderVector::Caustic].w, 0.0);
  EXPECT_EQ(seen[OccluderVector::Transmissive], glm::dvec4(0.0));
}

/// Reference record of a glass ball at a point of a horizontal plane, by Snell's and Fresnel's laws on the
/// true sphere.
struct BallOfGlass {
  double formFactor = 0.0, throughFactor = 0.0, transmitted = 0.0;
  glm::dvec3 through{0.0};

  static double reflectance(double cosine, double eta) {
    const double beyond = std::sqrt(1.0 - (1.0 - cosine * cosine) / (eta * eta));
    const double s = (cosine - eta * beyond) / (cosine + eta * beyond),
                 p = (eta * cosine - beyond) / (eta * cosine + beyond);
    return 0.5 * (s * s + p * p);
  }

  BallOfGlass(const glm::dvec3& centre, double radius, double ior, int rays) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < rays; ++i) {
      const double turn = 2.0 * std::numbers::pi * unit(random), sine2 = unit(random),
                   sine = std::sqrt(sine2);
      const glm::dvec3 d(sine * std::cos(turn), std::sqrt(1.0 - sine2), sine * std::sin(turn));
      const double along = glm::dot(centre, d), miss2 = glm::dot(centre, centre) - along * along;
      if (along < 0.0 || miss2 > radius * radius) continue;
      formFactor += 1.0 / rays;
      const glm::dvec3 entry = (along - std::sqrt(radius * radius - miss2)) * d;
      const glm::dvec3 inside = glm::refract(d, (entry - centre) / radius, 1.0 / ior);
      const glm::dvec3 exit = entry - 2.0 * glm::dot(entry - centre, inside) * inside;
      const glm::dvec3 out = glm::refract(inside, -(exit - centre) / radius, ior);
      if (out.y < 0.0) continue;
      const double passed = 1.0 - reflectance(-glm::dot(d, entry - centre) / radius, ior);
      throughFactor += 1.0 / rays;
      transmitted += passed * passed / rays;  // Entry and exit pass the same share.
      through += out / double(rays);
    }
  }
};

TEST(OccluderWays, BallOfGlass_BendsRaysAsASphereDoes) {
  const glm::vec3 centre(0.0f, 0.9f, 0.0f);
  CompiledScene scene = test::ground(4, 0.1f);
  CompiledScene ball = test::sphere(48, 0.4f, centre);
  ball.materials[0] = glass(true);
  ball.materials[0].baseColor = glm::vec3(1.0f);
  test::append(scene, ball);
  test::append(scene, test::ground(1, 50.0f, -0.01f));
  const OccluderTransfer transfer = *bake(scene, 4096).bake.occluders;
  const RecordOf seen(transfer, middle, 1);
  const BallOfGlass expected(glm::dvec3(centre), 0.4, 1.5, 400000);
  const glm::dvec4 caustic = seen[OccluderVector::Caustic];
  EXPECT_NEAR(seen[OccluderVector::Occlusion].w, expected.formFactor, 0.003);
  EXPECT_NEAR(caustic.w, expected.throughFactor, 0.005);
  EXPECT_NEAR(caustic.y, expected.through.y, 0.005);
  const glm::dvec4 occlusion = seen[OccluderVector::Occlusion];
  EXPECT_LT(caustic.y / caustic.w, occlusion.y / occlusion.w - 0.01) << "the ball spreads the directions";
  EXPECT_NEAR(caustic.x, 0.0, 0.005);
  EXPECT_NEAR(seen[OccluderVector::Transmissive].r * seen[OccluderVector::Occlusion].w, expected.transmitted,
              0.005);
}

TEST(OccluderWays, AbsorbingGlass_ColoursWhatComesThrough) {
  CompiledScene scene = test::ground(4, 0.1f);
  CompiledScene slab = test::box(1, {-9, 0.5f, -9}, {9, 0.7f, 9}, false);
  slab.materials[0] = glass(true);
  slab.materials[0].baseColor = glm::vec3(1.0f);
  slab.materials[0].absorption = {0.0f, 2.0f, 50.0f};
  test::append(scene, slab);
  const OccluderTransfer transfer = *bake(scene).bake.occluders;
  const glm::dvec4 color = RecordOf(transfer, middle, 1)[OccluderVector::Transmissive];
  // Paths through the slab are 0.2 m along the normal and 0.27 m at grazing angles.
  EXPECT_GT(color.g, color.r * std::exp(-2.0 * 0.27));
  EXPECT_LT(color.g, color.r * std::exp(-2.0 * 0.2));
  EXPECT_LT(color.b, 1e-3);
}

TEST(OccluderWays, SceneWithoutGlassAndShine_CostsNoRaysAndNoVectors) {
  CompiledScene scene = test::ground(4, 0.4f);
  test::append(scene, wall(CompiledMaterial()));
  const test::BakeResult plain = bake(scene, 256);
  EXPECT_EQ(plain.bake.occluders->stored.size(), 4u);
  EXPECT_EQ(plain.report.rays, 16 * plain.report.receivers);
  scene.materials[1] = gold();
  const test::BakeResult shiny = bake(scene, 256);
  EXPECT_EQ(shiny.bake.occluders->stored.size(), 6u);
  EXPECT_GT(shiny.report.rays, plain.report.rays);
}

TEST(OccluderWays, BackOfATwoSidedSheet_LooksToTheReceiver) {
  CompiledScene scene = test::ground(4, 0.4f);
  CompiledScene sheet = test::ground(1, 0.4f, 0.5f);  // Faces up, away from the ground.
  sheet.materials[0].doubleSided = true;
  test::append(scene, sheet);
  const OccluderTransfer both = *bake(scene, 1024).bake.occluders;
  EXPECT_LT(RecordOf(both, middle, 1)[OccluderVector::DiffuseNormal].y, -0.1);
  scene.materials[1].doubleSided = false;
  const OccluderTransfer one = *bake(scene, 1024).bake.occluders;
  EXPECT_EQ(RecordOf(one, middle, 1)[OccluderVector::DiffuseNormal], glm::dvec4(0.0));
}

}  // namespace
}  // namespace prelight
