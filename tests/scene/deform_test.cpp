#include "scene/deform.h"

#include <gtest/gtest.h>

#include <cmath>

#include "prelight/compiled_scene.h"
#include "scene/pose.h"
#include "support/bent_bar.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

void expectClose(const glm::dvec3& got, const glm::dvec3& expected) {
  EXPECT_LT(glm::length(got - expected), 1e-6) << got.x << ' ' << got.y << ' ' << got.z;
}

glm::dvec3 worldOf(const CompiledScene& scene, std::size_t vertex) {
  return scene.origin + glm::dvec3(scene.positions[vertex]);
}

CompiledScene compiledAt(const GltfDocument& document, double seconds) {
  Warnings warnings;
  CompiledScene scene = compileScene(sceneAt(test::reload(document, warnings), 0, seconds), warnings);
  EXPECT_TRUE(warnings.empty()) << warnings.front();
  return scene;
}

TEST(Skins, BarAtRest_StandsAsItWasBound) {
  Warnings warnings;
  const CompiledScene scene = test::recompile(test::bentBar(), warnings);
  EXPECT_TRUE(warnings.empty()) << warnings.front();
  for (std::size_t v = 0; v < test::barPositions().size(); ++v) {
    expectClose(worldOf(scene, v), glm::dvec3(test::barPositions()[v]));
    expectClose(glm::dvec3(scene.normals[v]), {1, 0, 0});
  }
}

/// The upper joint, at a height of 1 m, turns a quarter about z. Vertices on it alone turn about (0, 1).
/// Vertices that weigh both joints equally are transformed by the mean of the two matrices, a turn of 45
/// degrees scaled by half of the square root of 2.
TEST(Skins, BarBentByAQuarter_IsTheClosedForm) {
  const CompiledScene scene = compiledAt(test::bentBar(), 1.0);
  const double root = std::sqrt(0.5);
  for (std::size_t v = 0; v < test::barPositions().size(); ++v) {
    const glm::dvec3 p(test::barPositions()[v]);
    if (p.y < 0.5) {
      expectClose(worldOf(scene, v), p);
      expectClose(glm::dvec3(scene.normals[v]), {1, 0, 0});
    } else if (p.y > 1.5) {
      expectClose(worldOf(scene, v), {1.0 - p.y, 1.0 + p.x, p.z});
      expectClose(glm::dvec3(scene.normals[v]), {0, 1, 0});
    } else {
      expectClose(worldOf(scene, v), {p.x / 2, 1.0 + p.x / 2, p.z});
      expectClose(glm::dvec3(scene.normals[v]), {root, root, 0});
    }
  }
}

TEST(Skins, PlaceOfTheMeshNode_DoesNotMatter) {
  GltfDocument document = test::bentBar();
  const CompiledScene plain = compiledAt(document, 0.5);
  document.json["nodes"][2]["translation"] = {5, 6, 7};
  document.json["nodes"][2]["scale"] = {-2, 3, 1};
  const CompiledScene moved = compiledAt(document, 0.5);
  EXPECT_EQ(moved.positions, plain.positions);
  EXPECT_EQ(moved.normals, plain.normals);
  EXPECT_EQ(moved.triangles, plain.triangles);
}

TEST(Skins, SecondSetOfJoints_CountsLikeTheFirst) {
  GltfDocument document = test::bentBar();
  const CompiledScene one = compiledAt(document, 1.0);
  auto& attributes = document.json["meshes"][0]["primitives"][0]["attributes"];
  const std::size_t vertices = test::barPositions().size();
  // Moves the weight of the upper joint to the second set.
  std::vector<float> first, second;
  std::vector<std::uint8_t> joints;
  for (const glm::vec3& p : test::barPositions()) {
    const float upper = p.y / 2.0f;
    first.insert(first.end(), {1.0f - upper, 0, 0, 0});
    second.insert(second.end(), {0, 0, upper, 0});
    joints.insert(joints.end(), {0, 0, 1, 0});
  }
  attributes["WEIGHTS_0"] = test::appendFloats(document, first, "VEC4");
  attributes["WEIGHTS_1"] = test::appendFloats(document, second, "VEC4");
  attributes["JOINTS_1"] = test::appendBytes(document, joints, "VEC4", vertices, 5121);
  EXPECT_EQ(compiledAt(document, 1.0).positions, one.positions);
}

TEST(Skins, StretchedJoint_TurnsNormalsByTheInverseTranspose) {
  GltfDocument document = test::bentBar();
  document.json["nodes"][0]["scale"] = {1, 2, 1};
  const float half = std::sqrt(0.5f);
  std::vector<float> normals;
  for (std::size_t v = 0; v < test::barPositions().size(); ++v)
    normals.insert(normals.end(), {half, half, 0});
  document.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
      test::appendFloats(document, normals, "VEC3");
  Warnings warnings;
  const CompiledScene scene = test::recompile(document, warnings);
  expectClose(glm::dvec3(scene.normals[0]), glm::normalize(glm::dvec3(1.0, 0.5, 0.0)));
}

