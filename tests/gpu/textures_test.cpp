// Textures of materials on the device: each factor reads its own.
#include <gtest/gtest.h>

#include <cmath>

#include "gpu/device_scene.h"
#include "support/probe_program.h"

namespace prelight {
namespace {

DeviceContext& textureDevice() { return test::sharedDevice().context(); }

constexpr const char* textureProbe = R"(
#define PRELIGHT_ALBEDO_SHARES
#define PRELIGHT_TEXTURES
#define PRELIGHT_GLASS
#define PRELIGHT_TRANSLUCENT
#include "transport/scene_funcs.cl"
// places: u, v of points of triangle 0 -> out [point][4][4]: albedo and alpha; base colour; roughness, metalness, glass and
// specular reflectance at grazing angles; emission and the share of light that goes through.
__kernel void probe(__constant const SceneLayout* layout, __global const SurfaceLine* surface,
                    __global const ShadingLine* shading, __global const float2* places, __global float4* out) {
  const float2 at = places[get_global_id(0)];
  const PathScene s = shadedSurfaceOf(layout, surface, shading);
  __global float4* o = out + 4 * get_global_id(0);
  o[0] = surfaceColor(surfaceOf(layout, surface), 0u, at.x, at.y);
  o[1] = (float4)(baseColor(s, 0u, at.x, at.y), 0.0f);
  Interaction i;
  i.triangle = i.material = i.flags = 0u;
  i.u = at.x;
  i.v = at.y;
  const Bsdf b = loadBsdf(s, i);
  const float metal = (b.specular.f90.x - (1.0f - b.glass) * b.layer.y) / (1.0f - b.layer.y);
  o[2] = (float4)(b.roughness, metal, b.glass, b.layer.y);
  o[3] = (float4)(emittedRadiance(s, 0u, at.x, at.y, true, (float3)(0.0f, 1.0f, 0.0f)), 1.0f - b.diffuse.x / (b.tint.x * (1.0f - metal) - b.glass * b.tint.x));
}
)";

/// A channel of a repeated texture at a point of the triangle, in double precision.
double channelAt(const CompiledScene& scene, const Image& image, const TextureRef& use, int channel,
                 bool srgb, glm::dvec2 at) {
  const auto& coords = use.texCoord == 1 ? scene.texCoords1 : scene.texCoords;
  const glm::uvec3 t = scene.triangles[0];
  const glm::dvec2 uv = (1.0 - at.x - at.y) * glm::dvec2(coords[t.x]) + at.x * glm::dvec2(coords[t.y]) +
                        at.y * glm::dvec2(coords[t.z]);
  const glm::dvec3 place = glm::dmat3(use.transform) * glm::dvec3(uv, 1.0);
  const auto texel = [&](double column, double row) {
    const auto wrap = [](double i, int n) { return static_cast<int>(i - n * std::floor(i / n)); };
    const int byte = image.rgba[static_cast<std::size_t>(
        4 * (wrap(row, image.height) * image.width + wrap(column, image.width)) + channel)];
    const double v = byte / 255.0;
    return !srgb ? v : v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  const double x = place.x * image.width, y = place.y * image.height;
  if (use.filter == TextureFilter::Nearest) return texel(std::floor(x), std::floor(y));
  const double c = std::floor(x - 0.5), r = std::floor(y - 0.5), fx = x - 0.5 - c, fy = y - 0.5 - r;
  return (1.0 - fy) * ((1.0 - fx) * texel(c, r) + fx * texel(c + 1, r)) +
         fy * ((1.0 - fx) * texel(c, r + 1) + fx * texel(c + 1, r + 1));
}

/// A triangle with a different texture for every factor.
CompiledScene texturedTriangle(std::vector<Image>& images) {
  CompiledScene scene;
  scene.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 2, 3}};
  scene.normals.assign(4, {0, 1, 0});
  scene.materials.resize(2);
  scene.texCoords = {{0.1f, 0.2f}, {0.0f, 0.0f}, {1.3f, -0.4f}, {0.2f, 1.7f}};
  scene.texCoords1 = {{-0.6f, 0.9f}, {0.0f, 0.0f}, {0.3f, 2.4f}, {0.8f, 0.1f}};
  scene.triangles = {{0, 2, 3}};
  scene.triangleMaterials = {0};
  scene.triangleFlat = {0};
  std::uint32_t random = 1;
  for (int i = 0; i < 8; ++i) {
    Image image{"texels", 3 + i % 3, 2 + i % 2, {}};
    for (int k = 0; k < 4 * image.width * image.height; ++k)
      image.rgba.push_back(static_cast<std::uint8_t>(40 + (random = random * 1664525u + 1013904223u) % 200));
    images.push_back(image);
  }
  const auto use = [](int image, int set, TextureFilter filter) {
    const auto turn = static_cast<float>(image);
    return TextureRef{image,
                      set,
                      glm::mat3(1.0f + 0.1f * turn, 0.2f, 0, -0.3f, 0.8f, 0, 0.1f * turn, 0.4f, 1),
                      WrapMode::Repeat,
                      WrapMode::Repeat,
                      filter};
  };
  CompiledMaterial& m = scene.materials[0];
  m.albedo = glm::vec3(0.9f);
  m.baseColor = glm::vec3(0.8f);
  m.metallic = 0.7f;
  m.roughness = 0.9f;
  m.transmission = 0.4f;
  m.specular = 0.6f;
  m.emission = glm::vec3(3.0f);
  m.translucency = 0.5f;
  m.baseColorTexture = use(0, 0, TextureFilter::Linear);
  m.surfaceTexture = use(1, 1, TextureFilter::Linear);
  m.transmissionTexture = use(2, 0, TextureFilter::Nearest);
  m.emissionTexture = use(3, 1, TextureFilter::Nearest);
  m.specularTexture = use(4, 0, TextureFilter::Linear);
  m.translucencyTexture = use(5, 1, TextureFilter::Linear);
  scene.images = images;
  return scene;
}

