#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gpu/film_table.h"
#include "support/shot.h"

// Lobes of glTF's material extensions in renderers that follow light, against closed forms.
namespace prelight::test {
namespace {

constexpr double sunIrradiance = 3.0;  // W/m2.

Light sunDown(const glm::dvec3& direction) {
  Light light;
  light.type = LightType::Directional;
  light.intensity = glm::vec3(static_cast<float>(sunIrradiance));
  light.direction = glm::normalize(direction);
  return light;
}

/// A square in the plane y = 0, seen from straight above. Its texture coordinates are `u` times x, and z.
Shot brushedPlate(double u, float roughness, const Anisotropy& anisotropy) {
  CompiledScene scene = ground(1, 1.0f);
  for (std::size_t i = 0; i < scene.positions.size(); ++i)
    scene.texCoords[i] = {static_cast<float>(u) * scene.positions[i].x, scene.positions[i].z};
  Shot shot = shotOf(std::move(scene), orthographicCamera({0, 1, 0}, {0, 0, 0}, 0.5), 4, 4);
  shot.scene.materials[0] = metal(0.04f, roughness);  // Dark, so that later bounces add little.
  shot.scene.materials[0].anisotropy = anisotropy;
  return shot;
}

/// The extension's formula for a metal that reflects 0.04 along its normal y, seen along the normal, with the
/// rougher direction along `t`.
double brushedRadiance(double roughness, double amount, const glm::dvec3& t, const glm::dvec3& toLight) {
  const glm::dvec3 n(0, 1, 0), b = glm::cross(n, t), h = glm::normalize(n + toLight);
  const double ab = roughness * roughness, at = ab + (1.0 - ab) * amount * amount;
  const glm::dvec3 f(ab * glm::dot(t, h), at * glm::dot(b, h), at * ab * h.y);
  const double w2 = at * ab / glm::dot(f, f), d = at * ab * w2 * w2 / std::numbers::pi;
  const double light =
      glm::length(glm::dvec3(at * glm::dot(t, toLight), ab * glm::dot(b, toLight), toLight.y));
  const double visible = 0.5 / (toLight.y + light), fresnel = 0.04 + 0.96 * std::pow(1.0 - h.y, 5.0);
  return sunIrradiance * toLight.y * fresnel * d * visible;
}

void expectBrushed(const Shot& shot, double amount, const glm::dvec3& t) {
  const double expected =
      brushedRadiance(double(shot.scene.materials[0].roughness), amount, t, -shot.lights[0].direction);
  for (const glm::vec3& pixel : shot.render().picture().pixels)
    EXPECT_NEAR(pixel.x, 1.022 * expected, 0.024 * expected) << shot.lights[0].direction.x;
}

const std::array suns{glm::dvec3(-0.3, -1.0, 0.05), glm::dvec3(0.05, -1.0, 0.3), glm::dvec3(0.2, -1.0, 0.2)};

TEST(AnisotropicMetal, IsRougherAlongU) {
  for (const double u : {1.0, -1.0})
    for (const glm::dvec3& sun : suns) {
      Anisotropy anisotropy;
      anisotropy.strength = 0.7f;
      Shot shot = brushedPlate(u, 0.4f, anisotropy);
      shot.lights = {sunDown(sun)};
      expectBrushed(shot, 0.7, glm::dvec3(u, 0, 0));
    }
}

// Rotation turns from the tangent to the bitangent, along which v falls: here towards -z, mirrored or not.
TEST(AnisotropicMetal, RotationAndTexture_TurnTheWayTowardsTheBitangent) {
  const double angle = 0.5;
  for (const double u : {1.0, -1.0})
    for (const glm::dvec3& sun : suns) {
      Anisotropy anisotropy;
      anisotropy.strength = 0.7f;
      anisotropy.rotation = static_cast<float>(angle);
      Shot shot = brushedPlate(u, 0.4f, anisotropy);
      shot.lights = {sunDown(sun)};
      expectBrushed(shot, 0.7, glm::dvec3(u * std::cos(angle), 0, -std::sin(angle)));
      // A texel with another direction and half the strength.
      shot.images = {{"way", 1, 1, {230, 60, 128, 255}}};
      shot.scene.materials[0].anisotropy.texture.image = 0;
      const glm::dvec2 way = glm::normalize(2.0 * glm::dvec2(230, 60) / 255.0 - 1.0);
      const double turned = angle + std::atan2(way.y, way.x);
      expectBrushed(shot, 0.7 * 128.0 / 255.0, glm::dvec3(u * std::cos(turned), 0, -std::sin(turned)));
    }
}

// A texel without a direction, as nearly as bytes allow: the lobe is isotropic, wherever the light comes
// from.
TEST(AnisotropicMetal, WithoutADirection_IsEven) {
  Anisotropy anisotropy;
  anisotropy.strength = 0.7f;
  Shot shot = brushedPlate(1.0, 0.4f, anisotropy);
  shot.images = {{"way", 1, 1, {128, 127, 255, 255}}};
  shot.scene.materials[0].anisotropy.texture.image = 0;
  for (const glm::dvec3& sun : suns) {
    shot.lights = {sunDown(sun)};
    expectBrushed(shot, 0.0, {1, 0, 0});
  }
}

/// A slab of glass one metre thick over a strip that emits 1, seen along a slope of 45 degrees.
Shot slabOverStrip(float dispersion, double from, double to, std::uint64_t samples) {
  CompiledScene scene = box(1, {-8, 0, -8}, {8, 1, 8}, false);
  append(scene, sceneOf({{float(from), -1e-3f, -8},
                         {float(from), -1e-3f, 8},
                         {float(to), -1e-3f, 8},
                         {float(to), -1e-3f, -8}},
                        {{0, 1, 2}, {0, 2, 3}}));
  scene.triangleFlat.assign(scene.triangles.size(), 1);
  // The ray enters at x = 0 and is bent towards the normal.
  const glm::dvec3 eye(-1.0, 2.0, 0.0);
  Shot shot = shotOf(std::move(scene), orthographicCamera(eye, {0, 1, 0}, 1e-4), 8, samples);
  shot.scene.materials = {glass(1.5f, true), emitter(glm::vec3(1.0f))};
  for (std::size_t t = 12; t < shot.scene.triangles.size(); ++t) shot.scene.triangleMaterials[t] = 1;
  shot.scene.materials[0].dispersion = dispersion;
  shot.request.depth = 12;
  return shot;
}

double fresnelOf(double cosine, double eta) {
  const double beyond = std::sqrt(1.0 - (1.0 - cosine * cosine) / (eta * eta));
  const double s = (cosine - eta * beyond) / (cosine + eta * beyond),
               p = (eta * cosine - beyond) / (eta * cosine + beyond);
  return 0.5 * (s * s + p * p);
}

/// The mean of each channel and its standard error.
std::array<MeanAndError, 3> channelsOf(const reference::Film& film) {
  std::array<MeanAndError, 3> means;
  const Picture picture = film.picture();
  for (int c = 0; c < 3; ++c) {
    double sum = 0.0, squares = 0.0;
    for (const glm::vec3& pixel : picture.pixels) {
      sum += double(pixel[c]);
      squares += double(pixel[c]) * double(pixel[c]);
    }
    const double count = double(picture.pixels.size());
    means[std::size_t(c)].mean = sum / count;
    means[std::size_t(c)].error =
        std::sqrt(std::max(squares / count - sum * sum / count / count, 0.0) / count);
  }
  return means;
}

// Colour of the strip by wavelength: the extension's index of refraction decides what each wavelength meets,
// and the renderer's documented colours of wavelengths (docs/notes/reference.md) sum it up.
TEST(Dispersion, SlabOverAStrip_ShowsTheColoursThatMeetIt) {
  constexpr float dispersion = 4.0f;
  const double slope = std::sqrt(0.5), middle = std::tan(std::asin(slope / 1.5));
  for (const auto& [first, last] : {std::pair(-0.2, 0.2), std::pair(-0.03, -0.01), std::pair(0.0, 0.02)}) {
    const double from = middle + first, to = middle + last;
    glm::dvec3 expected(0.0);
    constexpr int steps = 20000;
    for (int i = 0; i < steps; ++i) {
      const double chance = (i + 0.5) / steps, wave = 430.0 + 240.0 * chance, x = 2.0 * chance - 1.0;
      const double ior = 1.5 + 0.5 * double(dispersion) / 20.0 * (523655.0 / (wave * wave) - 1.5168);
      const double place = std::tan(std::asin(slope / ior)) + 1e-3;
      if (place < from || place > to) continue;
      const double passes = (1.0 - fresnelOf(slope, 1.5)) * (1.0 - fresnelOf(slope, ior));
      expected += passes / steps *
                  glm::dvec3(4.0 * std::max(x, 0.0), 2.0 - 2.0 * std::abs(x), 4.0 * std::max(-x, 0.0));
    }
    const auto found = channelsOf(slabOverStrip(dispersion, from, to, 4096).render());
    for (int c = 0; c < 3; ++c) {
      const MeanAndError& channel = found[std::size_t(c)];
      EXPECT_NEAR(channel.mean, expected[c], 5.0 * channel.error + 0.03 * expected[c] + 2e-3)
          << first << ' ' << c;
    }
  }
}

/// A glass ball that fills the picture.
Shot dispersiveBall(float dispersion, float roughness, std::uint64_t samples) {
  CompiledScene ball = sphere(12, 1.0f, {0, 0, 0});
  ball.triangleFlat.assign(ball.triangles.size(), 1);
  Shot shot = shotOf(std::move(ball), orthographicCamera({0, 0, 5}, {0, 0, 0}, 0.6), 6, samples);
  shot.scene.materials[0] = glass(1.5f, true);
  shot.scene.materials[0].dispersion = dispersion;
  shot.scene.materials[0].roughness = roughness;
  shot.sky = constantEnvironment(glm::vec3(1.0f));
  shot.request.depth = 100;
  return shot;
}

TEST(Dispersion, GlassUnderAnEvenSky_IsAsWhite) {
  for (const float roughness : {0.0f, 0.3f}) {
    const auto found = channelsOf(dispersiveBall(1.0f, roughness, 4096).render());
    for (const MeanAndError& channel : found)
      EXPECT_NEAR(channel.mean, 1.0, 5.0 * channel.error + (roughness > 0.0f ? 8e-3 : 2e-3));
  }
}

// Glass with KHR_materials_specular has its own reflectances along the normal.
TEST(SpecularGlass, ThinSheetSeenFromAbove_ReflectsAndPassesByItsFactors) {
  Shot shot = shotOf(ground(1, 1.0f), orthographicCamera({0, 1, 0}, {0, 0, 0}, 0.1), 4, 4096);
  shot.scene.materials[0] = glass(1.5f, false);
  shot.scene.materials[0].specular = 0.5f;
  shot.scene.materials[0].specularColor = {1.0f, 0.5f, 0.0f};
  shot.sky = constantEnvironment(glm::vec3(1.0f));
  const auto found = channelsOf(shot.render());
  const auto both = [](double f) { return 2.0 * f / (1.0 + f); };
  const glm::dvec3 reflected(both(0.02), both(0.01), 0.0);
  // The transmittance is one minus the reflectance of the most reflective channel.
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(found[std::size_t(c)].mean, reflected[c] + 1.0 - reflected.x,
                5.0 * found[std::size_t(c)].error + 1e-4);
}

// Glass with KHR_materials_iridescence: the film's reflectance replaces Fresnel's.
TEST(FilmedGlass, ThinSheet_ReflectsAsTheFilmAndPassesTheRest) {
  for (const double angle : {0.0, 0.9, 1.3}) {
    Shot shot = shotOf(ground(1, 1.0f),
                       orthographicCamera({std::sin(angle), std::cos(angle), 0}, {0, 0, 0}, 0.05), 4, 4096);
    CompiledMaterial& m = shot.scene.materials[0] = glass(1.5f, false);
    m.iridescence.factor = 0.75f;
    m.iridescence.ior = 1.9f;
    m.iridescence.thicknessMaximum = 450.0f;
    shot.sky = constantEnvironment(glm::vec3(1.0f));
    const auto found = channelsOf(shot.render());
    const double cosine = std::cos(angle), within = std::sqrt(1.0 - std::pow(std::sin(angle) / 1.5, 2.0));
    const double s = (cosine - 1.5 * within) / (cosine + 1.5 * within),
                 p = (1.5 * cosine - within) / (1.5 * cosine + within);
    const glm::dvec3 once = glm::mix(glm::dvec3(0.5 * (s * s + p * p)),
                                     filmReflectance(cosine, 1.0, 1.9, 450.0, glm::dvec3(0.04)), 0.75);
    const glm::dvec3 reflected = 2.0 * once / (1.0 + once);
    EXPECT_GT(
        std::max({reflected.x, reflected.y, reflected.z}) - std::min({reflected.x, reflected.y, reflected.z}),
        0.02);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(found[std::size_t(c)].mean,
                  1.0 + reflected[c] - std::max({reflected.x, reflected.y, reflected.z}),
                  5.0 * found[std::size_t(c)].error + 1e-4);
  }
}

/// A path meets both faces of the slab at one angle. A channel reflects R; the most reflective channel, M,
/// determines the transmittance.
TEST(FilmedGlass, SlabUnderAnEvenSky_ReflectsBetweenItsFacesAsTheFilmTells) {
  CompiledScene slab = box(1, {-8, 0, -8}, {8, 1, 8}, false);
  slab.triangleFlat.assign(slab.triangles.size(), 1);
  Shot shot = shotOf(std::move(slab), orthographicCamera({-1, 2, 0}, {0, 1, 0}, 1e-4), 8, 4096);
  shot.scene.materials = {glass(1.5f, true)};
  CompiledMaterial& m = shot.scene.materials[0];
  m.iridescence.factor = 1.0f;
  m.iridescence.ior = 1.9f;
  m.iridescence.thicknessMaximum = 450.0f;
  shot.sky = constantEnvironment(glm::vec3(1.0f));
  shot.request.depth = 40;
  const glm::dvec3 r = filmReflectance(std::sqrt(0.5), 1.0, 1.9, 450.0, glm::dvec3(0.04));
  const double most = std::max({r.x, r.y, r.z});
  const auto found = channelsOf(shot.render());
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(found[std::size_t(c)].mean, r[c] + (1.0 - most) * (1.0 - most) / (1.0 - r[c]),
                5.0 * found[std::size_t(c)].error + 1e-3);
}

TEST(FilmedGlass, RoughBallUnderAnEvenSky_LosesLittle) {
  Shot shot = dispersiveBall(0.0f, 0.4f, 2048);
  shot.scene.materials[0].iridescence.factor = 1.0f;
  shot.scene.materials[0].iridescence.ior = 1.6f;
  shot.scene.materials[0].iridescence.thicknessMaximum = 400.0f;
  double most = 0.0;
  for (const MeanAndError& channel : channelsOf(shot.render())) {
    EXPECT_LT(channel.mean, 1.0 + 5.0 * channel.error + 8e-3);
    most = std::max(most, channel.mean);
  }
  EXPECT_GT(most, 0.96);  // No channel is the most reflective one at every angle.
}

// KHR_materials_clearcoat: the coat lies above the emitting surface.
TEST(CoatedEmitter, IsDimmedByWhatTheCoatReflects) {
  for (const double angle : {0.0, 1.0, 1.3}) {
    Shot shot = shotOf(ground(1, 1.0f),
                       orthographicCamera({std::sin(angle), std::cos(angle), 0}, {0, 0, 0}, 0.05), 4, 4);
    shot.scene.materials[0] = emitter(glm::vec3(5.0f));
    shot.scene.materials[0].clearcoat.factor = 0.8f;
    const double cosine = std::cos(angle), f = 0.04 + 0.96 * std::pow(1.0 - cosine, 5.0);
    for (const glm::vec3& pixel : shot.render().picture().pixels)
      EXPECT_NEAR(pixel.x, 5.0 * (1.0 - 0.8 * f), 1e-3);
  }
}

// The normal texture of the coat turns the coat's reflection, not the surface below.
TEST(CoatNormals, TurnTheMirrorOfTheCoatAlone) {
  CompiledScene scene = ground(1, 1.0f);
  for (std::size_t i = 0; i < scene.positions.size(); ++i)
    scene.texCoords[i] = {scene.positions[i].x, scene.positions[i].z};
  Shot shot = shotOf(std::move(scene), orthographicCamera({0, 1, 0}, {0, 0, 0}, 0.5), 4, 256);
  shot.images = {{"slope", 1, 1, {200, 128, 230, 255}}};
  shot.scene.materials[0] = lambert(0.0f);
  shot.scene.materials[0].clearcoat.factor = 1.0f;
  shot.scene.materials[0].clearcoat.normalTexture.image = 0;
  // The sky is lit in the direction of the turned reflection and dark elsewhere.
  const glm::dvec3 n = glm::normalize(2.0 * glm::dvec3(200, 230, 128) / 255.0 - 1.0);
  const double cosine = n.y, f = 0.04 + 0.96 * std::pow(1.0 - cosine, 5.0);
  const glm::dvec3 way = 2.0 * cosine * n - glm::dvec3(0, 1, 0);
  Environment sky = constantEnvironment(glm::vec3(0.0f));
  sky.width = 64;
  sky.height = 32;
  sky.radiance.assign(64 * 32, glm::vec3(0.0f));
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) {
      const double polar = std::numbers::pi * (y + 0.5) / 32,
                   turn = 2.0 * std::numbers::pi * ((x + 0.5) / 64 - 0.5);
      const glm::dvec3 w(std::sin(polar) * std::sin(turn), std::cos(polar),
                         -std::sin(polar) * std::cos(turn));
      if (glm::dot(w, way) > 0.9) sky.radiance[std::size_t(y * 64 + x)] = glm::vec3(1.0f);
    }
  shot.sky = sky;
  const double found = meanOf(shot.render()).mean;
  EXPECT_NEAR(found, f, 0.02 * f);
  shot.scene.materials[0].clearcoat.normalTexture.image = -1;
  EXPECT_LT(meanOf(shot.render()).mean, 0.02 * f);
}

}  // namespace
}  // namespace prelight::test
