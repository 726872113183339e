#include "occluders/occluder_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>

#include "occluders/occluder_record.h"
#include "occluders/posed_occluders.h"
#include "support/occluders.h"
#include "support/scenes.h"

namespace prelight {
namespace {

RigidMotion motionOf(double degrees, const glm::dvec3& axis, const glm::dvec3& way) {
  return {glm::dmat3(glm::rotate(glm::dmat4(1.0), glm::radians(degrees), axis)), way};
}

/// Made-up records of 200 vertices. The first half of the vertices belongs to occluder 0, the rest to
/// occluder 1. Odd occluders are parts of 1, even ones of 0.
struct MadeScene {
  test::MadeOccluders made = test::makeOccluders(200, test::everyOptionalVector(), 7);
  CompiledScene scene;
  OccluderMembers members;
  OccluderMotions motions;

  MadeScene() {
    std::vector<glm::uvec3> triangles;
    for (std::uint32_t v = 0; v + 2 < 200; v += 3) triangles.emplace_back(v, v + 1, v + 2);
    scene = test::sceneOf(made.positions, triangles);
    scene.normals = made.normals;
    scene.origin = {0.5, -1.0, 2.0};
    made.transfer.names.clear();
    for (std::size_t v = 0; v < 200; ++v)
      for (std::uint32_t r = made.transfer.offsets[v]; r < made.transfer.offsets[v + 1]; ++r) {
        const std::uint32_t place = r - made.transfer.offsets[v];
        made.transfer.occluders[r] = place;
        if (place >= made.transfer.names.size()) made.transfer.names.emplace_back("part");
      }
    for (int o = 0; o < static_cast<int>(made.transfer.names.size()); ++o)
      members.parent.push_back(o < 2 ? -1 : o % 2);
    motions.motions = {RigidMotion{}};
    motions.ofOccluder.assign(made.transfer.names.size(), 0);
    for (std::uint32_t v = 0; v < 200; ++v) members.leafOfVertex.push_back(v < 100 ? 0 : 1);
    motions.ofVertex.assign(200, 0);
  }

  /// Moves occluder 1 and its vertices.
  void move(const RigidMotion& motion) {
    motions.motions.push_back(motion);
    std::fill(motions.ofVertex.begin() + 100, motions.ofVertex.end(), 1u);
    for (std::size_t o = 1; o < motions.ofOccluder.size(); o += 2) motions.ofOccluder[o] = 1;
  }

