#include "prelight/compiled_scene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "scene/compile/compile_parts.h"
#include "scene/lobes.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

/// One triangle in the plane z = 0, facing +Z, with one mesh node.
Scene triangleScene(const glm::dmat4& transform) {
  Scene scene;
  Primitive primitive;
  primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  primitive.normals.assign(3, glm::vec3(0, 0, 1));
  primitive.triangles = {{0, 1, 2}};
  scene.meshes.push_back({"mesh", {primitive}});
  scene.meshNodes.push_back({0, "node", 0, {transform}});
  return scene;
}

glm::dmat4 scaling(double x, double y, double z) {
  glm::dmat4 m(1.0);
  m[0][0] = x;
  m[1][1] = y;
  m[2][2] = z;
  return m;
}

CompiledScene compile(const Scene& scene) {
  Warnings warnings;
  return compileScene(scene, warnings);
}

Image solidImage(int width, int height, std::array<std::uint8_t, 4> texel) {
  Image image{"image", width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    for (const std::uint8_t channel : texel) image.rgba.push_back(channel);
  }
  return image;
}

/// Albedo of a half space of scattering particles under even light, from a particle's scattering share and
/// its mean cosine g (van de Hulst 1980, "Multiple light scattering", a fit within half a percent).
double halfSpaceAlbedo(double scattering, double g) {
  const double s = std::sqrt((1.0 - scattering) / (1.0 - scattering * g));
  return (1.0 - s) * (1.0 - 0.139 * s) / (1.0 + 1.17 * s);
}

TEST(CompileScene, MultiscatterColor_IsTheAlbedoOfAHalfSpace) {
  for (const float g : {-0.5f, 0.0f, 0.8f}) {
    Scene scene = triangleScene(glm::dmat4(1.0));
    Material material;
    material.thickness = 1.0f;
    material.attenuationColor = {0.5f, 0.25f, 0.1f};
    material.attenuationDistance = 0.2f;
    material.multiscatterColor = {0.1f, 0.5f, 0.95f};
    material.scatterAnisotropy = g;
    scene.materials = {material};
    scene.meshes[0].primitives[0].material = 0;
    const CompiledMaterial compiled = compile(scene).materials[0];
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(halfSpaceAlbedo(compiled.scattering[c], g), material.multiscatterColor[c], 0.005) << g << c;
      EXPECT_NEAR(compiled.absorption[c], -std::log(material.attenuationColor[c]) / 0.2f, 1e-4f);
    }
    material.multiscatterColor = glm::vec3(1.0f);
    scene.materials = {material};
    EXPECT_NEAR(compile(scene).materials[0].scattering.x, 1.0f, 1e-6f);
    material.multiscatterColor = glm::vec3(0.0f);
    scene.materials = {material};
    EXPECT_EQ(compile(scene).materials[0].scattering.x, 0.0f);
  }
}

TEST(CompileScene, FarFromTheOrigin_KeepsShapeExactly) {
  glm::dmat4 transform(1.0);
  transform[3] = glm::dvec4(1e7, -2e7, 3e7, 1.0);
  const CompiledScene scene = compile(triangleScene(transform));
  EXPECT_EQ(scene.origin, glm::dvec3(1e7 + 0.5, -2e7 + 0.5, 3e7));
  EXPECT_EQ(scene.positions[1], glm::vec3(0.5f, -0.5f, 0.0f));
  EXPECT_EQ(scene.boundsMin, glm::vec3(-0.5f, -0.5f, 0.0f));
  EXPECT_EQ(scene.boundsMax, glm::vec3(0.5f, 0.5f, 0.0f));
}

TEST(FlattenAnew, OfAnotherPose_IsItsCompiledScene_AndBackAgain) {
  const Scene rest = triangleScene(scaling(1, 2, 1));
  const CompiledScene first = compile(rest);
  CompiledScene scene = first;
  for (const glm::dmat4& transform : {scaling(-3, 1, 2), scaling(0, 1, 1), scaling(1, 2, 1)}) {
    const Scene posed = triangleScene(transform);
    const CompiledScene expected = compile(posed);
    flattenAnew(posed, scene);
    EXPECT_EQ(scene.origin, expected.origin);
    EXPECT_EQ(scene.positions, expected.positions);
    EXPECT_EQ(scene.normals, expected.normals);
    EXPECT_EQ(scene.triangles, expected.triangles);
    EXPECT_EQ(scene.boundsMax, expected.boundsMax);
    EXPECT_EQ(scene.primitives.size(), 1u);
  }
  EXPECT_EQ(scene.positions, first.positions);
}

