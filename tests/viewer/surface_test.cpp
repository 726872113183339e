// Appearance of surfaces: textures, colours, holes, facing, blending, sky.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "prelight/error.h"
#include "viewer/quad_scene.h"

namespace prelight {
namespace {

using namespace test;
using viewer::Shading;

using std::numbers::pi;

void expectNear(const glm::vec3& got, const glm::vec3& expected, float tolerance) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], expected[c], tolerance) << "channel " << c;
}

Material unlit(const glm::vec4& color) {
  Material material;
  material.baseColor = color;
  material.unlit = true;
  return material;
}

/// Four texels: red, green; blue, white. With `holes`, alpha is 0 on the left.
Image fourColors(bool holes) {
  const std::uint8_t left = holes ? 0 : 255;
  return {"four", 2, 2, {255, 0, 0, left, 0, 255, 0, 255, 0, 0, 255, left, 255, 255, 255, 255}};
}

QuadScene texturedQuad(Material material, bool holes) {
  QuadScene quad;
  quad.scene.images = {fourColors(holes)};
  material.baseColorTexture.image = 0;
  material.baseColorTexture.wrapS = material.baseColorTexture.wrapT = WrapMode::ClampToEdge;
  quad.add(material);
  quad.lookFrom({0, 0, 2.5}, {0, 0, 0});
  return quad;
}

TEST(Surface, Texture_FirstTexel_IsAtTheUpperLeft) {
  QuadScene quad = texturedQuad(unlit(glm::vec4(1)), false);
  quad.compile();
  const Picture picture = quad.render(square(Shading::Phong, 64));
  expectNear(pixelAt(picture, 0.2, 0.2), {1, 0, 0}, 1e-3f);
  expectNear(pixelAt(picture, 0.8, 0.2), {0, 1, 0}, 1e-3f);
  expectNear(pixelAt(picture, 0.2, 0.8), {0, 0, 1}, 1e-3f);
  expectNear(pixelAt(picture, 0.8, 0.8), {1, 1, 1}, 1e-3f);
}

TEST(Surface, TextureTransform_HalfTurn_SwapsTheCorners) {
  QuadScene quad = texturedQuad(unlit(glm::vec4(1)), false);
  quad.scene.materials[0].baseColorTexture.transform = glm::mat3(-1, 0, 0, 0, -1, 0, 1, 1, 1);
  quad.compile();
  const Picture picture = quad.render(square(Shading::Phong, 64));
  expectNear(pixelAt(picture, 0.2, 0.2), {1, 1, 1}, 1e-3f);
  expectNear(pixelAt(picture, 0.8, 0.8), {1, 0, 0}, 1e-3f);
}

TEST(Surface, SecondSetOfCoordinates_IsTheTextures) {
  QuadScene quad = texturedQuad(unlit(glm::vec4(1)), false);
  quad.scene.materials[0].baseColorTexture.texCoord = 1;
  Primitive& primitive = quad.scene.meshes[0].primitives[0];
  for (const glm::vec2& uv : primitive.texCoords0) primitive.texCoords1.emplace_back(1.0f - uv.x, uv.y);
  quad.compile();
  const Picture picture = quad.render(square(Shading::Phong, 64));
  expectNear(pixelAt(picture, 0.2, 0.2), {0, 1, 0}, 1e-3f);
  expectNear(pixelAt(picture, 0.8, 0.8), {0, 0, 1}, 1e-3f);
}

TEST(Surface, NearestFilter_DoesNotMixTexels) {
  QuadScene quad = texturedQuad(unlit(glm::vec4(1)), false);
  quad.compile();
  EXPECT_GT(pixelAt(quad.render(square(Shading::Phong, 64)), 0.42, 0.3).y, 0.1f);
  quad.scene.materials[0].baseColorTexture.filter = TextureFilter::Nearest;
  quad.compile();
  expectNear(pixelAt(quad.render(square(Shading::Phong, 64)), 0.42, 0.3), {1, 0, 0}, 1e-3f);
}

/// Glass shows none of its base colour's diffuse light.
TEST(Surface, TransmissionTexture_SaysWhereItIsGlass) {
  Material material;
  material.metallic = 0.0f;
  material.specular = 0.0f;
  material.transmission = 1.0f;
  material.transmissionTexture.image = 0;
  material.transmissionTexture.wrapS = material.transmissionTexture.wrapT = WrapMode::ClampToEdge;
  QuadScene quad;
  quad.scene.images = {{"left", 2, 1, {0, 0, 0, 255, 255, 0, 0, 255}}};
  quad.add(material);
  quad.lookFrom({0, 0, 2.5}, {0, 0, 0});
  quad.scene.lights = {makeLight(LightType::Directional, glm::vec3(2), {})};
  quad.compile();
  const Picture picture = quad.render(square(Shading::Phong, 64));
  expectNear(pixelAt(picture, 0.2, 0.5), glm::vec3(2.0f / 3.14159265f), 1e-3f);
  expectNear(pixelAt(picture, 0.8, 0.5), glm::vec3(0), 1e-3f);
}

