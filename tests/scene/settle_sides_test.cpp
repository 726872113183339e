// Facing of surfaces: rooms whose normals point outwards, and meshes wound against their normals.
#include "scene/settle_sides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "support/made_scenes.h"

namespace prelight {
namespace {

using test::SceneMaker;

const glm::vec3 low(-2.0f, 0.0f, -2.0f), high(2.0f, 3.0f, 2.0f);
const glm::dvec3 middle(0.0, 1.5, 0.0), beside(6.0, 4.0, 6.0);

CompiledScene room(bool inward) { return test::box(4, low, high, inward); }
CompiledScene crate() { return test::box(2, {-0.6f, 0.0f, -0.9f}, {0.2f, 0.8f, -0.1f}, false); }

/// The mesh without the triangles for whose centre `leaves` is true.
template <typename Leaves>
CompiledScene without(CompiledScene mesh, const Leaves& leaves) {
  std::erase_if(mesh.triangles, [&](const glm::uvec3& t) {
    return leaves((mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0f);
  });
  mesh.triangleMaterials.resize(mesh.triangles.size());
  mesh.triangleFlat.resize(mesh.triangles.size());
  return mesh;
}

/// Share of the area of a drawn mesh whose fronts look towards a point.
double facing(const LoadedScene& scene, std::size_t mesh, const glm::dvec3& point) {
  const PrimitiveRange& range = scene.compiled.primitives[mesh];
  double all = 0.0, towards = 0.0;
  for (std::uint32_t t = range.firstTriangle; t < range.firstTriangle + range.triangleCount; ++t) {
    const glm::dvec3 normal = geometricNormal(scene.compiled, t);
    const glm::dvec3 corner(scene.compiled.positions[scene.compiled.triangles[t].x]);
    all += glm::length(normal);
    if (glm::dot(normal, point - scene.compiled.origin - corner) > 0.0) towards += glm::length(normal);
  }
  return towards / all;
}

bool drawnOnBothSides(const LoadedScene& scene, std::size_t mesh) {
  const PrimitiveRange& range = scene.compiled.primitives[mesh];
  return scene.compiled.materials[scene.compiled.triangleMaterials[range.firstTriangle]].doubleSided;
}

bool normalsAgree(const CompiledScene& scene) {
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    for (int corner = 0; corner < 3; ++corner)
      if (glm::dot(geometricNormal(scene, t), glm::dvec3(scene.normals[scene.triangles[t][corner]])) <= 0.0)
        return false;
  return true;
}

void expectTaken(const LoadedScene& scene, std::size_t mesh = 0, const glm::dvec3& within = middle) {
  EXPECT_TRUE(drawnOnBothSides(scene, mesh));
  EXPECT_GT(facing(scene, mesh, within), 0.99);
  EXPECT_GT(scene.scene.sides.seenFromBehind, 0.0);
  EXPECT_TRUE(normalsAgree(scene.compiled));
}

void expectAsItIs(const LoadedScene& scene) {
  EXPECT_EQ(scene.scene.sides.seenFromBehind, 0.0);
  for (std::size_t i = 0; i < scene.compiled.primitives.size(); ++i)
    EXPECT_FALSE(drawnOnBothSides(scene, i)) << i;
  EXPECT_TRUE(scene.compiled.triangleTurns.empty());
}

TEST(SeenFromBehind, OutwardRoomAroundCameraAndLamp_IsTakenAsDoubleSidedAndFacesInwards) {
  const LoadedScene scene = SceneMaker()
                                .add("room", room(false))
                                .add("crate", crate())
                                .addLamp({0.3, 2.2, 0.3})
                                .addCamera({1.8, 1.5, 1.8})
                                .make();
  expectTaken(scene);
  EXPECT_FALSE(drawnOnBothSides(scene, 1));
  EXPECT_EQ(scene.scene.sides.seenFromBehindNodes, std::vector<std::string>{"room"});
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("\"room\""), std::string::npos);
}

TEST(SeenFromBehind, InwardRoom_StaysAsItIs) {
  expectAsItIs(SceneMaker()
                   .add("room", room(true))
                   .add("crate", crate())
                   .addLamp({0.3, 2.2, 0.3})
                   .addCamera({1.8, 1.5, 1.8})
                   .make());
}

TEST(SeenFromBehind, DollHouse_StaysAsItIs) {
  for (const double away : {2.3, 4.0, 12.0})
    expectAsItIs(SceneMaker()
                     .add("room", room(true))
                     .add("crate", crate())
                     .addLamp({0.3, 2.2, 0.3})
                     .addCamera({0.0, 1.5, away})
                     .make());
}

TEST(SeenFromBehind, WallsOfADollHouseApart_StayAsTheyAre) {
  const auto wall = [](int axis, float side) {
    return without(room(true), [=](const glm::vec3& p) { return std::abs(p[axis] - side) > 0.01f; });
  };
  SceneMaker maker;
  for (const int axis : {0, 2})
    for (const float side : {-2.0f, 2.0f}) maker.add("wall", wall(axis, side));
  maker.add("floor", wall(1, 0.0f)).add("ceiling", wall(1, 3.0f));
  expectAsItIs(maker.addLamp({0.3, 2.2, 0.3}).addCamera({0.0, 1.5, 2.2}).make());
}

TEST(SeenFromBehind, OutwardRoomThatIsNotClosed_IsTaken) {
  const CompiledScene noCeiling = without(room(false), [](const glm::vec3& p) { return p.y > 2.99f; });
  const CompiledScene door = without(
      room(false), [](const glm::vec3& p) { return p.x > 1.99f && std::abs(p.z) < 0.5f && p.y < 2.0f; });
  for (const CompiledScene& open : {noCeiling, door})
    expectTaken(SceneMaker()
                    .add("room", open)
                    .add("crate", crate())
                    .add("ground", test::ground(8, 20.0f, -0.01f))
                    .addLamp({0.3, 2.0, 0.3})
                    .addCamera({1.5, 1.5, 1.5})
                    .make());
}

TEST(SeenFromBehind, OutwardWallsOfMeshesOfTheirOwn_AreTaken) {
  SceneMaker maker;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true})
      maker.add("wall", without(room(false), [=](const glm::vec3& p) {
                  return std::abs(p[axis] - (upper ? high : low)[axis]) > 0.01f;
                }));
  const LoadedScene scene = maker.addLamp({0.3, 2.2, 0.3}).addCamera({1.5, 1.5, 1.5}).make();
  for (std::size_t wall = 0; wall < 6; ++wall) expectTaken(scene, wall);
}

