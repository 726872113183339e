// Pictures of encoded light, compared with decoding on the host and with quadrature of the light itself.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "basis/sh_evaluate.h"
#include "charts/make_light_map_layout.h"
#include "encodings/registry/registry.h"
#include "prelight/error.h"
#include "scene/surface/surface_frame.h"
#include "viewer/quad_scene.h"

namespace prelight {
namespace {

using namespace test;
using viewer::Shading;

using std::numbers::pi;
constexpr glm::vec3 albedo(0.9f, 0.7f, 0.5f);
constexpr std::array<int, 3> bump = {200, 90, 240};  // Colour of the normal map.

/// Radiance over a surface whose normal is the last of `axes`: an even sky, and a wide lamp to one side in
/// another colour.
glm::dvec3 radiance(const glm::dvec3& w, const glm::dmat3& axes) {
  const glm::dvec3 way = axes * glm::normalize(glm::dvec3(0.8, -0.4, 0.35));
  if (glm::dot(w, axes[2]) <= 0.0) return glm::dvec3(0.0);
  return glm::dvec3(0.3, 0.4, 0.5) +
         glm::dvec3(4.0, 3.0, 2.0) * std::pow(std::max(glm::dot(w, way), 0.0), 8.0);
}

/// Calls add(direction, radiance x solid angle) over all directions; radiance has three channels.
template <typename Add>
void integrate(const glm::dmat3& axes, const Add& add) {
  constexpr int rings = 120, steps = 240;
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < steps; ++k) {
      const double z = 2.0 * (i + 0.5) / rings - 1.0, s = std::sqrt(1.0 - z * z),
                   azimuth = 2.0 * pi * (k + 0.5) / steps;
      const glm::dvec3 w(s * std::cos(azimuth), s * std::sin(azimuth), z);
      add(w, radiance(w, axes) * (4.0 * pi / (rings * steps)));
    }
}

glm::dvec3 irradianceOf(const glm::dmat3& axes, const glm::dvec3& mapped) {
  glm::dvec3 sum(0.0);
  integrate(axes,
            [&](const glm::dvec3& w, const glm::dvec3& l) { sum += l * std::max(glm::dot(w, mapped), 0.0); });
  return sum;
}

/// SH of incident radiance, [channel][term].
std::array<float, 75> incidentOf(const glm::dmat3& axes) {
  std::array<double, 75> sums{};
  integrate(axes, [&](const glm::dvec3& w, const glm::dvec3& l) {
    std::array<double, 25> functions{};
    sh::evaluate(w, 5, functions);
    for (std::size_t i = 0; i < 75; ++i) sums[i] += functions[i % 25] * l[static_cast<int>(i / 25)];
  });
  std::array<float, 75> incident{};
  for (std::size_t i = 0; i < 75; ++i) incident[i] = static_cast<float>(sums[i]);
  return incident;
}

std::vector<float> encoded(const Encoding& encoding, const glm::dmat3& axes) {
  std::vector<float> values(encoding.values);
  encoding.encode(incidentOf(axes), surfaceFrame(glm::vec3(axes[2])), values);
  return values;
}

/// A square in some attitude, seen from the front, with a normal map of one colour.
struct BumpedQuad {
  QuadScene scene;
  glm::dmat3 axes;  ///< Along u, against v, and the normal.

  explicit BumpedQuad(const glm::dmat3& attitude) : axes(attitude) {
    Material material = lambertian(albedo);
    material.doubleSided = true;
    scene.add(material, 1.0f, glm::dmat4(axes));
    scene.scene.images = {{"bump", 1, 1, {200, 90, 240, 255}}};
    scene.scene.materials[0].normalTexture.image = 0;
    scene.lookFrom(2.0 * axes[2], {0, 0, 0});
    scene.compile();
    scene.bake.irradiance.emplace(scene.compiled.vertexCount(), glm::vec3(1.0f));
    LightMap& map = scene.bake.lightMap.emplace();
    map.layout = makeLightMapLayout(Scene{}, scene.compiled, {.texels = 64});
    map.values.assign(3 * map.layout.texelCount(), 1.0f);
  }

  glm::vec3 normal() const { return scene.compiled.normals.front(); }

  glm::dvec3 mapped() const {
    const glm::dvec3 texel = 2.0 * glm::dvec3(bump[0], bump[1], bump[2]) / 255.0 - 1.0;
    return glm::normalize(axes * texel);
  }

  /// Stores the same light at every texel and vertex.
  void light(const Encoding& encoding) {
    const std::vector<float> values = encoded(encoding, axes);
    const auto repeated = [&](std::size_t places) {
      EncodedLight light{std::string(encoding.name), {}};
      for (std::size_t i = 0; i < places; ++i)
        light.values.insert(light.values.end(), values.begin(), values.end());
      return light;
    };
    scene.bake.lightMap->encoded.push_back(repeated(scene.bake.lightMap->layout.texelCount()));
    scene.bake.encodedLight.push_back(repeated(scene.compiled.vertexCount()));
  }