/// Every shading draws every lobe, so there is nothing to note.
TEST(Surface, FurtherLobes_AreDrawnWithoutANoteThatTheyAreLeftOut) {
  Material brushed;
  brushed.name = "brushed";
  brushed.anisotropy.strength = 0.5f;
  brushed.clearcoat.factor = 1.0f;
  QuadScene quad;
  quad.add(brushed);
  quad.add(brushed);
  quad.lookFrom({0, 0, 2.5}, {0, 0, 0});
  quad.compile();
  Warnings notes;
  viewer::renderPicture(quad.inputs(), square(), notes);
  EXPECT_TRUE(std::none_of(notes.begin(), notes.end(), [](const std::string& note) {
    return note.find("leaves out") != std::string::npos;
  }));
}

TEST(Surface, NormalTexture_TurnsLights) {
  for (const bool back : {false, true}) {
    Material material;
    material.metallic = 0.0f;
    material.specular = 0.0f;
    material.doubleSided = true;
    material.normalTexture.image = 0;
    QuadScene quad;
    quad.scene.images = {{"slope", 1, 1, {200, 90, 230, 255}}};
    quad.add(material);
    const double side = back ? -1.0 : 1.0;
    quad.lookFrom({0, 0, 2.5 * side}, {0, 0, 0});
    const glm::dvec3 way = glm::normalize(glm::dvec3(-0.7, 0.4, -side));
    quad.scene.lights = {makeLight(LightType::Directional, glm::vec3(2), {}, way)};
    quad.compile();
    const glm::dvec3 texel = glm::normalize(2.0 * glm::dvec3(200, 90, 230) / 255.0 - 1.0);
    const double facing = std::max(-side * glm::dot(texel, way), 0.0);
    expectNear(pixelAt(quad.render(square())), glm::vec3(static_cast<float>(2.0 * facing / 3.14159265)),
               1e-3f);
  }
}

TEST(Surface, Texture_MidGrey_IsDecodedFromSrgb) {
  QuadScene quad = texturedQuad(unlit(glm::vec4(1)), false);
  quad.scene.images[0] = {"grey", 1, 1, {188, 188, 188, 255}};
  quad.compile();
  expectNear(pixelAt(quad.render(square())), glm::vec3(0.5029f), 2e-3f);
}

TEST(Surface, AlphaMask_BelowTheCutoff_IsAHole) {
  QuadScene quad = texturedQuad(unlit(glm::vec4(1)), true);
  quad.scene.materials[0].alphaMode = AlphaMode::Mask;
  quad.setSky(constantEnvironment(glm::vec3(7)));
  quad.compile();
  const Picture picture = quad.render(square(Shading::Phong, 64));
  expectNear(pixelAt(picture, 0.2, 0.2), glm::vec3(7), 1e-3f);
  expectNear(pixelAt(picture, 0.8, 0.2), {0, 1, 0}, 1e-3f);
}

TEST(Surface, AlphaBlend_OverTheSky_MixesByAlpha) {
  QuadScene quad;
  Material glass = unlit({1, 0, 0, 0.25f});
  glass.alphaMode = AlphaMode::Blend;
  quad.add(glass);
  quad.lookFrom({0, 0, 2.5}, {0, 0, 0});
  quad.setSky(constantEnvironment({0, 4, 0}));
  quad.compile();
  expectNear(pixelAt(quad.render(square())), {0.25f, 3, 0}, 1e-4f);
}

TEST(Surface, BlendedQuads_AnyOrderInTheFile_AreDrawnFarToNear) {
  for (const bool nearFirst : {true, false}) {
    QuadScene quad;
    Material near = unlit({1, 0, 0, 0.5f});
    Material far = unlit({0, 1, 0, 0.5f});
    near.alphaMode = far.alphaMode = AlphaMode::Blend;
    const glm::dmat4 closer = glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, 1));
    if (nearFirst) quad.add(near, 1.0f, closer);
    quad.add(far);
    if (!nearFirst) quad.add(near, 1.0f, closer);
    quad.lookFrom({0, 0, 4}, {0, 0, 0});
    quad.setSky(constantEnvironment(glm::vec3(0)));
    quad.compile();
    expectNear(pixelAt(quad.render(square())), {0.5f, 0.25f, 0}, 1e-4f);
  }
}