TEST(CompileScene, MirroringTransform_FlipsWindingNotNormals) {
  const CompiledScene scene = compile(triangleScene(scaling(-1.0, 1.0, 1.0)));
  EXPECT_EQ(scene.normals[0], glm::vec3(0, 0, 1));
  EXPECT_GT(geometricNormal(scene, 0).z, 0.0);
}

TEST(CompileScene, NonUniformScale_UsesTheInverseTranspose) {
  Scene scene = triangleScene(scaling(1.0, 4.0, 1.0));
  scene.meshes[0].primitives[0].normals.assign(3, glm::normalize(glm::vec3(1, 1, 0)));
  const glm::vec3 normal = compile(scene).normals[0];
  EXPECT_NEAR(normal.y / normal.x, 0.25f, 1e-6f);
}

TEST(CompileScene, FlatteningScale_StillHasANormal) {
  EXPECT_EQ(compile(triangleScene(scaling(1.0, 1.0, 0.0))).normals[0], glm::vec3(0, 0, 1));
}

TEST(CompileScene, NoNormals_AreFlatWithAreaWeightedMeans) {
  Scene scene = triangleScene(glm::dmat4(1.0));
  Primitive& primitive = scene.meshes[0].primitives[0];
  primitive.normals.clear();
  primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -3}, {9, 9, 9}};
  primitive.triangles = {{0, 1, 2}, {0, 3, 1}};  // +Z with area 1/2, -Y with area 3/2.
  const CompiledScene compiled = compile(scene);
  EXPECT_EQ(compiled.triangleFlat, (std::vector<std::uint8_t>{1, 1}));
  EXPECT_EQ(compiled.normals[2], glm::vec3(0, 0, 1));
  EXPECT_NEAR(compiled.normals[0].y, -3.0f / std::sqrt(10.0f), 1e-6f);
  EXPECT_NEAR(compiled.normals[0].z, 1.0f / std::sqrt(10.0f), 1e-6f);
  EXPECT_EQ(compiled.normals[4], glm::vec3(0, 1, 0)) << "an unused vertex";
}

TEST(CompileScene, DegenerateTriangles_AreCountedAndDropped) {
  Scene scene = triangleScene(glm::dmat4(1.0));
  scene.meshes[0].primitives[0].triangles = {{0, 0, 1}, {0, 1, 2}, {2, 2, 2}};
  Warnings warnings;
  const CompiledScene compiled = compileScene(scene, warnings);
  EXPECT_EQ(compiled.droppedTriangles, 2u);
  EXPECT_EQ(compiled.triangleCount(), 1u);
  EXPECT_EQ(compiled.primitives[0].triangleCount, 1u);
  EXPECT_EQ(compiled.triangleMaterials.size(), 1u);
  EXPECT_EQ(warnings.size(), 1u);
}

TEST(CompileScene, BeyondFloat_ThrowsNamingTheNode) {
  Scene scene = triangleScene(scaling(1e300, 1.0, 1.0));
  const std::string message = test::inputErrorOf([&] { compile(scene); });
  EXPECT_NE(message.find("/nodes/0"), std::string::npos) << message;
}

/// Squares of larger coordinates overflow float, and would make a bake non-finite.
TEST(CompileScene, BeyondMeasure_ThrowsNamingTheNode) {
  EXPECT_EQ(compile(triangleScene(scaling(1e14, 1.0, 1.0))).triangleCount(), 1u);
  const std::string message = test::inputErrorOf([&] { compile(triangleScene(scaling(1e38, 1.0, 1.0))); });
  EXPECT_NE(message.find("/nodes/0"), std::string::npos) << message;
  EXPECT_NE(message.find("within 1e+15 m"), std::string::npos) << message;
}

