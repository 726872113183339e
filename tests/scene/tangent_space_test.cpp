#include "scene/surface/tangent_space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/scenes.h"

namespace prelight {
namespace {

/// The scene with a normal texture, and with texture coordinates computed from positions.
template <typename CoordOf>
CompiledScene mapped(CompiledScene scene, const CoordOf& coordOf) {
  for (std::size_t i = 0; i < scene.positions.size(); ++i)
    scene.texCoords[i] = glm::vec2(coordOf(glm::dvec3(scene.positions[i])));
  scene.materials[0].normalTexture.image = 0;
  return scene;
}

glm::dvec3 direction(const glm::vec4& tangent) { return glm::dvec3(tangent); }

TEST(TangentSpace, Plane_FollowsItsCoordinates) {
  const CompiledScene scene = mapped(
      test::ground(3, 1.0f), [](const glm::dvec3& p) { return glm::dvec2(0.3 * p.x + 0.4 * p.z, p.x); });
  for (const glm::vec4& tangent : cornerTangents(scene)) {
    // u = 0.3 x + 0.4 z alone grows along z, and v = x alone grows along (1, -3/4).
    EXPECT_LT(glm::length(direction(tangent) - glm::dvec3(0, 0, 1)), 1e-6);
    const glm::dvec3 up = double(tangent.w) * glm::cross(glm::dvec3(0, 1, 0), direction(tangent));
    EXPECT_LT(up.x, 0.0) << "along which v falls";
  }
}

TEST(TangentSpace, TransformOfTheTexture_TurnsThem) {
  CompiledScene scene =
      mapped(test::ground(1, 1.0f), [](const glm::dvec3& p) { return glm::dvec2(p.x, p.z); });
  scene.materials[0].normalTexture.transform = glm::mat3(0, 1, 0, -1, 0, 0, 5, 7, 1);  // (u, v) -> (-v, u).
  for (const glm::vec4& tangent : cornerTangents(scene))
    EXPECT_LT(glm::length(direction(tangent) - glm::dvec3(0, 0, -1)), 1e-6);
}

TEST(TangentSpace, SecondSet_IsTheTextures) {
  CompiledScene scene =
      mapped(test::ground(1, 1.0f), [](const glm::dvec3& p) { return glm::dvec2(p.x, p.z); });
  for (const glm::vec2& uv : scene.texCoords) scene.texCoords1.emplace_back(-uv.x, uv.y);
  scene.materials[0].normalTexture.texCoord = 1;
  for (const glm::vec4& tangent : cornerTangents(scene))
    EXPECT_LT(glm::length(direction(tangent) - glm::dvec3(-1, 0, 0)), 1e-6);
}

TEST(TangentSpace, Sphere_RunsAlongItsParallels) {
  CompiledScene scene = mapped(test::sphere(24, 2.0f, {0, 0, 0}), [](const glm::dvec3& p) {
    return glm::dvec2(std::atan2(p.z, p.x) / (2.0 * std::numbers::pi),
                      std::acos(p.y / 2.0) / std::numbers::pi);
  });
  const std::vector<glm::vec4> tangents = cornerTangents(scene);
  std::size_t looked = 0;
  for (std::size_t c = 0; c < tangents.size(); ++c) {
    const std::uint32_t v = scene.triangles[c / 3][static_cast<int>(c % 3)];
    const glm::dvec3 p(scene.positions[v]), n(scene.normals[v]);
    EXPECT_NEAR(glm::dot(direction(tangents[c]), n), 0.0, 1e-6);
    EXPECT_NEAR(glm::length(direction(tangents[c])), 1.0, 1e-6);
    // Skips the poles and the seam of atan2.
    if (std::abs(p.y) > 1.8 || (p.x < 0.0 && std::abs(p.z) < 0.7)) continue;
    const glm::dvec3 along = glm::normalize(glm::dvec3(-p.z, 0.0, p.x));
    EXPECT_GT(glm::dot(direction(tangents[c]), along), 0.995);
    ++looked;
  }
  EXPECT_GT(looked, 1000u);
}

/// Two triangles that share the edge x = 0, where the texture is mirrored.
TEST(TangentSpace, MirroredHalves_DoNotMix) {
  CompiledScene scene =
      mapped(test::sceneOf({{-1, 0, 0}, {0, 0, 1}, {0, 0, -1}, {1, 0, 0}}, {{0, 1, 2}, {1, 3, 2}}),
             [](const glm::dvec3& p) { return glm::dvec2(std::abs(p.x), p.z); });
  const std::vector<glm::vec4> tangents = cornerTangents(scene);
  for (std::size_t c = 0; c < 6; ++c) {
    EXPECT_LT(glm::length(direction(tangents[c]) - glm::dvec3(c < 3 ? -1 : 1, 0, 0)), 1e-6) << c;
    EXPECT_EQ(tangents[c].w, tangents[c < 3 ? 0 : 3].w);
  }
  EXPECT_EQ(tangents[0].w, -tangents[3].w);
}

/// Triangles around a vertex are weighted by their angle there.
TEST(TangentSpace, Corner_WeighsItsTrianglesByAngle) {
  // Angles of 90 and 45 degrees in a plane. u runs along x in the first triangle, and along x + z in the
  // second.
  CompiledScene scene = test::sceneOf({{0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {1, 0, 1}}, {{0, 1, 2}, {0, 3, 1}});
  scene.texCoords = {{0, 0}, {1, 0}, {0, -1}, {2, 0.5f}};
  scene.materials[0].normalTexture.image = 0;
  // Texture coordinates of the second triangle's edges to (1, 1) and (1, 0).
  const glm::dvec2 d1(2, 0.5), d2(1, 0);
  const glm::dvec3 e1(1, 0, 1), e2(1, 0, 0);
  const double determinant = d1.x * d2.y - d2.x * d1.y;
  const glm::dvec3 second = glm::normalize((d2.y * e1 - d1.y * e2) / determinant);
  const double right = std::numbers::pi / 2.0, half = std::numbers::pi / 4.0;
  const glm::dvec3 expected = glm::normalize(right * glm::dvec3(1, 0, 0) + half * second);
  const std::vector<glm::vec4> tangents = cornerTangents(scene);
  EXPECT_LT(glm::length(direction(tangents[0]) - expected), 1e-6);
  EXPECT_LT(glm::length(direction(tangents[3]) - expected), 1e-6);
  EXPECT_LT(glm::length(direction(tangents[2]) - glm::dvec3(1, 0, 0)), 1e-6) << "a corner of one triangle";
}

TEST(TangentSpace, TriangleWithoutTextureArea_TakesItsNeighboursOrAnyPerpendicular) {
  CompiledScene scene = test::sceneOf({{0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {-1, 0, 0}}, {{0, 1, 2}, {0, 2, 3}});
  // The second triangle's texture coordinates lie on a line.
  scene.texCoords = {{0, 0}, {1, 0}, {0, 1}, {0, 0}};
  scene.materials[0].normalTexture.image = 0;
  const std::vector<glm::vec4> tangents = cornerTangents(scene);
  EXPECT_EQ(tangents[3], tangents[0]);
  for (const glm::vec4& tangent : tangents) {
    EXPECT_NEAR(glm::length(direction(tangent)), 1.0, 1e-6);
    EXPECT_NEAR(tangent.y, 0.0f, 1e-6f);
  }
}

TEST(TangentSpace, FilesTangents_AreTakenUnlessTheTriangleIsFlat) {
  CompiledScene scene =
      mapped(test::ground(1, 1.0f), [](const glm::dvec3& p) { return glm::dvec2(p.x, p.z); });
  scene.tangents.assign(4, glm::vec4(0, 0, 1, -1));
  for (const glm::vec4& tangent : cornerTangents(scene)) EXPECT_EQ(tangent, scene.tangents[0]);
  scene.triangleFlat.assign(2, 1);
  for (const glm::vec4& tangent : cornerTangents(scene))
    EXPECT_LT(glm::length(direction(tangent) - glm::dvec3(1, 0, 0)), 1e-6);
}

TEST(TangentSpace, WithoutANormalTexture_AreNone) {
  CompiledScene scene = test::ground(1, 1.0f);
  for (const glm::vec4& tangent : cornerTangents(scene)) EXPECT_EQ(tangent, glm::vec4(0.0f));
}

}  // namespace
}  // namespace prelight