TEST(Surface, ThinGlass_UnderAConstantSky_LosesNoLight) {
  QuadScene quad;
  Material glass;
  glass.metallic = 0.0f;
  glass.roughness = 0.0f;
  glass.transmission = 1.0f;
  quad.add(glass);
  quad.lookFrom({0, 0, 2.5}, {0, 0, 0});
  quad.setSky(constantEnvironment({1, 2, 3}));
  quad.compile();
  expectNear(pixelAt(quad.render(square())), {1, 2, 3}, 1e-3f);
}

TEST(Surface, Translucent_ShowsTheLightBehindIt_AndReflectsTheRest) {
  for (const double side : {-1.0, 1.0}) {
    QuadScene quad;
    Material leaf = lambertian(glm::vec3(0.9f));
    leaf.diffuseTransmission = 0.75f;
    leaf.diffuseTransmissionColor = {0.8f, 0.4f, 0.2f};
    quad.add(leaf);
    quad.lookFrom({0, 0, 2.5}, {0, 0, 0});
    Light light;
    light.type = LightType::Directional;
    light.intensity = glm::vec3(static_cast<float>(pi));
    light.direction = {0, 0, side};
    quad.scene.lights = {light};
    quad.compile();
    expectNear(pixelAt(quad.render(square())),
               side > 0.0 ? 0.75f * glm::vec3(0.8f, 0.4f, 0.2f) : glm::vec3(0.25f * 0.9f), 1e-3f);
  }
}

TEST(Surface, VertexColors_AreMultipliedIn) {
  QuadScene quad;
  quad.add(unlit({0.5f, 1, 1, 1})).colors.assign(4, glm::vec4(0.5f, 0.25f, 1, 1));
  quad.lookFrom({0, 0, 2.5}, {0, 0, 0});
  quad.compile();
  expectNear(pixelAt(quad.render(square())), {0.25f, 0.25f, 1}, 1e-4f);
}

TEST(Surface, EmissiveQuad_ShowsItsEmission) {
  for (const Shading shading : {Shading::Phong, Shading::Ao, Shading::Sh}) {
    QuadScene quad;
    Material lamp = lambertian(glm::vec3(0));
    lamp.emission = {5, 10, 20};
    quad.add(lamp);
    quad.lookFrom({0, 0, 2.5}, {0, 0, 0});
    quad.compile();
    quad.bakeOpen(3);
    expectNear(pixelAt(quad.render(square(shading))), {5, 10, 20}, 1e-3f);
  }
}

TEST(Surface, MirroredNode_IsNotInsideOut) {
  QuadScene quad;
  quad.add(lambertian(glm::vec3(1)), 1.0f, glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, 1)));
  quad.lookFrom({0, 0, 2.5}, {0, 0, 0});
  Light light;
  light.type = LightType::Directional;
  light.intensity = glm::vec3(static_cast<float>(pi));
  quad.scene.lights = {light};
  quad.compile();
  expectNear(pixelAt(quad.render(square())), glm::vec3(1), 1e-3f);
}

TEST(Surface, SeenFromBehind_IsCulledUnlessDoubleSided) {
  QuadScene quad;
  quad.add(unlit({1, 0, 0, 1}));
  quad.lookFrom({0, 0, -2.5}, {0, 0, 0});
  quad.setSky(constantEnvironment({0, 1, 0}));
  quad.compile();
  expectNear(pixelAt(quad.render(square())), {0, 1, 0}, 1e-4f);
  quad.scene.materials[0].doubleSided = true;
  quad.compile();
  expectNear(pixelAt(quad.render(square())), {1, 0, 0}, 1e-4f);
}

TEST(Surface, WithoutNormals_ShadesWithTheGeometricNormal) {
  QuadScene quad;
  const glm::dmat4 tilted = glm::rotate(glm::dmat4(1.0), -pi / 3.0, glm::dvec3(1, 0, 0));
  quad.add(lambertian(glm::vec3(1)), 1.0f, tilted).normals.clear();
  quad.lookFrom({0, 0, 2.5}, {0, 0, 0});
  Light light;
  light.type = LightType::Directional;
  light.intensity = glm::vec3(static_cast<float>(pi));
  quad.scene.lights = {light};
  quad.compile();
  expectNear(pixelAt(quad.render(square())), glm::vec3(0.5f), 1e-3f);
}