TEST(CompileScene, PointsPrimitive_HasARangeWithoutVertices) {
  Scene scene = triangleScene(glm::dmat4(1.0));
  Primitive points;
  points.positions = {{0, 0, 0}};
  scene.meshes[0].primitives.insert(scene.meshes[0].primitives.begin(), points);
  const CompiledScene compiled = compile(scene);
  ASSERT_EQ(compiled.primitives.size(), 2u);
  EXPECT_EQ(compiled.primitives[0].vertexCount, 0u);
  EXPECT_EQ(compiled.primitives[1].primitive, 1);
  EXPECT_EQ(compiled.vertexCount(), 3u);
}

TEST(CompileScene, SomeColors_FillTheOthersWithWhite) {
  Scene scene = triangleScene(glm::dmat4(1.0));
  EXPECT_FALSE(compile(scene).hasVertexColors());
  scene.meshes[0].primitives.push_back(scene.meshes[0].primitives[0]);
  scene.meshes[0].primitives[1].colors.assign(3, glm::vec4(0.5f));
  const CompiledScene compiled = compile(scene);
  ASSERT_EQ(compiled.colors.size(), 6u);
  EXPECT_EQ(compiled.colors[0], glm::vec4(1.0f));
  EXPECT_EQ(compiled.colors[5], glm::vec4(0.5f));
}

TEST(CompileScene, WhiteColors_AreNone) {
  Scene scene = triangleScene(glm::dmat4(1.0));
  Primitive& primitive = scene.meshes[0].primitives[0];
  primitive.colors.assign(3, glm::vec4(1.0f));
  EXPECT_FALSE(compile(scene).hasVertexColors());
  primitive.colors[1].a = 0.5f;
  EXPECT_TRUE(compile(scene).hasVertexColors());
}

TEST(CompileScene, DefaultMaterial_IsLastAndBlackMetal) {
  const CompiledScene compiled = compile(triangleScene(glm::dmat4(1.0)));
  ASSERT_EQ(compiled.materials.size(), 1u);
  EXPECT_EQ(compiled.triangleMaterials[0], 0u);
  EXPECT_EQ(compiled.materials[0].albedo, glm::vec3(0.0f));  // glTF's default material is a metal.
}

/// A base colour, metalness and roughness with means of 1/2 and 1/4, and an emissive texture.
Scene texturedScene() {
  Scene scene;
  Image surface = solidImage(4, 1, {0, 0, 0, 255});
  surface.rgba[1] = surface.rgba[2] = surface.rgba[6] = 255;  // G of one texel of four, B of two.
  Image emissive = solidImage(2, 1, {255, 255, 255, 255});
  emissive.rgba[4] = emissive.rgba[5] = emissive.rgba[6] = 0;
  scene.images = {solidImage(1, 1, {255, 128, 0, 255}), surface, emissive};
  Material material;
  material.name = "painted";
  material.metallic = 0.8f;
  material.roughness = 0.6f;
  material.emission = glm::vec3(4.0f);
  material.baseColorTexture.image = 0;
  material.metallicRoughnessTexture.image = 1;
  material.emissiveTexture.image = 2;
  scene.materials = {material};
  return scene;
}

CompiledMaterial compiledOf(const Scene& scene) { return compileMaterials(scene).at(0); }

TEST(CompileMaterials, Textures_StayWhereTheFileLaysThem) {
  Scene scene = texturedScene();
  TextureRef& surface = scene.materials[0].metallicRoughnessTexture;
  surface.texCoord = 1;
  surface.transform[2] = {0.25f, 0.0f, 1.0f};
  surface.wrapS = WrapMode::ClampToEdge;
  surface.filter = TextureFilter::Nearest;
  const CompiledMaterial material = compiledOf(scene);
  EXPECT_EQ(material.albedo, glm::vec3(1.0f)) << "metalness is in its texture";
  EXPECT_EQ(material.metallic, 0.8f);
  EXPECT_EQ(material.roughness, 0.6f);
  EXPECT_EQ(material.surfaceTexture.image, 1);
  EXPECT_EQ(material.surfaceTexture.texCoord, 1);
  EXPECT_EQ(material.surfaceTexture.transform, surface.transform);
  EXPECT_EQ(material.surfaceTexture.wrapS, WrapMode::ClampToEdge);
  EXPECT_EQ(material.surfaceTexture.filter, TextureFilter::Nearest);
  EXPECT_EQ(material.emission, glm::vec3(4.0f));
  EXPECT_EQ(material.emissionTexture.image, 2);
}

