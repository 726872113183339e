// Global illumination in OpenGL: shadows compared with rays on the host in double precision, mirrors and
// glass with closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <optional>

#include "charts/make_light_map_layout.h"
#include "gi/global_illumination.h"
#include "gpu/film_table.h"
#include "prelight/error.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "support/scenes.h"
#include "viewer/drawn_passes.h"
#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"
#include "viewer/picture_checks.h"
#include "viewer/quad_scene.h"

namespace prelight {
namespace {

using namespace test;
using viewer::Shading;

/// A map of the scene with values of 0: neither indirect light nor caustics.
GlobalIllumination darkness(const QuadScene& quad) {
  GlobalIllumination globalIllumination;
  LightMapLayoutRequest request;
  request.texels = 500;
  globalIllumination.indirect.layout = makeLightMapLayout(quad.scene, quad.compiled, request);
  globalIllumination.indirect.values.assign(3 * globalIllumination.indirect.layout.texelCount(), 0.0f);
  return globalIllumination;
}

struct IlluminatedScene {
  QuadScene quad;
  GlobalIllumination globalIllumination;

  viewer::RenderInputs inputs() const {
    viewer::RenderInputs inputs = quad.inputs();
    inputs.globalIllumination = &globalIllumination;
    return inputs;
  }

  Picture render(const viewer::RenderOptions& options) const {
    Warnings notes;
    return viewer::renderPicture(inputs(), options, notes);
  }
};

viewer::RenderOptions globalIlluminationOptions(int size) {
  viewer::RenderOptions options = square(Shading::GlobalIllumination, size);
  options.samplesPerAxis = 1;
  return options;
}

/// A built-in scene in white, diffuse material, scaled by `scale`, under one light of the scaled scene.
IlluminatedScene whiteScene(const std::string& name, double scale, Light light) {
  IlluminatedScene result;
  Warnings warnings;
  result.quad.scene = loadScene(makeBuiltinScene(name), warnings);
  for (Material& material : result.quad.scene.materials) material = lambertian(glm::vec3(1.0f));
  for (MeshNode& node : result.quad.scene.meshNodes)
    for (glm::dmat4& transform : node.transforms)
      transform = glm::scale(glm::dmat4(1.0), glm::dvec3(scale)) * transform;
  for (Camera& camera : result.quad.scene.cameras) {
    camera.world[3] = glm::dvec4(scale * glm::dvec3(camera.world[3]), 1.0);
    camera.zNear *= scale;
    camera.zFar *= scale;
  }
  light.position *= scale;
  light.intensity *= static_cast<float>(scale * scale);
  if (light.type == LightType::Directional) light.intensity /= static_cast<float>(scale * scale);
  result.quad.scene.lights = {light};
  result.quad.compile();
  result.globalIllumination = darkness(result.quad);
  return result;
}

struct Meeting {
  std::uint32_t triangle = 0;
  double distance = 0.0, b1 = 0.0, b2 = 0.0;
  bool back = false;
};

/// The nearest triangle along a ray, by Moeller and Trumbore's test over all triangles. Distances are in
/// lengths of `way`. With `culled`, backs of one-sided surfaces are ignored as in pictures.
std::optional<Meeting> meet(const CompiledScene& scene, const glm::dvec3& origin, const glm::dvec3& way,
                            double most, bool culled) {
  std::optional<Meeting> nearest;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const glm::dvec3 a(scene.positions[scene.triangles[t].x]),
        e = glm::dvec3(scene.positions[scene.triangles[t].y]) - a,
        f = glm::dvec3(scene.positions[scene.triangles[t].z]) - a;
    const glm::dvec3 p = glm::cross(way, f);
    const double determinant = glm::dot(e, p);
    if (determinant == 0.0) continue;
    const bool back = determinant < 0.0;
    if (culled && back && !scene.materials[scene.triangleMaterials[t]].doubleSided) continue;
    const double b1 = glm::dot(origin - a, p) / determinant;
    if (b1 < 0.0 || b1 > 1.0) continue;
    const glm::dvec3 q = glm::cross(origin - a, e);
    const double b2 = glm::dot(way, q) / determinant, along = glm::dot(f, q) / determinant;
    if (b2 < 0.0 || b1 + b2 > 1.0 || along <= 0.0 || along >= most) continue;
    most = along;
    nearest = {t, along, b1, b2, back};
  }
  return nearest;
}

struct Rays {
  explicit Rays(const IlluminatedScene& scene, int pixels) : size(pixels) {
    const viewer::CameraMatrices camera = viewer::cameraMatrices(
        viewer::chooseCamera(scene.quad.scene, scene.quad.compiled, std::nullopt), scene.quad.compiled, 1.0);
    eye = camera.position;
    sceneFromClip = glm::inverse(camera.projection * camera.view);
  }

