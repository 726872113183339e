// Pictures of light maps, compared with look-ups in double precision on the host.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "charts/light_map_lookup.h"
#include "charts/make_light_map_layout.h"
#include "prelight/error.h"
#include "support/scenes.h"
#include "viewer/core/camera.h"
#include "viewer/quad_scene.h"

namespace prelight {
namespace {

using namespace test;
using viewer::Shading;

constexpr glm::vec3 albedo(0.9f, 0.7f, 0.5f);

/// A ball whose vertices are shared by several charts, above a two-sided square that is partly seen from
/// behind.
QuadScene ballAndSheet() {
  QuadScene scene;
  Primitive& ball = scene.add(lambertian(albedo));
  const CompiledScene sphere = test::sphere(10, 0.7f, {0.2f, 0.1f, 0.4f});
  ball.positions = sphere.positions;
  ball.normals = sphere.normals;
  ball.triangles = sphere.triangles;
  ball.texCoords0.clear();
  ball.texCoords1.clear();
  Material sheet = lambertian(albedo);
  sheet.doubleSided = true;
  scene.add(sheet, 1.2f, glm::dmat4({0, 0, -1, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}, {-0.4, 0, -0.6, 1}));
  scene.lookFrom({-1.5, 1.0, 3.0}, {0, 0, 0});
  scene.compile();
  LightMapLayoutRequest request;
  request.texels = 3000;
  LightMap map;
  map.layout = makeLightMapLayout(Scene{}, scene.compiled, request);
  std::mt19937 random(4);
  std::uniform_real_distribution<float> uniform(0.0f, 10.0f);
  map.values.resize(3 * map.layout.texelCount());
  for (float& value : map.values) value = uniform(random);
  scene.bake.lightMap = std::move(map);
  return scene;
}

struct Meeting {
  std::uint32_t face = 0;
  double b1 = 0.0, b2 = 0.0;
  double edge = 0.0;  ///< Least barycentric weight.
};

/// The nearest triangle along a ray, by Moeller and Trumbore's test over all triangles.
std::optional<Meeting> meet(const CompiledScene& scene, const glm::dvec3& origin, const glm::dvec3& way) {
  std::optional<Meeting> nearest;
  double distance = 1e30;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const glm::dvec3 a(scene.positions[scene.triangles[t].x]),
        e = glm::dvec3(scene.positions[scene.triangles[t].y]) - a,
        f = glm::dvec3(scene.positions[scene.triangles[t].z]) - a;
    const glm::dvec3 p = glm::cross(way, f);
    const double determinant = glm::dot(e, p);
    if (determinant == 0.0) continue;
    const glm::dvec3 q = glm::cross(origin - a, e);
    const double b1 = glm::dot(origin - a, p) / determinant, b2 = glm::dot(way, q) / determinant,
                 along = glm::dot(f, q) / determinant;
    if (b1 < 0.0 || b2 < 0.0 || b1 + b2 > 1.0 || along <= 0.0 || along >= distance) continue;
    const bool back = determinant < 0.0;
    if (back && !scene.materials[scene.triangleMaterials[t]].doubleSided) continue;
    distance = along;
    nearest = {t + (back ? scene.triangleCount() : 0), b1, b2, std::min({b1, b2, 1.0 - b1 - b2})};
  }
  return nearest;
}

TEST(LightMapShading, Picture_IsAlbedoTimesIrradianceOverPi) {
  const QuadScene scene = ballAndSheet();
  constexpr int size = 96;
  viewer::RenderOptions options = square(Shading::LightMap, size);
  options.samplesPerAxis = 1;
  const Picture picture = scene.render(options);
  const viewer::CameraMatrices camera = viewer::cameraMatrices(
      viewer::chooseCamera(scene.scene, scene.compiled, std::nullopt), scene.compiled, 1.0);
  const glm::dmat4 sceneFromClip = glm::inverse(camera.projection * camera.view);
  std::size_t fronts = 0, backs = 0, wrong = 0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const glm::dvec4 far =
          sceneFromClip * glm::dvec4(2.0 * (x + 0.5) / size - 1.0, 1.0 - 2.0 * (y + 0.5) / size, 1.0, 1.0);
      const auto met = meet(scene.compiled, camera.position, glm::dvec3(far) / far.w - camera.position);
      if (!met || met->edge < 1e-3) continue;  // On an edge, either triangle may be drawn.
      const glm::dvec3 expected = glm::dvec3(albedo) / std::numbers::pi *
                                  lightMapIrradiance(*scene.bake.lightMap, met->face, met->b1, met->b2);
      const glm::vec3 got = picture.pixels[static_cast<std::size_t>(y * size + x)];
      ++(met->face < scene.compiled.triangleCount() ? fronts : backs);
      if (glm::length(glm::dvec3(got) - expected) > 2e-3 && wrong++ == 0) {
        ADD_FAILURE() << "pixel " << x << ", " << y << ", face " << met->face << " of "
                      << scene.compiled.triangleCount() << " triangles: got " << got.r << ", " << got.g
                      << ", " << got.b << ", expected " << expected.r << ", " << expected.g << ", "
                      << expected.b;
      }
    }
  EXPECT_GT(fronts, 800u);
  EXPECT_GT(backs, 300u);
  EXPECT_EQ(wrong, 0u);
}