TEST(Textures, OfEveryFactor_AreLookedUpWhereTheyLie) {
  std::vector<Image> images;
  const CompiledScene scene = texturedTriangle(images);
  DeviceScene handle(textureDevice(), scene);
  handle.setShading(scene, images);
  const std::vector<glm::vec2> places = {{0.2f, 0.3f}, {0.7f, 0.1f}, {0.05f, 0.9f}, {0.4f, 0.45f}};
  const Buffer<glm::vec2> at(textureDevice(), std::span<const glm::vec2>(places));
  const Buffer<glm::vec4> out(textureDevice(), 4 * places.size());
  launchOnce(textureDevice(), test::probeFile(textureProbe), {}, "probe", {places.size(), 1},
             handle.layoutBuffer(), handle.surface(), handle.shading(), at, out);
  const std::vector<glm::vec4> found = out.read();
  const CompiledMaterial& m = scene.materials[0];
  for (std::size_t p = 0; p < places.size(); ++p) {
    const auto value = [&](const TextureRef& use, int channel, bool srgb) {
      return channelAt(scene, images[static_cast<std::size_t>(use.image)], use, channel, srgb,
                       {places[p].x, places[p].y});
    };
    const double metal = 0.7 * value(m.surfaceTexture, 2, false),
                 glass = 0.4 * value(m.transmissionTexture, 0, false);
    const double base = value(m.baseColorTexture, 1, true);
    constexpr double rounding = 2e-5;
    EXPECT_NEAR(found[4 * p][1], 0.9 * base * (1.0 - metal) * (1.0 - glass), rounding);
    EXPECT_NEAR(found[4 * p][3], value(m.baseColorTexture, 3, false), rounding);
    EXPECT_NEAR(found[4 * p + 1][1], 0.8 * base, rounding);
    EXPECT_NEAR(found[4 * p + 2][0], 0.9 * value(m.surfaceTexture, 1, false), rounding);
    EXPECT_NEAR(found[4 * p + 2][1], metal, rounding);
    EXPECT_NEAR(found[4 * p + 2][2], (1.0 - metal) * glass, rounding);
    EXPECT_NEAR(found[4 * p + 2][3], 0.6 * value(m.specularTexture, 3, false), rounding);
    EXPECT_NEAR(found[4 * p + 3][2], 3.0 * value(m.emissionTexture, 2, true), 3.0 * rounding);
    EXPECT_NEAR(found[4 * p + 3][3], 0.5 * value(m.translucencyTexture, 3, false), 10.0 * rounding);
  }
}

/// Textures of materials that no triangle uses take no memory.
TEST(Textures, OfMaterialsThatNothingHas_AreNotUploaded) {
  std::vector<Image> images;
  CompiledScene scene = texturedTriangle(images);
  scene.triangleMaterials = {1};
  const DeviceScene without(textureDevice(), scene);
  scene.triangleMaterials = {0};
  const DeviceScene with(textureDevice(), scene);
  EXPECT_LT(without.surface().size(), with.surface().size());
}

}  // namespace
}  // namespace prelight