TEST(Surface, Mirror_ShowsTheSkyInFront) {
  QuadScene quad;
  Material mirror;
  mirror.roughness = 0.0f;
  quad.add(mirror);
  quad.lookFrom({0, 0, 2.5}, {0, 0, 0});
  quad.setSky(halvedSky());
  quad.compile();
  const Picture picture = quad.render(square(Shading::Phong, 64));
  EXPECT_GT(pixelAt(picture, 0.8, 0.5).r, 0.9f);  // Its right half reflects towards +X.
  EXPECT_LT(pixelAt(picture, 0.8, 0.5).g, 0.1f);
  EXPECT_GT(pixelAt(picture, 0.2, 0.5).g, 0.9f);
}

TEST(Surface, NearerQuad_HidesTheFarther) {
  QuadScene quad;
  quad.add(unlit({1, 0, 0, 1}), 0.5f, glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, 0.001)));
  quad.add(unlit({0, 1, 0, 1}), 1.0f);
  quad.lookFrom({0, 0, 2.5}, {0, 0, 0});
  quad.compile();
  const Picture picture = quad.render(square());
  expectNear(pixelAt(picture), {1, 0, 0}, 1e-4f);
  expectNear(pixelAt(picture, 0.15, 0.5), {0, 1, 0}, 1e-4f);
}

TEST(Background, Sky_FollowsTheConventionAndItsRotation) {
  QuadScene empty;
  empty.lookFrom({0, 0, 0}, {1, 0.2, 0});
  empty.lookFrom({0, 0, 0}, {0, 0.2, -1});
  empty.setSky(halvedSky());
  empty.compile();
  viewer::RenderOptions options = square(Shading::Phong, 32);
  expectNear(pixelAt(empty.render(options)), {1, 0, 1}, 0.05f);
  EXPECT_LT(pixelAt(empty.render(options), 0.5, 0.9).b, 0.05f);  // Below the horizon.
  options.camera = 1;
  expectNear(pixelAt(empty.render(options), 0.8, 0.5), {1, 0, 1}, 0.05f);
  options.skyRotation = 0.5 * pi;  // Turns +X to -Z.
  expectNear(pixelAt(empty.render(options)), {1, 0, 1}, 0.05f);
}

TEST(Picture, EmptyScene_IsDrawn) {
  QuadScene empty;
  empty.compile();
  const Picture picture = empty.render(square());
  expectNear(pixelAt(picture), glm::vec3(1), 1e-5f);
}

TEST(Picture, DrawnInTiles_HasNoSeams) {
  QuadScene quad = texturedQuad(unlit(glm::vec4(1)), false);
  quad.compile();
  viewer::RenderOptions options = square(Shading::Phong, 1100);
  options.height = 500;
  options.samplesPerAxis = 4;  // Tiles of 512 pixels.
  const Picture tiled = quad.render(options);
  options.samplesPerAxis = 1;  // One tile.
  const Picture whole = quad.render(options);
  int different = 0;
  for (std::size_t i = 0; i < whole.pixels.size(); ++i) {
    if (glm::length(tiled.pixels[i] - whole.pixels[i]) > 0.05f) ++different;
  }
  EXPECT_LT(different, 4000);  // The quad's outline, antialiased or not.
  for (int y = 10; y < 490; ++y) {
    const glm::vec3 left = tiled.pixels[y * 1100 + 511];
    const glm::vec3 right = tiled.pixels[y * 1100 + 512];
    EXPECT_LT(glm::length(left - right), 0.05f) << y;
  }
}

TEST(Picture, DrawnTwice_IsTheSame) {
  QuadScene quad = texturedQuad(lambertian(glm::vec3(1)), false);
  quad.setSky(halvedSky());
  quad.compile();
  EXPECT_EQ(quad.render(square()).pixels, quad.render(square()).pixels);
}

TEST(Picture, WrongOptions_AreUsageErrors) {
  QuadScene quad = texturedQuad(lambertian(glm::vec3(1)), false);
  quad.compile();
  viewer::RenderOptions options = square();
  options.camera = 1;
  EXPECT_THROW(quad.render(options), UsageError);
  options.camera = -1;
  EXPECT_THROW(quad.render(options), UsageError);
  options = square();
  options.height = 0;
  EXPECT_THROW(quad.render(options), UsageError);
  options = square();
  options.width = 100000;
  EXPECT_THROW(quad.render(options), UsageError);
}

}  // namespace
}  // namespace prelight