  OccluderTransfer moved() const { return OccluderMover(made.transfer, scene, members).moved(motions); }
};

void expectSameBits(const OccluderTransfer& a, const OccluderTransfer& b) {
  EXPECT_EQ(a.offsets, b.offsets);
  EXPECT_EQ(a.occluders, b.occluders);
  ASSERT_EQ(a.vectors.size(), b.vectors.size());
  EXPECT_EQ(std::memcmp(a.vectors.data(), b.vectors.data(), a.vectors.size() * sizeof(glm::vec4)), 0);
}

TEST(OccluderMotion, Identity_ChangesNoBit) {
  MadeScene at;
  expectSameBits(at.moved(), at.made.transfer);
  at.move({});
  expectSameBits(at.moved(), at.made.transfer);
}

// If everything moves together, records turn with the motion and keep their lengths.
TEST(OccluderMotion, EverythingTogether_IsTheSameSceneElsewhere) {
  MadeScene at;
  const RigidMotion motion = motionOf(70.0, glm::normalize(glm::dvec3(1, 2, -1)), {3, -1, 0.5});
  at.motions.motions = {motion};
  const OccluderTransfer moved = at.moved(), &rest = at.made.transfer;
  EXPECT_EQ(moved.offsets, rest.offsets);
  ASSERT_EQ(moved.vectors.size(), rest.vectors.size());
  for (std::size_t i = 0; i < rest.vectors.size(); ++i) {
    const glm::dvec3 xyz(rest.vectors[i]);
    const OccluderVector kind = rest.stored[i % rest.stored.size()];
    const bool turns = kind == OccluderVector::Occlusion || kind == OccluderVector::Caustic ||
                       kind == OccluderVector::DiffuseNormal || kind == OccluderVector::SpecularNormal;
    const glm::dvec3 expected = kind == OccluderVector::Position ? motion.rotation * xyz + motion.translation
                                : turns                          ? motion.rotation * xyz
                                                                 : xyz;
    EXPECT_LT(glm::length(glm::dvec3(moved.vectors[i]) - expected), 1e-5);
    EXPECT_EQ(moved.vectors[i].w, rest.vectors[i].w);
  }
}

TEST(OccluderMotion, AnyMotion_IsFiniteAndNoMoreThanASky) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  for (const double far : {1e-6, 0.1, 1.0, 30.0, 1e6}) {
    MadeScene at;
    at.move(motionOf(360.0 * normal(random), glm::dvec3(test::randomDirection(random)),
                     far * glm::dvec3(normal(random), normal(random), normal(random))));
    const OccluderTransfer moved = at.moved();
    const std::size_t width = moved.stored.size();
    const std::size_t occlusion = placeOf(moved, OccluderVector::Occlusion);
    for (std::size_t v = 0; v < 200; ++v) {
      double sum = 0.0;
      for (std::size_t r = moved.offsets[v]; r < moved.offsets[v + 1]; ++r) {
        for (std::size_t s = 0; s < width; ++s)
          for (int c = 0; c < 4; ++c) ASSERT_TRUE(std::isfinite(moved.vectors[r * width + s][c]));
        const glm::dvec4 seen(moved.vectors[r * width + occlusion]);
        EXPECT_GE(seen.w, 0.0);
        EXPECT_LE(glm::length(glm::dvec3(seen)), seen.w * (1.0 + 1e-6));
        sum += seen.w;
        if (r > moved.offsets[v]) {
          EXPECT_LT(moved.occluders[r - 1], moved.occluders[r]);
        }
      }
      EXPECT_LE(sum, 1.0 + 1e-5) << far;
    }
  }
}

/// A floor whose vertices have exact records of a ball.
struct BallScene {
  CompiledScene scene = test::ground(20, 4.0f);
  OccluderTransfer transfer{{"floor", "ball"},
                            {OccluderVector::Position, OccluderVector::Occlusion,
                             OccluderVector::DiffuseNormal, OccluderVector::DiffuseColor},
                            {0},
                            {},
                            {}};
  OccluderMembers members{{}, {-1, -1}};
  OccluderMotions motions;

  static double formFactor(const glm::dvec3& vertex, const glm::dvec3& centre) {
    const glm::dvec3 path = centre - vertex;
    return 0.25 * path.y / std::pow(glm::length(path), 3.0);  // (r / d)^2 cos.
  }

  explicit BallScene(const glm::dvec3& centre) {
    const std::uint32_t floor = scene.vertexCount();
    test::append(scene, test::sphere(12, 0.5f, glm::vec3(centre)));
    members.leafOfVertex.assign(scene.vertexCount(), 1);
    std::fill_n(members.leafOfVertex.begin(), floor, 0u);
    motions.ofVertex = members.leafOfVertex;
    motions.ofOccluder = {0, 1};
    motions.motions = {{}, {}};
    for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
      if (v < floor) add(glm::dvec3(scene.positions[v]), centre);
      transfer.offsets.push_back(static_cast<std::uint32_t>(transfer.occluders.size()));
    }
  }

  void add(const glm::dvec3& vertex, const glm::dvec3& centre) {
    const double f = formFactor(vertex, centre);
    const glm::dvec3 d = glm::normalize(centre - vertex);
    transfer.occluders.push_back(1);
    transfer.vectors.insert(
        transfer.vectors.end(),
        {glm::vec4(centre - 0.33 * d, glm::length(centre - vertex) - 0.3), glm::vec4(0.98 * f * d, f),
         glm::vec4(-0.6 * f * d, 0.8 * f), glm::vec4(0.5f, 0.25f, 1.0f, 0.0f)});
  }