TEST(SeenFromBehind, RoomAndCrateOfOneMesh_OnlyTheRoomIsTurned) {
  const LoadedScene scene = SceneMaker()
                                .add("all", test::joined({room(false), crate()}))
                                .addLamp({0.3, 2.2, 0.3})
                                .addCamera({1.8, 1.5, 1.8})
                                .make();
  const std::uint32_t ofRoom = room(false).triangleCount();
  ASSERT_EQ(scene.compiled.triangleTurns.size(), scene.compiled.triangleCount());
  for (std::uint32_t t = 0; t < scene.compiled.triangleCount(); ++t)
    EXPECT_EQ(scene.compiled.triangleTurns[t] != 0, t < ofRoom) << t;
  EXPECT_TRUE(normalsAgree(scene.compiled));
}

TEST(SeenFromBehind, SeveralRoomsOfOneMesh_AreTaken) {
  const auto shifted = [](CompiledScene mesh, float x) {
    for (glm::vec3& p : mesh.positions) p.x += x;
    return mesh;
  };
  const LoadedScene scene =
      SceneMaker()
          .add("rooms", test::joined({room(false), shifted(room(false), 5.0f), shifted(room(false), 10.0f)}))
          .add("crate", crate())
          .addLamp({0.0, 2.2, 0.0})
          .addLamp({5.0, 2.2, 0.0})
          .addLamp({10.0, 2.2, 0.0})
          .addCamera({1.8, 1.5, 1.8})
          .make();
  EXPECT_EQ(std::count(scene.compiled.triangleTurns.begin(), scene.compiled.triangleTurns.end(), 0),
            std::ptrdiff_t{crate().triangleCount()});
}

TEST(SeenFromBehind, RoomWithoutCamera_IsTakenWhereALampLightsSomethingInIt) {
  expectTaken(SceneMaker().add("room", room(false)).add("crate", crate()).addLamp({0.3, 2.2, 0.3}).make());
  expectTaken(SceneMaker().add("room", room(false)).addLamp({0.3, 2.2, 0.3}).make());
  // If there is an outside as well, the vertices keep facing outwards.
  const LoadedScene scene = SceneMaker()
                                .add("room", room(false))
                                .add("crate", crate())
                                .add("ground", test::ground(8, 20.0f, -0.01f))
                                .addLamp({0.3, 2.2, 0.3})
                                .addSun({0.2, -1.0, 0.3})
                                .make();
  EXPECT_TRUE(drawnOnBothSides(scene, 0));
  EXPECT_LT(facing(scene, 0, middle), 0.01);
}