TEST(CompileMaterials, TexturesOfFactorsThatAreZero_HaveNoPartInTheAlbedo) {
  Scene scene = texturedScene();
  Material& material = scene.materials[0];
  material.metallic = 0.0f;
  material.transmissionTexture.image = 1;
  const auto images = [&] {
    std::vector<int> result;
    for (const TextureRef& texture : compiledOf(scene).albedoTextures()) result.push_back(texture.image);
    return result;
  };
  EXPECT_EQ(images(), (std::vector<int>{0, -1, -1}));
  material.metallic = material.transmission = 0.5f;
  EXPECT_EQ(images(), (std::vector<int>{0, 1, 1}));
  material.baseColor = {0, 0, 0, 1};
  EXPECT_EQ(images(), (std::vector<int>{-1, -1, -1})) << "black all over";
  material.alphaMode = AlphaMode::Mask;
  material.baseColor.a = 0.1f;
  EXPECT_EQ(images(), (std::vector<int>{0, -1, -1})) << "but for the holes";
}

TEST(CompileScene, SetsOfTextureCoordinates_AreThoseAskedFor) {
  Scene scene = triangleScene(glm::dmat4(1.0));
  Primitive& primitive = scene.meshes[0].primitives[0];
  primitive.texCoords0 = {{0, 0}, {1, 0}, {0, 1}};
  primitive.texCoords1 = {{3, 0}, {4, 0}, {3, 1}};
  EXPECT_TRUE(compile(scene).texCoords.empty()) << "glTF's default material has no texture";

  scene.images = {solidImage(1, 1, {1, 2, 3, 255}), solidImage(1, 1, {4, 5, 6, 255})};
  scene.materials.resize(2);
  scene.materials[0].metallic = 0.0f;
  scene.materials[0].baseColorTexture.image = 0;
  scene.materials[1] = scene.materials[0];
  scene.materials[1].baseColorTexture = {1, 1};
  primitive.material = 0;
  CompiledScene compiled = compile(scene);
  EXPECT_EQ(compiled.texCoords, primitive.texCoords0);
  EXPECT_TRUE(compiled.texCoords1.empty()) << "only a material that nothing has asks for them";
  ASSERT_EQ(compiled.images.size(), 2u);
  EXPECT_EQ(compiled.images[0].rgba.size(), 4u);
  EXPECT_TRUE(compiled.images[1].rgba.empty()) << "nothing shows it";

  primitive.material = 1;
  primitive.texCoords1[2].x = std::numeric_limits<float>::infinity();
  compiled = compile(scene);
  ASSERT_EQ(compiled.texCoords1.size(), 3u);
  EXPECT_EQ(compiled.texCoords1[1], glm::vec2(4, 0));
  EXPECT_EQ(compiled.texCoords1[2], glm::vec2(0, 0)) << "no number";
}

TEST(CompileMaterials, DiffuseTransmission_CountsWithTheMeansOfItsTextures) {
  Scene scene;
  Image shares = solidImage(2, 1, {0, 0, 0, 255});
  shares.rgba[7] = 0;
  Image colors = solidImage(2, 1, {255, 255, 255, 255});
  colors.rgba[4] = 0;
  scene.images = {shares, colors};
  Material material;
  material.metallic = 0.0f;
  material.baseColor = {0.4f, 0.4f, 0.4f, 1.0f};
  material.transmission = 0.5f;
  material.diffuseTransmission = 0.8f;
  material.diffuseTransmissionTexture.image = 0;
  material.diffuseTransmissionColor = {1.0f, 0.5f, 0.25f};
  material.diffuseTransmissionColorTexture.image = 1;
  scene.materials = {material};
  const CompiledMaterial compiled = compiledOf(scene);
  const glm::dvec3 through = 0.4 * 0.5 * glm::dvec3(0.5, 0.5, 0.25);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(compiled.albedo[c], 0.4 * 0.5 * (1.0 - 0.4), 1e-6);
    EXPECT_NEAR(compiled.diffuseTransmission[c], through[c], 1e-6);
  }
  EXPECT_NEAR(compiled.meanTranslucency, 0.4f, 1e-6f);
  EXPECT_EQ(compiled.translucency, 0.8f) << "whose texture multiplies it where light is followed";
}

