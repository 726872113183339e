#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "library/open_scene.h"
#include "prelight/bake.h"
#include "prelight/load.h"
#include "prelight/refine.h"
#include "refine/shadowed_floor.h"
#include "scene/gltf/gltf_document.h"
#include "support/devices.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

RefinedScene refinedFloor(double error, std::uint64_t vertices = 1 << 16) {
  return refine(test::shadowedFloor(), {.error = error, .vertices = vertices}, &test::sharedDevice());
}

TEST(RefinedScene, Error_FallsToTheRequestedOne) {
  double before = 1.0;
  for (const double error : {0.1, 0.05, 0.025}) {
    const RefinedScene refined = refinedFloor(error);
    EXPECT_GT(refined.report.errorBefore, 0.1);
    EXPECT_LT(refined.report.error, error);
    EXPECT_LT(refined.report.error, before);
    EXPECT_FALSE(refined.report.limited);
    before = refined.report.error;
  }
}

TEST(RefinedScene, OpenFloor_StaysAsItIs) {
  const RefinedScene refined = refine(test::shadowedFloor(false), {.error = 0.01}, &test::sharedDevice());
  EXPECT_EQ(refined.report.vertices, 0u);
  EXPECT_EQ(refined.scene.compiled.triangleCount(), 2u);
  EXPECT_EQ(refined.report.errorBefore, 0.0);
}

TEST(RefinedScene, SameRequest_GivesTheSameBytes) {
  const RefinedScene one = refinedFloor(0.05), two = refinedFloor(0.05);
  EXPECT_GT(one.report.vertices, 50u);
  EXPECT_EQ(one.scene.document->bin, two.scene.document->bin);
  EXPECT_EQ(one.scene.document->json, two.scene.document->json);
}

TEST(RefinedScene, Vertices_AreAtMostAsManyAsPermitted) {
  const RefinedScene refined = refinedFloor(0.01, 100);
  EXPECT_TRUE(refined.report.limited);
  EXPECT_LE(refined.report.vertices, 100u);
  EXPECT_GT(refined.report.vertices, 20u);
}

TEST(RefinedScene, Surface_IsUnchanged) {
  const LoadedScene scene = test::shadowedFloor();
  const RefinedScene refined = refinedFloor(0.05);
  const auto areaOf = [](const CompiledScene& compiled) {
    double area = 0.0;
    for (std::uint32_t t = 0; t < compiled.triangleCount(); ++t)
      area += 0.5 * glm::length(geometricNormal(compiled, t));
    return area;
  };
  EXPECT_NEAR(areaOf(refined.scene.compiled), areaOf(scene.compiled), 1e-5);
  EXPECT_EQ(refined.scene.compiled.droppedTriangles, 0u);
}

/// AO of the middle of the floor, where vertices of two triangles know nothing of the box.
TEST(RefinedScene, Bake_HasShadows) {
  const RefinedScene refined = refinedFloor(0.05);
  const BakeResult baked =
      bake(refined.scene, {.ao = true, .effort = {.rays = 256}}, {.device = &test::sharedDevice()});
  float darkest = 1.0f, corner = 0.0f;
  const CompiledScene& scene = refined.scene.compiled;
  for (std::uint32_t v = 0; v < scene.primitives[0].vertexCount; ++v) {
    const glm::dvec3 at = scene.origin + glm::dvec3(scene.positions[v]);
    if (std::abs(at.x) < 0.5 && std::abs(at.z) < 0.5) darkest = std::min(darkest, baked.bake.ao[v]);
    if (std::abs(at.x) > 4.9 && std::abs(at.z) > 4.9) corner = std::max(corner, baked.bake.ao[v]);
  }
  // A disk of radius r at height h under the whole sky leaves h^2 / (h^2 + r^2) of the light below its
  // middle.
  EXPECT_LT(darkest, 0.09f / (0.09f + 1.0f) + 0.05f);
  EXPECT_GT(corner, 0.95f);
}

TEST(RefinedScene, SavedBake_FitsTheFile) {
  const test::TemporaryFolder folder;
  const RefinedScene refined = refinedFloor(0.1);
  const BakeResult baked =
      bake(refined.scene, {.ao = true, .effort = {.rays = 64}}, {.device = &test::sharedDevice()});
  save(folder / "baked.glb", refined.scene, baked.bake);
  const LoadedScene read = load(folder / "baked.glb");
  EXPECT_TRUE(read.warnings.empty());
  EXPECT_EQ(read.compiled.positions, refined.scene.compiled.positions);
  EXPECT_EQ(read.compiled.triangles, refined.scene.compiled.triangles);
  const auto carried = carriedBake(read);
  ASSERT_TRUE(carried);
  EXPECT_EQ(carried->info.refined, 0.1);
  EXPECT_EQ(carried->ao, baked.bake.ao);
}

/// The floor's mesh, drawn small beside the scene first and as the floor second.
TEST(RefinedScene, FloorThatIsDrawnSmallBefore_HasTheSameError) {
  GltfDocument document = *test::shadowedFloor().document;
  nlohmann::ordered_json& nodes = document.json["nodes"];
  const auto floor = std::find_if(nodes.begin(), nodes.end(), [&](const nlohmann::ordered_json& node) {
    return document.json["meshes"][node.value("mesh", 0)]["name"] == "Floor";
  });
  ASSERT_NE(floor, nodes.end());
  nlohmann::ordered_json small = *floor;
  small["scale"] = {1e-4, 1e-4, 1e-4};
  small["translation"] = {20.0, 0.0, 0.0};
  nodes.push_back(small);
  document.json["scenes"][0]["nodes"].insert(document.json["scenes"][0]["nodes"].begin(), nodes.size() - 1);
  const LoadedScene scene = loadDocument([&](Warnings&) { return document; }, {});
  const RefinedScene refined = refine(scene, {.error = 0.05}, &test::sharedDevice());
  EXPECT_GT(refined.report.vertices, 100u);
  EXPECT_NEAR(refined.report.errorBefore, refinedFloor(0.05).report.errorBefore, 0.05);
  EXPECT_LT(refined.report.error, 0.05);
}

TEST(RefinedScene, ErrorOutOfRange_IsRefused) {
  EXPECT_THROW(refine(test::shadowedFloor(), {.error = 2.0}, &test::sharedDevice()), UsageError);
}

}  // namespace
}  // namespace prelight