TEST(Skins, MirroringSkeleton_KeepsFacesAndNormalsOnTheSameSide) {
  GltfDocument document = test::bentBar();
  document.json["nodes"][0]["scale"] = {-1, 1, 1};
  Warnings warnings;
  const CompiledScene scene = test::recompile(document, warnings);
  expectClose(worldOf(scene, 0), glm::dvec3(-test::barPositions()[0].x, test::barPositions()[0].y, 0));
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    EXPECT_GT(glm::dot(geometricNormal(scene, t), glm::dvec3(0, 0, 1)), 0.0);
}

/// Normal +x, tangent +y, bitangent +z. After mirroring in x the bitangent must stay, although n x t is
/// reversed.
TEST(Skins, MirroringSkeleton_KeepsTheBitangentOnItsSide) {
  GltfDocument document = test::bentBar();
  document.json["nodes"][0]["scale"] = {-1, 1, 1};
  std::vector<float> tangents;
  for (std::size_t v = 0; v < test::barPositions().size(); ++v) tangents.insert(tangents.end(), {0, 1, 0, 1});
  document.json["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] =
      test::appendFloats(document, tangents, "VEC4");
  Warnings warnings;
  const Scene scene = test::reload(document, warnings);
  const Primitive bent = deformedMesh(scene, scene.meshNodes[0]).mesh.primitives[0];
  const glm::dvec3 normal(bent.normals[0]), tangent(bent.tangents[0]);
  expectClose(normal, {-1, 0, 0});
  expectClose(tangent, {0, 1, 0});
  expectClose(double(bent.tangents[0].w) * glm::cross(normal, tangent), {0, 0, 1});
}

TEST(Skins, TwoNodesOfOneMesh_AreTwoShapes) {
  GltfDocument document = test::bentBar();
  document.json["nodes"].push_back({{"mesh", 0}, {"skin", 0}});
  document.json["scenes"][0]["nodes"].push_back(3);
  EXPECT_TRUE(compiledAt(document, 1.0).instances.empty());
  document.json["nodes"][2].erase("skin");
  document.json["nodes"][3].erase("skin");
  EXPECT_EQ(compiledAt(document, 1.0).instances.size(), 2u);
}

/// A triangle with one target, which moves the corners twice as far out, tilts their normals, and changes the
/// other attributes.
GltfDocument morphedTriangle() {
  GltfDocument document = test::triangleDocument();
  auto& primitive = document.json["meshes"][0]["primitives"][0];
  primitive["attributes"]["COLOR_0"] =
      test::appendFloats(document, {1, 1, 1, 1, 0.5f, 0.5f, 0.5f, 1, 0, 0, 0, 1}, "VEC4");
  primitive["attributes"]["TEXCOORD_0"] = test::appendFloats(document, {0, 0, 1, 0, 0, 1}, "VEC2");
  Json target;
  target["POSITION"] = test::appendFloats(document, {0, 0, 1, 0, 0, 2, 0, 0, 4}, "VEC3");
  target["NORMAL"] = test::appendFloats(document, {0, 1, -1, 0, 0, 0, 1, 0, 0}, "VEC3");
  target["COLOR_0"] = test::appendFloats(document, {0, 0, -1, 0, 0.25f, 0, 0, 0, 2, 0, 0, 0}, "VEC4");
  target["TEXCOORD_0"] = test::appendFloats(document, {0, 0, 2, 1, 0, 0}, "VEC2");
  primitive["targets"] = Json::array({target});
  return document;
}

TEST(Morphs, WeightsOfMeshAndNode_AddTheTarget) {
  GltfDocument document = morphedTriangle();
  Warnings warnings;
  EXPECT_EQ(worldOf(test::recompile(document, warnings), 2).z, 0.0) << "weights are 0 where none are given";
  document.json["meshes"][0]["weights"] = {0.5};
  expectClose(worldOf(test::recompile(document, warnings), 2), {0, 1, 2});
  document.json["nodes"][0]["weights"] = {1.0};
  const CompiledScene scene = test::recompile(document, warnings);
  expectClose(worldOf(scene, 0), {0, 0, 1});
  expectClose(worldOf(scene, 1), {1, 0, 2});
  expectClose(worldOf(scene, 2), {0, 1, 4});
  expectClose(glm::dvec3(scene.normals[0]), {0, 1, 0});
  expectClose(glm::dvec3(scene.normals[1]), {0, 0, 1});
  expectClose(glm::dvec3(scene.normals[2]), glm::normalize(glm::dvec3(1, 0, 1)));
  EXPECT_EQ(scene.colors[0], glm::vec4(1, 1, 0, 1));
  EXPECT_EQ(scene.colors[1], glm::vec4(0.75f, 0.5f, 0.5f, 1));
  EXPECT_EQ(scene.colors[2], glm::vec4(1, 0, 0, 1)) << "colours are kept within 0..1";
  EXPECT_TRUE(warnings.empty()) << warnings.front();
}

TEST(Morphs, TextureCoordinates_MoveToo) {
  GltfDocument document = morphedTriangle();
  document.json["nodes"][0]["weights"] = {0.5};
  Warnings warnings;
  const Scene scene = test::reload(document, warnings);
  const DeformedMesh mesh = deformedMesh(scene, scene.meshNodes[0]);
  EXPECT_EQ(mesh.mesh.primitives[0].texCoords0, (std::vector<glm::vec2>{{0, 0}, {2, 0.5f}, {0, 1}}));
}

TEST(Morphs, TangentsOfTargets_KeepTheirSign) {
  GltfDocument document = test::triangleDocument();
  auto& primitive = document.json["meshes"][0]["primitives"][0];
  primitive["attributes"]["TANGENT"] =
      test::appendFloats(document, {1, 0, 0, -1, 1, 0, 0, -1, 1, 0, 0, -1}, "VEC4");
  primitive["targets"] =
      Json::array({{{"TANGENT", test::appendFloats(document, {-1, 1, 0, 0, 1, 0, 0, 0, 0}, "VEC3")}}});
  document.json["nodes"][0]["weights"] = {1.0};
  Warnings warnings;
  const Scene scene = test::reload(document, warnings);
  const auto tangents = deformedMesh(scene, scene.meshNodes[0]).mesh.primitives[0].tangents;
  expectClose(glm::dvec3(tangents[0]), {0, 1, 0});
  expectClose(glm::dvec3(tangents[1]), glm::normalize(glm::dvec3(1, 1, 0)));
  for (const glm::vec4& tangent : tangents) EXPECT_EQ(tangent.w, -1.0f);
  EXPECT_TRUE(warnings.empty()) << warnings.front();
}

TEST(Morphs, SparseAndNormalisedTargets_AreRead) {
  GltfDocument document = test::triangleDocument();
  const int indices = test::appendBytes(document, {2}, "SCALAR", 1, 5121);
  const int values = test::appendFloats(document, {0, 0, 3}, "VEC3");
  const auto viewOf = [&](int accessor) {
    return document.json["accessors"][static_cast<std::size_t>(accessor)]["bufferView"];
  };
  document.json["accessors"].push_back(
      {{"componentType", 5126},
       {"count", 3},
       {"type", "VEC3"},
       {"sparse",
        {{"count", 1},
         {"indices", {{"bufferView", viewOf(indices)}, {"componentType", 5121}}},
         {"values", {{"bufferView", viewOf(values)}}}}}});
  const std::size_t sparse = document.json["accessors"].size() - 1;
  // Signed bytes, padded to 4 per element: 127 is 1, and -128 is -1.
  const int bytes = test::appendBytes(document, {127, 0, 0, 0, 0, 0x80, 0, 0, 0, 0, 0, 0}, "VEC3", 3, 5120);
  auto& accessor = document.json["accessors"][static_cast<std::size_t>(bytes)];
  accessor["normalized"] = true;
  document.json["bufferViews"][accessor["bufferView"].get<std::size_t>()]["byteStride"] = 4;
  document.json["extensionsUsed"] = {"KHR_mesh_quantization"};
  document.json["meshes"][0]["primitives"][0]["targets"] =
      Json::array({{{"POSITION", sparse}}, {{"POSITION", bytes}}});
  document.json["nodes"][0]["weights"] = {1.0, 2.0};
  Warnings warnings;
  const CompiledScene scene = test::recompile(document, warnings);
  expectClose(worldOf(scene, 0), {2, 0, 0});
  expectClose(worldOf(scene, 1), {1, -2, 0});
  expectClose(worldOf(scene, 2), {0, 1, 3});
}

TEST(Morphs, NodesOfTheSameWeights_ShareAShape) {
  GltfDocument document = morphedTriangle();
  document.json["nodes"][0]["weights"] = {0.5};
  for (const double weight : {0.5, 0.25})
    document.json["nodes"].push_back({{"mesh", 0}, {"weights", {weight}}, {"translation", {weight, 0, 0}}});
  document.json["scenes"][0]["nodes"] = {0, 1, 2};
  Warnings warnings;
  const CompiledScene scene = test::recompile(document, warnings);
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instances[0].firstTriangle, 0u);
  EXPECT_EQ(scene.instances[1].firstTriangle, 1u);
}

}  // namespace
}  // namespace prelight