  /// Unit direction through the centre of a pixel.
  glm::dvec3 way(int x, int y) const {
    const glm::dvec4 far =
        sceneFromClip * glm::dvec4(2.0 * (x + 0.5) / size - 1.0, 1.0 - 2.0 * (y + 0.5) / size, 1.0, 1.0);
    return glm::normalize(glm::dvec3(far) / far.w - eye);
  }

  int size;
  glm::dvec3 eye{0.0};
  glm::dmat4 sceneFromClip{1.0};
};

glm::dvec3 shadingNormal(const CompiledScene& scene, const Meeting& met) {
  const glm::uvec3 corners = scene.triangles[met.triangle];
  glm::dvec3 n = glm::normalize(geometricNormal(scene, met.triangle));
  if (scene.triangleFlat[met.triangle] == 0)
    n = glm::normalize((1.0 - met.b1 - met.b2) * glm::dvec3(scene.normals[corners.x]) +
                       met.b1 * glm::dvec3(scene.normals[corners.y]) +
                       met.b2 * glm::dvec3(scene.normals[corners.z]));
  return met.back ? -n : n;
}

struct ShadowCheck {
  int compared = 0;  ///< Number of compared pixels, away from the edges of shadows and from creases.
  int wrong = 0;     ///< Off by more than a tenth.
  int leaks = 0;     ///< Lit although dark.
  int lit = 0, dark = 0;
};

/// Traced pixel: share of the light that reaches its surface (-1 if the light hardly shines there), and
/// radiance without shadows.
struct Traced {
  double visible = -1.0, open = 0.0;
  glm::dvec3 face{0.0};  ///< Normal of the triangle on the visible side.