TEST(SeenFromBehind, Bulb_StaysAsItIsAndItsLampIsTold) {
  const CompiledScene bulb = test::sphere(12, 0.05f, {0.0f, 2.5f, 0.0f});
  for (const bool camera : {false, true}) {
    SceneMaker maker;
    maker.add("room", room(true)).add("bulb", bulb).addLamp({0.0, 2.5, 0.0});
    if (camera) maker.addCamera({1.8, 1.5, 1.8});
    const LoadedScene scene = maker.make();
    expectAsItIs(scene);
    ASSERT_EQ(scene.scene.sides.shutInLamps.size(), 1u);
    EXPECT_NE(scene.scene.sides.shutInLamps[0].find("\"Lamp\""), std::string::npos);
    EXPECT_NE(scene.scene.sides.shutInLamps[0].find("\"bulb\""), std::string::npos);
  }
}

TEST(SeenFromBehind, BulbInAnOutwardRoom_StaysAndTheRoomIsTaken) {
  const LoadedScene scene = SceneMaker()
                                .add("room", room(false))
                                .add("bulb", test::sphere(12, 0.05f, {0.0f, 2.5f, 0.0f}))
                                .addLamp({0.0, 2.5, 0.0})
                                .addLamp({1.0, 1.0, 1.0})
                                .addCamera({1.8, 1.5, 1.8})
                                .make();
  expectTaken(scene);
  EXPECT_FALSE(drawnOnBothSides(scene, 1));
  EXPECT_EQ(scene.scene.sides.shutInLamps.size(), 1u);
}

TEST(SeenFromBehind, BodiesWithBodiesWithin_StayAsTheyAre) {
  // A head with eyes, and boxes inside boxes.
  expectAsItIs(SceneMaker()
                   .add("head", test::sphere(12, 1.0f, {0.0f, 1.5f, 0.0f}))
                   .add("eye", test::sphere(8, 0.2f, {0.0f, 1.5f, 0.5f}))
                   .add("ground", test::ground(4, 4.0f))
                   .addLamp({3.0, 4.0, 3.0})
                   .addCamera(beside)
                   .make());
  expectAsItIs(SceneMaker().add("room", room(false)).add("crate", crate()).addCamera(beside).make());
  expectAsItIs(SceneMaker().add("room", room(false)).add("crate", crate()).make());
  expectAsItIs(SceneMaker().add("room", room(false)).addSun({0.2, -1.0, 0.3}).addCamera(beside).make());
}

TEST(SeenFromBehind, HouseOfAnOuterAndAnInnerShell_StaysAsItIs) {
  const auto windowed = [](const CompiledScene& shell) {
    return without(shell, [](const glm::vec3& p) {
      return p.x > 1.9f && std::abs(p.z) < 1.01f && p.y > 0.7f && p.y < 2.3f;
    });
  };
  const CompiledScene outer = test::box(4, low - 0.2f, high + 0.2f, false);
  expectAsItIs(SceneMaker()
                   .add("outside", windowed(outer))
                   .add("inside", windowed(room(true)))
                   .add("crate", crate())
                   .addLamp({0.3, 2.2, 0.3})
                   .addCamera({-1.8, 1.5, 1.8})
                   .make());
}

TEST(SeenFromBehind, RoomUnderASkyDome_IsTaken) {
  const LoadedScene scene =
      SceneMaker()
          .add("room", room(false))
          .add("crate", crate())
          .add("dome", test::woundBack(test::withNormalsInverted(test::sphere(16, 50.0f, glm::vec3(0.0f)))))
          .addLamp({0.3, 2.2, 0.3})
          .addCamera({1.8, 1.5, 1.8})
          .make();
  expectTaken(scene);
  EXPECT_FALSE(drawnOnBothSides(scene, 2));
}

TEST(SeenFromBehind, SizeAndTurn_DoNotMatter) {
  for (const double scale : {0.01, 100.0}) {
    const glm::dmat4 place = glm::rotate(
        glm::translate(glm::scale(glm::dmat4(1.0), glm::dvec3(scale)), glm::dvec3(30.0, -7.0, 5.0)), 0.7,
        glm::normalize(glm::dvec3(1.0, 2.0, -0.5)));
    const auto make = [&](bool inward) {
      return SceneMaker(place)
          .add("room", room(inward))
          .add("crate", crate())
          .addLamp({0.3, 2.2, 0.3})
          .addCamera({1.8, 1.5, 1.8})
          .make();
    };
    expectTaken(make(false), 0, glm::dvec3(place * glm::dvec4(middle, 1.0)));
    expectAsItIs(make(true));
  }
}

TEST(SeenFromBehind, DoubleSidedOutwardRoom_FacesInwards) {
  const LoadedScene scene = SceneMaker()
                                .add("room", room(false), SceneMaker::twoSided)
                                .add("crate", crate())
                                .addLamp({0.3, 2.2, 0.3})
                                .addCamera({1.8, 1.5, 1.8})
                                .make();
  EXPECT_GT(facing(scene, 0, middle), 0.99);
  EXPECT_TRUE(drawnOnBothSides(scene, 0));
}