  /// Irradiance in the middle of the picture.
  glm::dvec3 show(Shading shading, const Encoding* encoding, bool bumps = true) const {
    viewer::RenderInputs inputs = scene.inputs();
    inputs.encoding = encoding;
    inputs.normalTextures = bumps;
    Warnings notes;
    return glm::dvec3(pixelAt(viewer::renderPicture(inputs, square(shading), notes))) * pi /
           glm::dvec3(albedo);
  }
};

std::vector<glm::dmat3> attitudes() {
  const glm::dvec3 n = glm::normalize(glm::dvec3(0.3, -0.5, 0.7)),
                   along = glm::normalize(glm::dvec3(0.7, 0.0, -0.3));
  return {glm::dmat3(1.0), {along, glm::cross(n, along), n}};
}

/// The attitudes include one without an axis parallel to the world's.
TEST(EncodedShading, EveryEncoding_ShowsWhatItSaysOnTheHost) {
  for (const Encoding& encoding : encodings()) {
    BumpedQuad quad(attitudes().back());
    quad.light(encoding);
    const std::vector<float> values = encoded(encoding, quad.axes);
    for (const Shading shading : {Shading::LightMap, Shading::Radiosity}) {
      const glm::dvec3 expected(
          encoding.irradiance(values, surfaceFrame(quad.normal()), glm::vec3(quad.mapped()))),
          got = quad.show(shading, &encoding);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(got[c], expected[c], 2e-3 * expected[c])
            << encoding.name << " " << viewer::shadingName(shading);
    }
  }
}

/// If the encoding stores many numbers, the picture's error is at most half of that without an encoding.
TEST(EncodedShading, NormalMap_GetsTheLightsOwnIrradiance) {
  for (const glm::dmat3& attitude : attitudes())
    for (const char* name : {"sh-3", "sg-12", "sg-24"}) {
      const Encoding& encoding = *encodingNamed(name);
      BumpedQuad quad(attitude);
      quad.light(encoding);
      const glm::dvec3 even = irradianceOf(quad.axes, quad.axes[2]),
                       expected = irradianceOf(quad.axes, quad.mapped());
      for (const Shading shading : {Shading::LightMap, Shading::Radiosity}) {
        const glm::dvec3 got = quad.show(shading, &encoding);
        for (int c = 0; c < 3; ++c) {
          ASSERT_GT(std::abs(expected[c] - even[c]), 0.15 * even[c]);
          EXPECT_NEAR(got[c], expected[c], 0.5 * std::abs(expected[c] - even[c]))
              << name << " " << viewer::shadingName(shading) << ", without directions " << even[c];
        }
      }
    }
}

/// Numbers are interpolated between vertices and between texels.
TEST(EncodedShading, NumbersBetweenPlaces_AreInterpolated) {
  for (const Encoding& encoding : encodings()) {
    BumpedQuad quad(glm::dmat3(1.0));
    quad.light(encoding);
    const std::vector<float> full = encoded(encoding, quad.axes);
    std::vector<float>& vertices = quad.scene.bake.encodedLight[0].values;
    for (std::size_t v = 0; v < 4; ++v)  // Dark on the left.
      if (quad.scene.compiled.positions[v].x < 0.0f)
        std::fill_n(vertices.begin() + static_cast<std::ptrdiff_t>(v * encoding.values), encoding.values,
                    0.0f);
    std::vector<float> half = full;
    for (float& value : half) value *= 0.5f;
    const glm::dvec3 expected(
        encoding.irradiance(half, surfaceFrame(quad.normal()), glm::vec3(quad.mapped())));
    const glm::dvec3 got = quad.show(Shading::Radiosity, &encoding);
    EXPECT_NEAR(got.x, expected.x, 5e-3 * expected.x) << encoding.name;
  }
}

TEST(EncodedShading, WithoutTheEncoding_ShadingsAreWhatTheyWere) {
  BumpedQuad quad(glm::dmat3(1.0));
  for (const Shading shading : {Shading::LightMap, Shading::Radiosity}) {
    const glm::dvec3 before = quad.show(shading, nullptr, false);
    EXPECT_NEAR(before.x, 1.0, 1e-4);
    // The bake holds nothing of this encoding.
    EXPECT_EQ(quad.show(shading, &encodings().front(), false), before);
    EXPECT_EQ(quad.show(shading, nullptr), before);
  }
}

TEST(EncodedShading, LightOfAnotherScene_IsRefused) {
  BumpedQuad quad(glm::dmat3(1.0));
  quad.light(encodings().front());
  quad.scene.bake.encodedLight[0].values.pop_back();
  EXPECT_THROW(quad.show(Shading::Phong, nullptr), Error);
  quad.scene.bake.encodedLight.clear();
  quad.scene.bake.lightMap->encoded[0].values.pop_back();
  EXPECT_THROW(quad.show(Shading::Phong, nullptr), Error);
}

}  // namespace
}  // namespace prelight