  OccluderTransfer moved(const glm::dvec3& way) {
    motions.motions[1].translation = way;
    return OccluderMover(transfer, scene, members).moved(motions);
  }
};

// A ball that floats freely has its form factor wherever it moves (Howell's catalogue).
TEST(OccluderMotion, BallAboveAFloor_KeepsToItsFormFactor) {
  const glm::dvec3 centre(0.3, 1.2, -0.2);
  BallScene at(centre);
  for (const glm::dvec3& way : {glm::dvec3(0.1, 0, 0), glm::dvec3(0, 0.4, 0.3), glm::dvec3(-1.7, 0.2, 1.1)}) {
    const OccluderTransfer moved = at.moved(way);
    for (std::uint32_t v = 0; v < 441; ++v) {
      ASSERT_EQ(moved.offsets[v + 1] - moved.offsets[v], 1u);
      const glm::dvec3 vertex(at.scene.positions[v]), now = centre + way;
      const glm::vec4 occlusion = moved.vectors[4 * moved.offsets[v] + 1];
      const double expected = BallScene::formFactor(vertex, now);
      EXPECT_NEAR(occlusion.w, expected, 1e-3 + 0.02 * expected) << v;
      EXPECT_GT(glm::dot(glm::normalize(glm::dvec3(occlusion)), glm::normalize(now - vertex)), 0.999);
      const glm::dvec4 position(moved.vectors[4 * moved.offsets[v]]);
      EXPECT_LT(glm::length(glm::dvec3(position) - now), 0.5);
    }
  }
}

// The ball rises from below the floor, where no vertex had a record of it, and sinks again.
TEST(OccluderMotion, Rising_MakesRecordsAndSinkingTakesThem) {
  BallScene at({0.3, 1.2, -0.2});
  EXPECT_EQ(at.moved({0.0, -3.0, 0.0}).offsets[441], 0u);

  BallScene below({0.3, 1.2, -0.2});
  below.transfer.offsets.assign(below.scene.vertexCount() + 1, 0);
  below.transfer.occluders.clear();
  below.transfer.vectors.clear();
  for (std::uint32_t v = 441; v < below.scene.vertexCount(); ++v) below.scene.positions[v].y -= 3.0f;
  const OccluderTransfer risen = below.moved({0.0, 3.0, 0.0});
  double sum = 0.0, expected = 0.0;
  for (std::uint32_t v = 0; v < 441; ++v) {
    expected += BallScene::formFactor(glm::dvec3(below.scene.positions[v]), {0.3, 1.2, -0.2});
    for (std::uint32_t r = risen.offsets[v]; r < risen.offsets[v + 1]; ++r)
      sum += double(risen.vectors[4 * r + 1].w);
  }
  EXPECT_NEAR(sum, expected, 0.25 * expected);
}

TEST(SceneMotion, BetweenTransforms_IsRigidOrNone) {
  const glm::dmat4 before = glm::scale(glm::translate(glm::dmat4(1.0), {1, 2, 3}), glm::dvec3(2.0));
  const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), 0.7, glm::dvec3(0, 1, 0)) * before;
  const auto motion = motionBetween(before, turned);
  ASSERT_TRUE(motion);
  const glm::dvec3 point(0.3, -0.4, 0.5);
  EXPECT_LT(glm::length(motion->point(glm::dvec3(before * glm::dvec4(point, 1.0))) -
                        glm::dvec3(turned * glm::dvec4(point, 1.0))),
            1e-12);
  EXPECT_EQ(motionBetween(before, before), RigidMotion{});
  EXPECT_FALSE(motionBetween(before, glm::scale(before, glm::dvec3(1.01))));
  EXPECT_FALSE(motionBetween(before, glm::scale(before, glm::dvec3(-1, 1, 1))));
  EXPECT_FALSE(motionBetween(before, glm::dmat4(0.0)));
}

}  // namespace
}  // namespace prelight