  /// Whether the other pixel shows the same lit or dark surface, with no shadow edge or crease between them.
  bool goesOn(const Traced& other) const {
    return visible == other.visible && glm::dot(face, other.face) > 0.9;
  }
};

Traced trace(const CompiledScene& scene, const Rays& rays, const viewer::ShadedLight& light, int x, int y) {
  const glm::dvec3 way = rays.way(x, y);
  Traced traced;
  const auto met = meet(scene, rays.eye, way, 1e30, true);
  if (!met) return traced;
  const glm::dvec3 point = rays.eye + met->distance * way;
  traced.face = glm::normalize(geometricNormal(scene, met->triangle)) * (met->back ? -1.0 : 1.0);
  const IncidentLight incident = viewer::incidentFrom(light, point);
  const double cosine = glm::dot(shadingNormal(scene, *met), incident.toLight);
  if (cosine < 0.02 || glm::dot(traced.face, incident.toLight) < 0.02) return traced;
  traced.open = cosine * incident.irradiance.x / std::numbers::pi;
  const double radius = 0.5 * glm::length(glm::dvec3(scene.boundsMax - scene.boundsMin));
  const glm::dvec3 start = point + 1e-5 * radius * traced.face;
  const double distance =
      light.kind == viewer::LightKind::Directional ? 1e30 : glm::length(glm::dvec3(light.position) - start);
  traced.visible = meet(scene, start, incident.toLight, distance, false) ? 0.0 : 1.0;
  return traced;
}

/// Compares the pixels whose eight neighbours show the same surface.
ShadowCheck compareShadows(const IlluminatedScene& scene, int size) {
  viewer::RenderOptions options = globalIlluminationOptions(size);
  options.emitters = false;
  const Picture picture = scene.render(options);
  const viewer::ShadedLight light = viewer::shadedLight(scene.quad.scene.lights.front(), scene.quad.compiled);
  const Rays rays(scene, size);
  std::vector<Traced> traced;
  double most = 0.0;
  for (int i = 0; i < size * size; ++i) {
    traced.push_back(trace(scene.quad.compiled, rays, light, i % size, i / size));
    most = std::max(most, traced.back().open);
  }
  ShadowCheck check;
  for (int y = 1; y < size - 1; ++y)
    for (int x = 1; x < size - 1; ++x) {
      const auto i = static_cast<std::size_t>(y * size + x);
      if (traced[i].open < 1e-3 * most || traced[i].visible < 0.0) continue;
      bool inside = true;
      for (int k = 0; k < 9; ++k)
        inside = inside &&
                 traced[i].goesOn(traced[static_cast<std::size_t>((y + k / 3 - 1) * size + x + k % 3 - 1)]);
      if (!inside) continue;
      const double drawn = static_cast<double>(picture.pixels[i].r) / traced[i].open;
      ++check.compared;
      ++(traced[i].visible > 0.0 ? check.lit : check.dark);
      if (std::abs(drawn - traced[i].visible) > 0.1) ++check.wrong;
      if (traced[i].visible == 0.0 && drawn > 0.1) ++check.leaks;
    }
  return check;
}

struct ShadowCase {
  const char* scene;
  Light light;
};

std::vector<ShadowCase> shadowCases() {
  Light spot = makeLight(LightType::Spot, {5, 5, 5}, {0.4, 0.9, 0.7}, {-0.4, -1.0, -0.7});
  spot.innerConeAngle = 0.3f;
  spot.outerConeAngle = 0.6f;
  return {{"cornell", makeLight(LightType::Point, {5, 5, 5}, {0.1, 0.85, 0.2})},
          {"cornell", spot},
          {"caustics", makeLight(LightType::Directional, {5, 5, 5}, {0, 0, 0}, {0.4, -0.3, -1.0})},
          {"shapes", makeLight(LightType::Point, {50, 50, 50}, {1.5, 4, 2.5})},
          {"shapes", makeLight(LightType::Directional, {5, 5, 5}, {0, 0, 0}, {-1.0, -0.6, -0.5})},
          {"rooms", makeLight(LightType::Point, {20, 20, 20}, {-1.6, 1.6, 0.4})}};
}

TEST(GlobalIlluminationShadows, OfManyScenesAndLights_AreThoseOfRays) {
  int lit = 0, dark = 0;
  for (const ShadowCase& testCase : shadowCases()) {
    const ShadowCheck check = compareShadows(whiteScene(testCase.scene, 1.0, testCase.light), 72);
    SCOPED_TRACE(testing::Message() << testCase.scene << ", light of type " << int(testCase.light.type));
    ASSERT_GT(check.compared, 200);
    EXPECT_LE(check.wrong, 0.001 * check.compared);
    EXPECT_EQ(check.leaks, 0);
    lit += check.lit;
    dark += check.dark;
  }
  EXPECT_GT(lit, 1000);
  EXPECT_GT(dark, 1000);
}

TEST(GlobalIlluminationShadows, ScenesOfMillimetresAndKilometres_AreDrawnAlike) {
  const ShadowCase shapes = shadowCases()[3];
  const IlluminatedScene metres = whiteScene(shapes.scene, 1.0, shapes.light);
  const Picture expected = metres.render(globalIlluminationOptions(96));
  for (const double scale : {1e-3, 1e3}) {
    const Picture scaled =
        whiteScene(shapes.scene, scale, shapes.light).render(globalIlluminationOptions(96));
    int other = 0;
    for (std::size_t i = 0; i < scaled.pixels.size(); ++i)
      other += glm::length(scaled.pixels[i] - expected.pixels[i]) > 0.02f * (0.1f + expected.pixels[i].r);
    EXPECT_LT(other, 20) << scale;  // Out of 9216: texels at the edges of shadows round.
    EXPECT_LE(compareShadows(whiteScene(shapes.scene, scale, shapes.light), 48).wrong, 1) << scale;
  }
}

/// A floor at y = 0 under a lamp, with an object above it.
IlluminatedScene floorAndShade(const Material& shade) {
  IlluminatedScene scene;
  const glm::dmat4 up({1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1});
  scene.quad.add(lambertian(glm::vec3(1.0f)), 2.0f, up);
  glm::dmat4 above = up;
  above[3] = glm::dvec4(0, 1, 0, 1);
  scene.quad.add(shade, 0.5f, above);
  scene.quad.scene.lights = {makeLight(LightType::Point, {10, 10, 10}, {0, 3, 0})};
  scene.quad.lookFrom({0, 0.6, 3.0}, {0, 0, 0});
  scene.quad.compile();
  scene.globalIllumination = darkness(scene.quad);
  return scene;
}

TEST(GlobalIlluminationShadows, MaskedHoles_LetLightThroughAndTheRestDoesNot) {
  Material whole = lambertian(glm::vec3(1.0f)), hole = whole;
  hole.alphaMode = AlphaMode::Mask;
  hole.alphaCutoff = 0.5f;
  hole.baseColor.a = 0.4f;
  const glm::vec3 under = pixelAt(floorAndShade(whole).render(globalIlluminationOptions(65)));
  EXPECT_EQ(under.r, 0.0f);
  const glm::vec3 through = pixelAt(floorAndShade(hole).render(globalIlluminationOptions(65)));
  // The visible part of the floor is around the origin, 3 m under the light.
  expectColor(through, glm::dvec3(10.0 / 9.0 / std::numbers::pi), 0.01);
}

TEST(GlobalIlluminationShadows, BacksOfSurfaces_CastThem) {
  IlluminatedScene scene = floorAndShade(lambertian(glm::vec3(1.0f)));
  scene.quad.scene.meshNodes.back().transforms.front() =
      glm::dmat4({1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}, {0, 1, 0, 1});  // Faces down.
  scene.quad.compile();
  EXPECT_EQ(pixelAt(scene.render(globalIlluminationOptions(65))).r, 0.0f);
}

Material leaf() {
  Material material = lambertian(glm::vec3(0.9f));
  material.diffuseTransmission = 1.0f;
  material.diffuseTransmissionColor = glm::vec3(0.8f, 0.4f, 0.2f);
  material.doubleSided = true;
  return material;
}

/// A sheet that faces +Z, lit from its front or its back.
IlluminatedScene litSheet(const Material& material, double side) {
  IlluminatedScene scene;
  scene.quad.add(material, 2.0f);
  scene.quad.scene.lights = {makeLight(LightType::Point, {10, 10, 10}, {0.0, 0.0, 2.0 * side})};
  scene.quad.lookFrom({0, 0, 3.0}, {0, 0, 0});
  scene.quad.compile();
  scene.globalIllumination = darkness(scene.quad);
  return scene;
}

TEST(GlobalIlluminationShading, SheetThatLetsAllLightThrough_ShowsThatFromBehindAlone) {
  expectColor(pixelAt(litSheet(leaf(), -1.0).render(globalIlluminationOptions(33))),
              10.0 / 4.0 / std::numbers::pi * glm::dvec3(0.8, 0.4, 0.2), 0.01);
  EXPECT_EQ(pixelAt(litSheet(leaf(), 1.0).render(globalIlluminationOptions(33))), glm::vec3(0.0f));
}

TEST(GlobalIlluminationShading, SheetOfAQuarter_ReflectsTheRestOfItsAlbedo) {
  Material quarter = leaf();
  quarter.diffuseTransmission = 0.25f;
  expectColor(pixelAt(litSheet(quarter, 1.0).render(globalIlluminationOptions(33))),
              glm::dvec3(10.0 / 4.0 / std::numbers::pi * 0.75 * 0.9), 0.01);
}

TEST(GlobalIlluminationShading, MapOfTheOtherSide_ComesThrough) {
  IlluminatedScene scene = litSheet(leaf(), 1.0);  // The front reflects nothing of the lamp.
  for (LightMapTexel& texel : scene.globalIllumination.indirect.layout.texels)
    for (int c = 0; c < 3; ++c)
      scene.globalIllumination.indirect.values[3 * texel.texel + static_cast<std::size_t>(c)] =
          texel.face < scene.quad.compiled.triangleCount() ? 0.0f : 2.0f;
  expectColor(pixelAt(scene.render(globalIlluminationOptions(33))),
              2.0 / std::numbers::pi * glm::dvec3(0.8, 0.4, 0.2), 0.01);
}

Material brushedMetal(float strength) {
  Material material;
  material.baseColor = {0.04f, 0.04f, 0.04f, 1.0f};  // Dark, so that later bounces add little.
  material.roughness = 0.5f;
  material.anisotropy.strength = strength;
  material.anisotropy.rotation = 0.5f;
  return material;
}

/// The extension's formula for metals that reflect 0.04 along their normal +Z, for light and view directions.
double brushedValue(double roughness, double strength, const glm::dvec3& t, const glm::dvec3& v,
                    const glm::dvec3& l) {
  const glm::dvec3 b = glm::cross(glm::dvec3(0, 0, 1), t), h = glm::normalize(v + l);
  const double ab = roughness * roughness, at = ab + (1.0 - ab) * strength * strength;
  const glm::dvec3 f(ab * glm::dot(t, h), at * glm::dot(b, h), at * ab * h.z);
  const double w2 = at * ab / glm::dot(f, f), d = at * ab * w2 * w2 / std::numbers::pi;
  const double visible = 0.5 / (l.z * glm::length(glm::dvec3(at * glm::dot(t, v), ab * glm::dot(b, v), v.z)) +
                                v.z * glm::length(glm::dvec3(at * glm::dot(t, l), ab * glm::dot(b, l), l.z)));
  return (0.04 + 0.96 * std::pow(1.0 - glm::dot(v, h), 5.0)) * d * visible;
}

TEST(GlobalIlluminationShading, AnisotropicMetal_IsTheExtensionsFormula) {
  for (const float strength : {0.4f, 0.9f}) {
    IlluminatedScene scene;
    scene.quad.add(brushedMetal(strength), 2.0f);
    const glm::dvec3 toLight = glm::normalize(glm::dvec3(0.6, 0.1, 0.9)), eye(-1.0, 0.3, 2.0);
    scene.quad.scene.lights = {makeLight(LightType::Directional, {1e2f, 1e2f, 1e2f}, {}, -toLight)};
    scene.quad.lookFrom(eye, {0, 0, 0});
    scene.quad.compile();
    scene.globalIllumination = darkness(scene.quad);
    const glm::dvec3 t(std::cos(0.5), std::sin(0.5), 0.0);
    const double expected =
        1e2 * toLight.z * brushedValue(0.5, double(strength), t, glm::normalize(eye), toLight);
    expectColor(pixelAt(scene.render(globalIlluminationOptions(33))), glm::dvec3(1.02 * expected), 0.025);
  }
}

/// A metal that reflects 0.04 along its normal, below a film with filmReflectance(), as renderers by rays
/// have it.
TEST(GlobalIlluminationShading, FilmOverADarkMetal_ColoursTheHighlight) {
  for (const float thickness : {250.0f, 500.0f}) {
    Material material = brushedMetal(0.0f);
    material.roughness = 0.3f;
    material.iridescence.factor = 1.0f;
    material.iridescence.ior = 1.6f;
    material.iridescence.thicknessMaximum = thickness;
    IlluminatedScene scene;
    scene.quad.add(material, 2.0f);
    const glm::dvec3 toLight = glm::normalize(glm::dvec3(0.6, 0.1, 0.9)), eye(-1.0, 0.0, 2.0),
                     toEye = glm::normalize(eye);
    scene.quad.scene.lights = {makeLight(LightType::Directional, {1e2f, 1e2f, 1e2f}, {}, -toLight)};
    scene.quad.lookFrom(eye, {0, 0, 0});
    scene.quad.compile();
    scene.globalIllumination = darkness(scene.quad);
    const double facing = glm::dot(toEye, glm::normalize(toEye + toLight)),
                 plain = 0.04 + 0.96 * std::pow(1.0 - facing, 5.0);
    const double lobe = 1e2 * toLight.z * brushedValue(0.3, 0.0, glm::dvec3(1, 0, 0), toEye, toLight) / plain;
    const glm::dvec3 film = filmReflectance(facing, 1.0, 1.6, double(thickness), glm::dvec3(0.04));
    EXPECT_GT(std::abs(film.x - film.y) + std::abs(film.y - film.z), 0.02);
    expectColor(pixelAt(scene.render(globalIlluminationOptions(33))), lobe * film, 0.02);
  }
}

Material clearGlass(float thickness) {
  Material glass;
  glass.metallic = glass.roughness = 0.0f;
  glass.transmission = 1.0f;
  glass.thickness = thickness;
  glass.ior = 1.5f;
  return glass;
}

glm::vec3 underAnEvenSky(const Material& material) {
  IlluminatedScene scene;
  scene.quad.add(material);
  scene.quad.lookFrom({0, 0, 2.5}, {0, 0, 0});
  scene.quad.setSky(constantEnvironment({1, 1, 1}));
  scene.quad.compile();
  scene.globalIllumination = darkness(scene.quad);
  return pixelAt(scene.render(globalIlluminationOptions(33)));
}

/// The transmittance is one minus the reflectance of the most reflective channel.
TEST(GlobalIlluminationShading, ThinGlass_ReflectsByItsFactorsAndFilm) {
  const auto expected = [](const glm::dvec3& once) {
    const glm::dvec3 both = 2.0 * once / (1.0 + once);
    return both + 1.0 - std::max({both.x, both.y, both.z});
  };
  Material tinted = clearGlass(0.0f);
  tinted.specular = 0.5f;
  tinted.specularColor = {20.0f, 10.0f, 0.0f};
  expectColor(underAnEvenSky(tinted), expected({0.4, 0.2, 0.0}), 4e-3);
  Material filmed = clearGlass(0.0f);
  filmed.iridescence.factor = 0.5f;
  filmed.iridescence.ior = 2.0f;
  filmed.iridescence.thicknessMaximum = 400.0f;
  const glm::dvec3 film = filmReflectance(1.0, 1.0, 2.0, 400.0, glm::dvec3(0.04));
  EXPECT_GT(std::abs(film.x - film.y) + std::abs(film.y - film.z), 0.02);
  expectColor(underAnEvenSky(filmed), expected(glm::mix(glm::dvec3(0.04), film, 0.5)), 4e-3);
}

/// The colours of all wavelengths add up to white.
TEST(GlobalIlluminationShading, DispersiveGlassUnderAnEvenSky_IsWhite) {
  Material glass = clearGlass(1.0f);
  const glm::vec3 plain = underAnEvenSky(glass);
  glass.dispersion = 3.0f;
  expectColor(underAnEvenSky(glass), glm::dvec3(plain), 2e-3);
  expectColor(plain, {1, 1, 1}, 4e-3);
}

/// A dark coat over black: the textures of the coat and of its roughness multiply the factors.
TEST(GlobalIlluminationShading, TexturesOfTheCoat_MultiplyItsFactors) {
  const auto coated = [](bool textured) {
    Material material = lambertian(glm::vec3(0.0f));
    material.clearcoat.factor = textured ? 1.0f : 128.0f / 255.0f;
    material.clearcoat.roughness = textured ? 1.0f : 102.0f / 255.0f;
    if (textured) material.clearcoat.texture.image = material.clearcoat.roughnessTexture.image = 0;
    IlluminatedScene scene = litSheet(material, 1.0);
    scene.quad.scene.images = {{"coat", 1, 1, {128, 102, 0, 255}}};
    scene.quad.compile();
    return pixelAt(scene.render(globalIlluminationOptions(33)));
  };
  const glm::vec3 factors = coated(false), textures = coated(true);
  EXPECT_GT(factors.x, 1e-3f);
  expectColor(textures, glm::dvec3(factors), 0.01);
}

/// A floor under a square lamp of 1 m, which is 1.5 m above it.
IlluminatedScene floorUnderLamp() {
  IlluminatedScene scene;
  const glm::dmat4 up({1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1});
  scene.quad.add(lambertian(glm::vec3(1.0f)), 2.0f, up);
  Material lamp = lambertian(glm::vec3(0.0f));
  lamp.emission = glm::vec3(7.0f);
  scene.quad.add(lamp, 0.5f, glm::dmat4({1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}, {0, 1.5, 0, 1}));
  scene.quad.lookFrom({0, 0.6, 3.0}, {0, 0, 0});
  scene.quad.compile();
  scene.globalIllumination = darkness(scene.quad);
  return scene;
}

TEST(GlobalIlluminationShading, EmissiveSquareOverAFloor_IsTheClosedForm) {
  const IlluminatedScene scene = floorUnderLamp();
  // Form factor of a square above a point of a parallel plane: four times that of a quarter (Howell, B-3).
  const double a = 0.5 / 1.5, r = std::sqrt(1.0 + a * a);
  const double factor = 4.0 / (2.0 * std::numbers::pi) * 2.0 * (a / r) * std::atan(a / r);
  expectColor(pixelAt(scene.render(globalIlluminationOptions(65))), glm::dvec3(7.0 * factor), 0.01);
}

TEST(GlobalIlluminationShading, EvenSkyOverAnOpenFloor_IsItsRadiance) {
  IlluminatedScene scene;
  scene.quad.add(lambertian(glm::vec3(0.8f)), 2.0f);
  scene.quad.setSky(constantEnvironment(glm::vec3(1.0f)));
  scene.quad.lookFrom({0, 0, 3}, {0, 0, 0});
  scene.quad.compile();
  scene.globalIllumination = darkness(scene.quad);
  expectColor(pixelAt(scene.render(globalIlluminationOptions(33))), glm::dvec3(0.8), 0.02);
}

TEST(GlobalIlluminationShading, IndirectLight_IsThatOfTheMapAndCanBeReplaced) {
  IlluminatedScene scene;
  scene.quad.add(lambertian(glm::vec3(0.5f)), 2.0f);
  Environment black{1, 1, {glm::vec3(0.0f)}};
  scene.quad.setSky(black);
  scene.quad.lookFrom({0, 0, 3}, {0, 0, 0});
  scene.quad.compile();
  scene.globalIllumination = darkness(scene.quad);
  const viewer::RenderInputs inputs = scene.inputs();
  const viewer::View view = viewer::makeView(inputs, globalIlluminationOptions(33));
  const viewer::gl::EglContext context;
  viewer::Renderer renderer(inputs);
  EXPECT_EQ(pixelAt(viewer::renderView(renderer, view, 1)).r, 0.0f);
  std::vector<float> values(scene.globalIllumination.indirect.values.size(), 2.0f);
  renderer.update(viewer::Shading::GlobalIllumination, {.indirect = values});
  expectColor(pixelAt(viewer::renderView(renderer, view, 1)), glm::dvec3(1.0 / std::numbers::pi), 1e-4);
  values.pop_back();
  EXPECT_THROW(renderer.update(viewer::Shading::GlobalIllumination, {.indirect = values}), Error);
}

TEST(GlobalIlluminationShading, StillScene_DrawsNoMapTwiceAndAMovedLightOnlyItsOwn) {
  IlluminatedScene scene = floorAndShade(lambertian(glm::vec3(1.0f)));
  Light spot = makeLight(LightType::Spot, {5, 5, 5}, {1, 2, 0}, {0, -1, 0});
  spot.outerConeAngle = 0.5f;
  scene.quad.scene.lights.push_back(spot);
  const viewer::RenderInputs inputs = scene.inputs();
  viewer::View view = viewer::makeView(inputs, globalIlluminationOptions(33));
  const viewer::gl::EglContext context;
  viewer::Renderer renderer(inputs);
  const DrawnPasses drawn(renderer);
  viewer::renderView(renderer, view, 1);
  EXPECT_EQ(drawn.shadowViews(), 7u);  // A cube and a cone.
  viewer::renderView(renderer, view, 1);
  EXPECT_EQ(drawn.shadowViews(), 0u);
  view.camera.world[3].x += 0.1;
  view.lights[1].intensity *= 2.0f;
  viewer::renderView(renderer, view, 1);
  EXPECT_EQ(drawn.shadowViews(), 0u);
  view.lights[1].position.x += 0.1;
  viewer::renderView(renderer, view, 1);
  EXPECT_EQ(drawn.shadowViews(), 1u);
  EXPECT_EQ(drawn.faces(), 0u);
  EXPECT_FALSE(renderer.plan(view)[1].runs);
}

TEST(GlobalIlluminationShading, PacedUpdates_ComeToThePictureOfAllAtOnce) {
  IlluminatedScene scene = floorUnderLamp();
  const viewer::RenderInputs inputs = scene.inputs();
  const viewer::View view = viewer::makeView(inputs, globalIlluminationOptions(33));
  const viewer::gl::EglContext context;
  viewer::Renderer renderer(inputs);
  const DrawnPasses drawn(renderer);
  viewer::renderView(renderer, view, 1);
  renderer.paceUpdates(true);
  for (std::uint32_t v = 4; v < 8; ++v) scene.quad.compiled.positions[v].x += 0.7f;  // Moves the lamp.
  renderer.sceneMoved();
  viewer::renderView(renderer, view, 1);
  EXPECT_LT(drawn.shadowViews(), 60u);
  EXPECT_TRUE(renderer.isBehind());
  int pictures = 1;
  for (; renderer.isBehind() && pictures < 100; ++pictures) viewer::renderView(renderer, view, 1);
  EXPECT_LT(pictures, 20);
  const Picture paced = viewer::renderView(renderer, view, 1);
  EXPECT_EQ(drawn.shadowViews(), 0u);
  viewer::Renderer afresh(inputs);
  EXPECT_EQ(viewer::renderView(afresh, view, 1).pixels, paced.pixels);
}

TEST(GlobalIlluminationShading, SceneWithoutLight_DrawsNoShadowMapAndSaysSo) {
  IlluminatedScene scene = floorAndShade(lambertian(glm::vec3(1.0f)));
  const viewer::RenderInputs inputs = scene.inputs();
  viewer::View view = viewer::makeView(inputs, globalIlluminationOptions(33));
  view.lights.front().intensity = glm::vec3(0.0f);
  const viewer::gl::EglContext context;
  viewer::Renderer renderer(inputs);
  const DrawnPasses drawn(renderer);
  EXPECT_EQ(largest(viewer::renderView(renderer, view, 1)), 0.0);
  EXPECT_EQ(drawn.shadowViews(), 0u);
  EXPECT_FALSE(renderer.plan(view)[0].runs);
}

TEST(GlobalIlluminationShading, MovedScene_TakesItsShadowsAlong) {
  IlluminatedScene scene = floorAndShade(lambertian(glm::vec3(1.0f)));
  const viewer::RenderInputs inputs = scene.inputs();
  const viewer::View view = viewer::makeView(inputs, globalIlluminationOptions(65));
  const viewer::gl::EglContext context;
  viewer::Renderer renderer(inputs);
  EXPECT_EQ(pixelAt(viewer::renderView(renderer, view, 1)).r, 0.0f);
  for (glm::vec3& position : scene.quad.compiled.positions)
    if (position.y + static_cast<float>(scene.quad.compiled.origin.y) > 0.5f) position.x += 1.4f;
  renderer.sceneMoved();
  EXPECT_GT(pixelAt(viewer::renderView(renderer, view, 1)).r, 0.3f);
}

TEST(GlobalIlluminationShading, EmptyScene_IsItsSky) {
  IlluminatedScene scene;
  scene.quad.setSky(constantEnvironment(glm::vec3(0.5f)));
  scene.quad.lookFrom({0, 0, 3}, {0, 0, 0});
  scene.quad.compile();
  scene.globalIllumination.indirect.values.clear();
  expectColor(pixelAt(scene.render(globalIlluminationOptions(33))), glm::dvec3(0.5), 1e-4);
}

TEST(GlobalIlluminationShading, LightOfAnotherScene_IsRefused) {
  IlluminatedScene scene = floorAndShade(lambertian(glm::vec3(1.0f)));
  scene.globalIllumination.indirect.layout.chartOf.pop_back();
  EXPECT_THROW(scene.render(globalIlluminationOptions(33)), Error);
}

}  // namespace
}  // namespace prelight