TEST(LightMapShading, Lights_AreNotAddedToWhatIsBaked) {
  QuadScene scene = ballAndSheet();
  scene.scene.lights = {makeLight(LightType::Point, {1, 1, 1}, {0, 0, 3})};
  const Picture dim = scene.render(square(Shading::LightMap));
  EXPECT_GT(pixelAt(dim).r, 0.0f);
  scene.scene.lights = {makeLight(LightType::Point, {50, 50, 50}, {0, 0, 3})};
  EXPECT_TRUE(scene.render(square(Shading::LightMap)).pixels == dim.pixels);
}

/// A square with a normal map of one colour, lit by a lamp to one side and an even sky.
TEST(LightMapShading, NormalMap_TurnsToTheLight) {
  for (const bool tangents : {false, true}) {
    QuadScene scene;
    Primitive& quad = scene.add(lambertian(albedo));
    if (tangents) quad.tangents.assign(4, glm::vec4(0.0f, 1.0f, 0.0f, -1.0f));
    scene.scene.images = {{"bump", 1, 1, {200, 90, 240, 255}}};
    scene.scene.materials[0].normalTexture.image = 0;
    scene.scene.materials[0].normalScale = 0.5f;
    scene.lookFrom({0, 0, 2}, {0, 0, 0});
    scene.compile();
    LightMapLayoutRequest request;
    request.texels = 64;
    LightMap map;
    map.layout = makeLightMapLayout(Scene{}, scene.compiled, request);
    map.coefficients = 5;
    const glm::dvec3 way = glm::normalize(glm::dvec3(0.7, -0.2, 0.5));
    const double linear = std::sqrt(3.0 / (4.0 * std::numbers::pi)), lamp = 4.0, sky = 0.3;
    const glm::dvec3 vector = lamp * way + std::numbers::pi * sky * glm::dvec3(0, 0, 1);
    const double values[] = {vector.z,
                             (lamp + 2.0 * std::numbers::pi * sky) / std::sqrt(4.0 * std::numbers::pi),
                             linear * vector.y, linear * vector.z, linear * vector.x};
    for (std::size_t i = 0; i < 3 * map.layout.texelCount(); ++i)
      map.values.insert(map.values.end(), std::begin(values), std::end(values));
    scene.bake.lightMap = std::move(map);
    viewer::RenderInputs inputs = scene.inputs();
    Warnings notes;
    inputs.normalTextures = false;
    const glm::vec3 even = pixelAt(viewer::renderPicture(inputs, square(Shading::LightMap), notes));
    EXPECT_NEAR(even.y, 0.7 / std::numbers::pi * vector.z, 1e-5);
    inputs.normalTextures = true;
    const glm::vec3 got = pixelAt(viewer::renderPicture(inputs, square(Shading::LightMap), notes));
    const glm::dvec3 texel = 2.0 * glm::dvec3(200, 90, 240) / 255.0 - 1.0;
    const double x = 0.5 * texel.x, y = 0.5 * texel.y;
    // Red tilts along +X and green along +Y, as the coordinates do, or along the file's tangent +Y and -(Z x
    // Y) = +X.
    const glm::dvec3 m = glm::normalize(tangents ? glm::dvec3(y, x, texel.z) : glm::dvec3(x, y, texel.z));
    const double expected =
        lamp * std::max(glm::dot(m, way), 0.0) + 0.5 * std::numbers::pi * sky * (1.0 + m.z);
    EXPECT_NEAR(got.y, 0.7 / std::numbers::pi * expected, 2e-4) << tangents;
    EXPECT_GT(std::abs(got.y - even.y), 0.02f);
  }
}

TEST(LightMapShading, FileWithALightMapAlone_IsShownSo) {
  EXPECT_EQ(viewer::carriedShading(ballAndSheet().bake, {}).shading, Shading::LightMap);
}

TEST(LightMapShading, LightMapOfAnotherScene_IsRefused) {
  QuadScene scene = ballAndSheet();
  scene.bake.lightMap->layout.chartOf.pop_back();
  EXPECT_THROW(scene.render(square(Shading::LightMap)), Error);
}

}  // namespace
}  // namespace prelight
