#include "occluders/occluder_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "occluders/occluder_light.h"
#include "support/run_bake.h"
#include "support/scenes.h"

namespace prelight {
namespace {

constexpr std::uint32_t floorVertices = 25 * 25;

/// A floor of 6 m with a box of 1 m on it, and a ball beside the box.
CompiledScene floorBoxAndBall(float boxX) {
  CompiledScene scene = test::ground(24, 3.0f);
  test::append(scene, test::box(6, {boxX - 0.5f, 0.01f, -0.5f}, {boxX + 0.5f, 1.01f, 0.5f}, false));
  test::append(scene, test::sphere(12, 0.4f, {0.2f, 0.5f, 1.7f}));
  for (int i = 0; i < 3; ++i) scene.primitives[static_cast<std::size_t>(i)].node = i;
  return scene;
}

OccluderTransfer baked(const CompiledScene& scene, OccluderKind kind) {
  BakeRequest request;
  request.ao = request.occluders.wanted = true;
  request.occluders.kind = kind;
  request.effort.rays = 1024;
  return *test::runBake(scene, request).bake.occluders;
}

OccluderMotions boxMoves(const CompiledScene& scene, const OccluderMembers& members, double way) {
  OccluderMotions motions{{{}, {glm::dmat3(1.0), {way, 0.0, 0.0}}}, {}, {}};
  motions.ofOccluder.assign(members.parent.size(), 0);
  motions.ofVertex.assign(scene.vertexCount(), 0);
  const PrimitiveRange& box = scene.primitives[1];
  std::fill_n(motions.ofVertex.begin() + box.firstVertex, box.vertexCount, 1u);
  for (std::size_t v = 0; v < scene.vertexCount(); ++v)
    for (int o = static_cast<int>(members.leafOfVertex[v]); o >= 0;
         o = members.parent[static_cast<std::size_t>(o)])
      motions.ofOccluder[static_cast<std::size_t>(o)] = motions.ofVertex[v];
  return motions;
}

/// Form factors, [floor vertex], of all occluders of one motion together.
std::vector<double> formFactors(const OccluderTransfer& transfer, const OccluderMotions& motions,
                                std::uint32_t motion) {
  std::vector<double> factors(floorVertices, 0.0);
  for (std::uint32_t v = 0; v < floorVertices; ++v)
    for (std::uint32_t r = transfer.offsets[v]; r < transfer.offsets[v + 1]; ++r)
      if (motions.ofOccluder[transfer.occluders[r]] == motion)
        factors[v] += double(transfer.vectors[r * transfer.stored.size() + 1].w);
  return factors;
}

double relativeRms(const std::vector<double>& a, const std::vector<double>& b) {
  double error = 0.0, size = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    error += (a[i] - b[i]) * (a[i] - b[i]);
    size += b[i] * b[i];
  }
  return std::sqrt(error / size);
}

/// Cosine x visibility of floor vertices under each of 16 lights.
std::vector<double> shadows(const CompiledScene& scene, const OccluderTransfer& transfer) {
  std::vector<double> light;
  for (int i = 0; i < 16; ++i) {
    const double azimuth = 2.4 * i, height = 0.3 + 0.06 * i;
    const IncidentLight from{glm::dvec3(1.0),
                             glm::normalize(glm::dvec3(std::cos(azimuth), height, std::sin(azimuth)))};
    for (std::uint32_t v = 0; v < floorVertices; ++v)
      light.push_back(from.toLight.y *
                      visibilityOf(transfer, {v, glm::dvec3(scene.positions[v]), {0, 1, 0}}, from, {}));
  }
  return light;
}

/// Errors after moving the box, relative to a bake with the box at its new place, and errors of leaving
/// everything as it was.
struct MotionErrors {
  double formFactor = 0.0;
  double shadow = 0.0;
  double ofRestFormFactor = 0.0;
  double ofRestShadow = 0.0;
};

MotionErrors errorsOf(const CompiledScene& before, const OccluderTransfer& rest, OccluderKind kind,
                      double way) {
  const CompiledScene after = floorBoxAndBall(static_cast<float>(-0.8 + way));
  const OccluderTransfer truth = baked(after, kind);
  const OccluderMembers members = membersOf(before, rest).value(),
                        membersThere = membersOf(after, truth).value();
  const OccluderMotions motions = boxMoves(before, members, way);
  const OccluderTransfer moved = OccluderMover(rest, before, members).moved(motions);
  const auto factorsThere = formFactors(truth, boxMoves(after, membersThere, way), 1);
  const auto shadowsThere = shadows(after, truth);
  return {relativeRms(formFactors(moved, motions, 1), factorsThere),
          relativeRms(shadows(after, moved), shadowsThere),
          relativeRms(formFactors(rest, motions, 1), factorsThere),
          relativeRms(shadows(before, rest), shadowsThere)};
}

// The box moves by a tenth, half and all of its size, and by three times its size. If it moves by less than
// the distance of vertices, the vertices at its foot see something else altogether.
TEST(OccluderMotionBake, BoxOnAFloor_IsNearABakeAtThePlace) {
  const CompiledScene before = floorBoxAndBall(-0.8f);
  for (const OccluderKind kind : {OccluderKind::Node, OccluderKind::Auto}) {
    const OccluderTransfer rest = baked(before, kind);
    for (const double way : {0.1, 0.5, 1.0, 3.0}) {
      const MotionErrors errors = errorsOf(before, rest, kind, way);
      EXPECT_LT(errors.formFactor, way < 0.25 ? 0.2 : 0.05) << way;
      EXPECT_LT(errors.formFactor, 0.8 * errors.ofRestFormFactor) << way;
      EXPECT_LT(errors.shadow, 0.08) << way;
      EXPECT_LT(errors.shadow, 0.85 * errors.ofRestShadow) << way;
    }
  }
}

// The box is moved back by moving the records that were made there.
TEST(OccluderMotionBake, ThereAndBack_IsNearTheBake) {
  const CompiledScene before = floorBoxAndBall(-0.8f);
  const OccluderTransfer rest = baked(before, OccluderKind::Node);
  const OccluderMembers members = membersOf(before, rest).value();
  const OccluderTransfer there = OccluderMover(rest, before, members).moved(boxMoves(before, members, 1.0));
  const OccluderTransfer back =
      OccluderMover(there, floorBoxAndBall(0.2f), members).moved(boxMoves(before, members, -1.0));
  const OccluderMotions motions = boxMoves(before, members, 0.0);
  EXPECT_LT(relativeRms(formFactors(back, motions, 1), formFactors(rest, motions, 1)), 0.02);
  EXPECT_LT(relativeRms(shadows(before, back), shadows(before, rest)), 0.05);
}

}  // namespace
}  // namespace prelight