TEST(SeenFromBehind, EmissivePanelInTheRoom_IsALampAsWell) {
  CompiledScene panel = test::ground(1, 0.5f);
  for (glm::vec3& p : panel.positions) p.y = 2.9f;
  panel = test::woundBack(test::withNormalsInverted(panel));
  expectTaken(SceneMaker()
                  .add("room", room(false))
                  .add("crate", crate())
                  .add("panel", panel, SceneMaker::glowing)
                  .make());
}

TEST(WoundBack, BallOfReversedTriangles_IsTurnedOnceForAll) {
  const CompiledScene ball = test::sphere(12, 1.0f, {0.0f, 1.0f, 0.0f});
  for (const auto& [mesh, share] : {std::pair{ball, 0.0}, std::pair{test::woundBack(ball), 1.0}}) {
    const LoadedScene scene = SceneMaker().add("ball", mesh).addLamp(beside).addCamera(beside).make();
    EXPECT_TRUE(normalsAgree(scene.compiled));
    EXPECT_LT(facing(scene, 0, {0.0, 1.0, 0.0}), 0.01);
    EXPECT_FALSE(drawnOnBothSides(scene, 0));
    EXPECT_NEAR(scene.scene.sides.woundBack, share, 1e-9);
    EXPECT_EQ(scene.warnings.empty(), share == 0.0);
  }
}

TEST(WoundBack, RoomOfReversedTriangles_FacesInwards) {
  const LoadedScene scene = SceneMaker()
                                .add("room", test::woundBack(room(true)))
                                .add("crate", crate())
                                .addLamp({0.3, 2.2, 0.3})
                                .addCamera({1.8, 1.5, 1.8})
                                .make();
  EXPECT_GT(facing(scene, 0, middle), 0.99);
  EXPECT_TRUE(normalsAgree(scene.compiled));
  EXPECT_FALSE(drawnOnBothSides(scene, 0));
}

TEST(WoundBack, SomeTrianglesAlone_AreTurnedAlone) {
  CompiledScene ball = test::sphere(12, 1.0f, {0.0f, 1.0f, 0.0f});
  for (std::size_t t = 0; t < ball.triangles.size(); t += 3)
    std::swap(ball.triangles[t].y, ball.triangles[t].z);
  const LoadedScene scene = SceneMaker().add("ball", ball).addLamp(beside).make();
  EXPECT_TRUE(normalsAgree(scene.compiled));
  for (std::uint32_t t = 0; t < scene.compiled.triangleCount(); ++t)
    EXPECT_EQ(scene.compiled.triangleTurns[t], t % 3 == 0 ? CornersExchanged : 0) << t;
}

/// The winding is right and the normals are inverted, as cameras and lamps show, or the closed body itself.
TEST(WoundBack, InvertedNormals_GiveWay) {
  const CompiledScene ball = test::withNormalsInverted(test::sphere(12, 1.0f, {0.0f, 1.0f, 0.0f}));
  const CompiledScene open = test::withNormalsInverted(test::ground(4, 4.0f));
  const LoadedScene scene =
      SceneMaker().add("ball", ball).add("ground", open).addLamp(beside).addCamera(beside).make();
  EXPECT_LT(facing(scene, 0, {0.0, 1.0, 0.0}), 0.01);
  EXPECT_GT(facing(scene, 1, beside), 0.99);
  EXPECT_TRUE(normalsAgree(scene.compiled));
  const LoadedScene alone = SceneMaker().add("ball", ball).make();
  EXPECT_LT(facing(alone, 0, {0.0, 1.0, 0.0}), 0.01);
  const LoadedScene within = SceneMaker()
                                 .add("room", test::withNormalsInverted(room(true)))
                                 .addLamp({0.3, 2.2, 0.3})
                                 .addCamera({1.8, 1.5, 1.8})
                                 .make();
  EXPECT_GT(facing(within, 0, middle), 0.99);
  EXPECT_TRUE(normalsAgree(within.compiled));
}

TEST(WoundBack, SceneWithoutFaults_KeepsItsArrays) {
  const LoadedScene scene = SceneMaker()
                                .add("room", room(true))
                                .add("flat", crate(), SceneMaker::oneSided, false)
                                .addLamp({0.3, 2.2, 0.3})
                                .addCamera({1.8, 1.5, 1.8})
                                .make();
  EXPECT_TRUE(scene.compiled.triangleTurns.empty());
  EXPECT_EQ(scene.compiled.materials.size(), scene.scene.materials.size() + 1);
  EXPECT_TRUE(scene.warnings.empty());
  for (const Mesh& mesh : scene.scene.meshes)
    for (const Primitive& primitive : mesh.primitives) EXPECT_TRUE(primitive.turns.empty());
}

}  // namespace
}  // namespace prelight