TEST(Lobes, FactorsThatATextureMultiplies_MayBeAnything) {
  Material lamp;  // Metalness times a texture of 0 makes it glass.
  lamp.transmission = 1.0f;
  Scene scene;
  scene.images = {solidImage(1, 1, {0, 0, 0, 255})};
  scene.materials = {lamp};
  EXPECT_FALSE(isGlass(compiledOf(scene)));
  scene.materials[0].metallicRoughnessTexture.image = 0;
  EXPECT_TRUE(isGlass(compiledOf(scene)));
  scene.materials[0].metallic = 0.0f;
  EXPECT_FALSE(reflectsSpecularly(compiledOf(scene))) << "glass all over";
  scene.materials[0].transmissionTexture.image = 0;
  EXPECT_TRUE(reflectsSpecularly(compiledOf(scene)));
}

TEST(CompileMaterials, AlphaModes_BecomeCutoffs) {
  Scene scene;
  scene.materials.resize(3);
  scene.materials[1].alphaMode = AlphaMode::Mask;
  scene.materials[1].alphaCutoff = 0.25f;
  scene.materials[2].alphaMode = AlphaMode::Blend;
  for (Material& material : scene.materials) material.baseColor.a = 0.2f;
  const auto materials = compileMaterials(scene);
  EXPECT_LT(materials[0].alphaCutoff, 0.0f);
  EXPECT_EQ(materials[1].alphaCutoff, 0.25f);
  EXPECT_GE(materials[2].alphaCutoff, 0.0f);
  EXPECT_TRUE(materials[2].blended);
  EXPECT_FALSE(materials[1].blended);
}

/// A masked material with a texture of two texels, and a triangle whose vertices have an alpha.
Scene maskedScene(float factor, std::uint8_t texel, float vertex) {
  Scene scene;
  scene.images = {{"two texels", 2, 1, {255, 255, 255, 255, 255, 255, 255, texel}}};
  Material& material = scene.materials.emplace_back();
  material.alphaMode = AlphaMode::Mask;
  material.baseColor.a = factor;
  material.baseColorTexture.image = 0;
  Primitive primitive;
  primitive.material = 0;
  primitive.colors = {glm::vec4(1.0f), glm::vec4(1.0f), glm::vec4(1.0f, 1.0f, 1.0f, vertex)};
  scene.meshes = {{"triangle", {primitive}}};
  return scene;
}

TEST(CompileMaterials, MaskThatNoPointFallsBelow_IsOpaque) {
  const auto cutoff = [](const Scene& scene) { return compiledOf(scene).alphaCutoff; };
  EXPECT_LT(cutoff(maskedScene(1.0f, 255, 1.0f)), 0.0f);
  EXPECT_LT(cutoff(maskedScene(0.9f, 204, 0.8f)), 0.0f);  // 0.576 at least.
  EXPECT_EQ(cutoff(maskedScene(0.4f, 255, 1.0f)), 0.5f);
  EXPECT_EQ(cutoff(maskedScene(1.0f, 100, 1.0f)), 0.5f);
  EXPECT_EQ(cutoff(maskedScene(1.0f, 255, 0.4f)), 0.5f);
  // 0.448, although each of the three factors is above the cutoff.
  EXPECT_EQ(cutoff(maskedScene(0.8f, 204, 0.7f)), 0.5f);
}

TEST(Srgb, EveryByte_SurvivesTheRoundTrip) {
  for (int i = 0; i < 256; ++i) EXPECT_EQ(srgbFromLinear(linearFromSrgb(static_cast<std::uint8_t>(i))), i);
}

/// One triangle mesh drawn by several nodes, one per transform.
Scene drawings(const std::vector<glm::dmat4>& transforms) {
  Scene scene = triangleScene(transforms[0]);
  for (std::size_t i = 1; i < transforms.size(); ++i)
    scene.meshNodes.push_back({static_cast<int>(i), "node", 0, {transforms[i]}});
  return scene;
}

TEST(CompileScene, MeshDrawnTwice_IsAShapeWhoseInstancesAreWhereItIsDrawn) {
  glm::dmat4 far = scaling(2.0, 1.0, 0.5);
  far[3] = glm::dvec4(1e7, 20.0, -30.0, 1.0);
  const CompiledScene scene = compile(drawings({scaling(3.0, 3.0, 3.0), far}));
  ASSERT_EQ(scene.shapes.size(), 1u);
  ASSERT_EQ(scene.instances.size(), 2u);
  const CompiledShape& shape = scene.shapes[0];
  EXPECT_EQ(shape.triangleCount, 1u);
  ASSERT_EQ(shape.positions.size(), 3u);
  for (const CompiledInstance& instance : scene.instances)
    for (std::uint32_t v = 0; v < 3; ++v) {
      const glm::dvec3 there(instance.toWorld * glm::dvec4(glm::dvec3(shape.positions[v]), 1.0));
      EXPECT_LT(glm::distance(there, glm::dvec3(scene.positions[instance.firstVertex + v])), 1.0);
      // Between its corners the shape keeps the precision that floats far from the centre lose.
      const glm::dvec3 first(instance.toWorld * glm::dvec4(glm::dvec3(shape.positions[0]), 1.0));
      const glm::dmat4 drawn = &instance == &scene.instances[0] ? scaling(3.0, 3.0, 3.0) : far;
      const glm::dvec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
      EXPECT_LT(glm::distance(there - first, glm::dmat3(drawn) * corners[v]), 1e-7);
    }
}

TEST(CompileScene, DrawingsThatDiffer_AreNoInstances) {
  const glm::dmat4 plain(1.0);
  EXPECT_TRUE(compile(drawings({plain})).shapes.empty());
  // A mirrored triangle has reversed corners; a flattened one has no inverse transform.
  EXPECT_TRUE(compile(drawings({plain, scaling(-1.0, 1.0, 1.0)})).shapes.empty());
  EXPECT_TRUE(compile(drawings({plain, scaling(1.0, 1.0, 0.0)})).shapes.empty());
  EXPECT_TRUE(compile(drawings({plain, scaling(1.0, 1.0, 1e-4)})).shapes.empty());
  EXPECT_EQ(compile(drawings({plain, scaling(-1.0, 1.0, 1.0), plain, scaling(-2.0, 1.0, 1.0)})).shapes.size(),
            2u);
  // One triangle of the mesh vanishes in one of the two drawings.
  Scene scene = drawings({plain, scaling(1e-3, 1e-3, 1e-3)});
  Primitive& primitive = scene.meshes[0].primitives[0];
  primitive.positions.insert(primitive.positions.end(), {{0, 0, 0}, {1e-5f, 0, 0}, {0, 1e-5f, 0}});
  primitive.triangles.push_back({3, 4, 5});
  primitive.normals.clear();
  const CompiledScene compiled = compile(scene);
  ASSERT_EQ(compiled.triangleCount(), 3u);
  EXPECT_TRUE(compiled.shapes.empty());
}

TEST(CompileScene, InstancesOfOneNode_HaveAllPrimitivesOfTheMesh) {
  Scene scene = triangleScene(glm::dmat4(1.0));
  scene.meshes[0].primitives.push_back(scene.meshes[0].primitives[0]);
  scene.meshes[0].primitives[1].triangles.push_back({0, 2, 1});
  scene.meshNodes[0].transforms = {glm::dmat4(1.0), scaling(2.0, 2.0, 2.0), scaling(3.0, 1.0, 1.0)};
  const CompiledScene compiled = compile(scene);
  ASSERT_EQ(compiled.shapes.size(), 1u);
  EXPECT_EQ(compiled.shapes[0].triangleCount, 3u);
  EXPECT_EQ(compiled.shapes[0].vertexCount, 6u);
  ASSERT_EQ(compiled.instances.size(), 3u);
  EXPECT_EQ(compiled.instances[2].firstTriangle, 6u);
  EXPECT_EQ(compiled.instances[2].firstVertex, 12u);
}

}  // namespace
}  // namespace prelight
