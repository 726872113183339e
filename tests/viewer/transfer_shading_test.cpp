// Pictures through transfer in every form that is drawn, against closed forms, the host and one another.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "basis/ch.h"
#include "basis/haar.h"
#include "basis/haar_relight.h"
#include "basis/sh.h"
#include "support/devices.h"
#include "viewer/illumination.h"
#include "viewer/quad_scene.h"

namespace prelight {
namespace {

using namespace test;
using viewer::Shading;

constexpr double pi = std::numbers::pi;

Light makeLight(LightType type, const glm::vec3& intensity, const glm::dvec3& position,
                const glm::dvec3& direction = {0, 0, -1}) {
  Light light;
  light.type = type;
  light.intensity = intensity;
  light.position = position;
  light.direction = glm::normalize(direction);
  return light;
}

/// Open transfer of normals that differ from vertex to vertex and channel to channel: every coefficient and
/// every vertex counts, and nothing falls below zero much.
HarmonicTransfer tiltedTransfer(std::size_t vertices, int order, int channels) {
  HarmonicTransfer transfer{order, channels, channels == 3 ? 1 : 0, {}};
  std::vector<double> values(sh::coefficientCount(order));
  for (std::size_t v = 0; v < vertices; ++v) {
    for (int c = 0; c < channels; ++c) {
      const double turn = 0.9 * static_cast<double>(v) + 0.5 * c;
      sh::openTransfer(glm::normalize(glm::dvec3(0.4 * std::cos(turn), 0.4 * std::sin(turn), 1.0)), order,
                       values);
      for (const double value : values)
        transfer.coefficients.push_back(static_cast<float>((0.9 - 0.2 * c) * value));
    }
  }
  return transfer;
}

/// A quad that fills the picture, with a sky of many colours, a directional light and, when asked for, a
/// light at a finite distance.
QuadScene litQuad(bool nearLight) {
  QuadScene quad;
  quad.add(lambertian({0.9f, 0.7f, 0.5f}));
  quad.lookFrom({0, 0, 2}, {0, 0, 0});
  quad.setSky(halvedSky());
  quad.scene.lights = {makeLight(LightType::Directional, {1, 2, 3}, {}, {0.2, -0.5, -1})};
  if (nearLight) quad.scene.lights.push_back(makeLight(LightType::Point, {3, 2, 1}, {0.5, 0.5, 1.0}));
  quad.compile();
  return quad;
}

double largest(const Picture& picture) {
  float most = 0.0f;
  for (const glm::vec3& pixel : picture.pixels) most = std::max({most, pixel.r, pixel.g, pixel.b});
  return most;
}

double largestDifference(const Picture& a, const Picture& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const glm::vec3 d = glm::abs(a.pixels[i] - b.pixels[i]);
    most = std::max({most, double(d.r), double(d.g), double(d.b)});
  }
  return most;
}

void expectColor(const glm::vec3& got, const glm::dvec3& expected, double tolerance) {
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(got[c], expected[c], tolerance * std::max(1e-3, expected[c])) << "channel " << c;
  }
}

/// Mean radiance before albedo of the four corners: what the middle of a quad shows, up to its diagonal.
glm::dvec3 onDiagonal(const std::vector<glm::dvec3>& corners) { return 0.5 * (corners[0] + corners[2]); }

TEST(ChShading, CoefficientsOfTheSameTransfer_ShowWhatShShows) {
  for (const int order : {1, 3, 6, 14, 32}) {
    for (const int channels : {1, 3}) {
      for (const bool windowed : {true, false}) {
        QuadScene quad = litQuad(true);
        const HarmonicTransfer sh = tiltedTransfer(4, order, channels);
        HarmonicTransfer ch = sh;
        const ch::Basis basis(order);
        const std::size_t count = static_cast<std::size_t>(order * order);
        for (std::size_t at = 0; at < ch.coefficients.size(); at += count) {
          const auto row = std::span(ch.coefficients).subspan(at, count);
          basis.fromSh(row, row);
        }
        quad.bake.sh = sh;
        quad.bake.ch = ch;
        viewer::RenderOptions options = square(Shading::Sh);
        options.windowLights = windowed;
        options.skyRotation = 0.7;
        const Picture inSh = quad.render(options);
        options.shading = Shading::Ch;
        const Picture inCh = quad.render(options);
        EXPECT_LT(largestDifference(inSh, inCh), 1e-5 * largest(inSh)) << order << ' ' << channels;
        EXPECT_GT(largest(inSh), 0.1);
      }
    }
  }
}

TEST(ChShading, NaiveTransfer_ShowsTheErrorOfNaiveProjectionAndSaysSo) {
  constexpr int order = 6;
  QuadScene quad = litQuad(false);
  quad.scene.lights.clear();
  quad.setSky(constantEnvironment(glm::vec3(1)));
  HarmonicTransfer naive = tiltedTransfer(4, order, 1);
  const std::vector<float> sh(naive.coefficients);
  const ch::Basis basis(order);
  for (std::size_t at = 0; at < sh.size(); at += 36)
    basis.momentsFromSh(std::span(sh).subspan(at, 36), std::span(naive.coefficients).subspan(at, 36));
  naive.naive = true;
  quad.bake.ch = naive;
  Warnings notes;
  const glm::vec3 pixel =
      pixelAt(viewer::renderPicture(quad.inputs(), square(Shading::Ch), notes)) / glm::vec3(0.9f, 0.7f, 0.5f);

  // Moments times moments, at the two corners of the diagonal.
  std::vector<double> sky(36, 0.0);
  sky[0] = std::sqrt(4.0 * pi);
  basis.momentsFromSh(sky, sky);
  double expected = 0.0;
  for (int i = 0; i < 36; ++i)
    expected += 0.5 * sky[i] * (double(naive.coefficients[i]) + naive.coefficients[72 + i]);
  expectColor(pixel, glm::dvec3(expected), 1e-4);
  EXPECT_GT(std::abs(expected - 0.9), 0.05);  // an exact projection shows 0.9
  EXPECT_THAT(notes, testing::Contains(testing::HasSubstr("naively")));
}

class CompressedShading : public testing::TestWithParam<const char*> {};

TEST_P(CompressedShading, DecodedInTheShader_ShowsWhatTheDecompressedTransferShows) {
  const CompressionRequest request = parseCompression(GetParam());
  // What vertices share is lit once a light, for lights that are alike everywhere.
  const bool clustered =
      request.method != CompressionMethod::Half && request.method != CompressionMethod::Band8;
  for (const int channels : {1, 3}) {
    QuadScene quad = litQuad(!clustered);
    quad.bake.compressedSh = compress(tiltedTransfer(4, 5, channels), request);
    const Picture compressed = quad.render(square(Shading::Sh));
    quad.bake.sh = decompress(*quad.bake.compressedSh);
    quad.bake.compressedSh.reset();
    const Picture plain = quad.render(square(Shading::Sh));
    EXPECT_LT(largestDifference(compressed, plain), 1e-5 * largest(plain)) << channels;
    EXPECT_GT(largest(plain), 0.1);
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, CompressedShading,
                         testing::Values("half", "band8", "pca:2:float", "pca:2:half", "pca:2:byte", "vq:2",
                                         "cpca:2:1:float", "cpca:2:1:half", "cpca:2:1:byte"));

/// Wavelet transfer of open surfaces, without any loss.
HaarTransfer openWavelets(const std::vector<glm::vec3>& normals, int faceSize, int channels) {
  HaarTransfer transfer{faceSize, channels, 0, {0}, {}, {}};
  const CubeTexels texels(faceSize);
  std::vector<float> row(texels.count());
  for (const glm::vec3& normal : normals) {
    for (int c = 0; c < channels; ++c) {
      texels.open(glm::dvec3(normal), row);
      haar::forward(row, faceSize);
      haar::appendRow(transfer, haar::keepError(row, 0.0));
    }
  }
  return transfer;
}

TEST(HaarShading, OpenSurface_UnderSkiesAndDirectionalLights_MatchesTheClosedForm) {
  for (const int channels : {1, 3}) {
    QuadScene quad = litQuad(false);
    quad.scene.lights.clear();
    quad.bake.haar = openWavelets(quad.compiled.normals, 32, channels);
    viewer::RenderOptions options = square(Shading::Haar);
    options.skyRotation = -0.5 * pi;  // the red half to +Z, what the quad faces
    // Blue comes from the upper half of the sky, half of what the quad sees.
    expectColor(pixelAt(quad.render(options)), {0.9, 0.0, 0.25}, 2e-3);

    quad.hasEnvironment = false;
    options.lights = {{makeLight(LightType::Directional, {3, 3, 3}, {}, {0.3, -0.4, -1})}};
    const double e = 3.0 / std::sqrt(1.25) / pi;
    expectColor(pixelAt(quad.render(options)), {0.9 * e, 0.7 * e, 0.5 * e}, 3e-3);
  }
}

TEST(HaarShading, FewTerms_AreTheLightsMostImportantOnes) {
  QuadScene quad = litQuad(false);
  quad.scene.lights.clear();
  quad.bake.haar = openWavelets(quad.compiled.normals, 16, 1);
  viewer::RenderOptions options = square(Shading::Haar);
  options.haarTerms = 5;
  options.skyRotation = 0.4;
  const auto light = haar::transformLight(cubeFromEnvironment(viewer::turnedSky(quad.environment, 0.4), 16));
  const auto kept = haar::selectLight(light, haar::coefficientRms(*quad.bake.haar), 5);
  const glm::dvec3 expected =
      glm::dvec3(0.9, 0.7, 0.5) * glm::max(onDiagonal(haar::relight(*quad.bake.haar, kept)), 0.0);
  expectColor(pixelAt(quad.render(options)), expected, 1e-4);
  const glm::dvec3 whole = glm::dvec3(0.9, 0.7, 0.5) * onDiagonal(haar::relight(*quad.bake.haar, light));
  EXPECT_GT(glm::length(whole - expected), 1e-3);
}

/// Matrices of open surfaces: products of the cosine and of the basis, exact.
GlossyTransfer openMatrices(const std::vector<glm::vec3>& normals, int order, int channels) {
  GlossyTransfer transfer{order, channels, 0, {}};
  const int cosineOrder = 2 * order - 1;
  std::vector<double> cosine(sh::coefficientCount(cosineOrder));
  for (const glm::vec3& normal : normals) {
    sh::openTransfer(glm::dvec3(normal), cosineOrder, cosine);
    const std::vector<double> matrix = sh::productMatrix(cosine, cosineOrder, order);
    for (int c = 0; c < channels; ++c)
      for (const double value : matrix) transfer.matrices.push_back(static_cast<float>(value));
  }
  return transfer;
}

Material glossyMaterial(float roughness, float metallic) {
  Material material;
  material.baseColor = {0.8f, 0.6f, 0.4f, 1.0f};
  material.metallic = metallic;
  material.roughness = roughness;
  return material;
}

/// The split-sum fit that shaders/specular.glsl cites, written down again.
glm::dvec3 splitSum(const glm::dvec3& f0, double roughness, double nv) {
  const double r[4] = {1.0 - roughness, 0.0425 - 0.0275 * roughness, 1.04 - 0.572 * roughness,
                       0.022 * roughness - 0.04};
  const double a = std::min(r[0] * r[0], std::exp2(-9.28 * nv)) * r[0] + r[1];
  return f0 * (r[2] - 1.04 * a) + glm::dvec3(r[3] + 1.04 * a);
}

TEST(GlossyShading, OpenSurfaceInAWhiteFurnace_ShowsAlbedoPlusDirectionalReflectance) {
  for (const int order : {1, 2, 4, 6, 8}) {
    for (const float roughness : {0.0f, 0.3f, 0.71f, 1.0f}) {
      for (const float metallic : {0.0f, 1.0f}) {
        QuadScene quad;
        quad.add(glossyMaterial(roughness, metallic));
        const glm::dvec3 eye(0.9, 0.5, 1.8);
        quad.lookFrom(eye, {0, 0, 0});
        quad.setSky(constantEnvironment(glm::vec3(2)));
        quad.compile();
        quad.bake.glossy = openMatrices(quad.compiled.normals, order, 1);
        const glm::dvec3 base(0.8, 0.6, 0.4);
        const glm::dvec3 f0 = metallic > 0.0f ? base : glm::dvec3(0.04);
        const glm::dvec3 albedo = metallic > 0.0f ? glm::dvec3(0.0) : base;
        const glm::dvec3 expected = 2.0 * (albedo + splitSum(f0, roughness, eye.z / glm::length(eye)));
        // Rows and columns of pixels are off the centre by up to a pixel of 33, which the view's angle feels.
        expectColor(pixelAt(quad.render(square(Shading::Glossy, 129))), expected, 2e-3);
      }
    }
  }
}

TEST(GlossyShading, DiffusePart_IsWhatShOfTheSameOrderShows) {
  for (const int channels : {1, 3}) {
    QuadScene quad = litQuad(false);
    quad.bake.glossy = openMatrices(quad.compiled.normals, 4, channels);
    quad.bakeOpen(4, channels);
    const Picture sh = quad.render(square(Shading::Sh));
    EXPECT_LT(largestDifference(quad.render(square(Shading::Glossy)), sh), 1e-5 * largest(sh));
  }
}

/// Sum over the hemisphere of +Z and its other side, `steps` by 2 steps equal parts in z and azimuth.
template <typename Function>
double integrate(int steps, const Function& f) {
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double z = (2.0 * i + 1.0) / steps - 1.0;
    const double radius = std::sqrt(1.0 - z * z);
    for (int k = 0; k < 2 * steps; ++k) {
      const double phi = pi * (k + 0.5) / steps;
      sum += f(glm::dvec3(radius * std::cos(phi), radius * std::sin(phi), z));
    }
  }
  return sum * 4.0 * pi / (2.0 * steps * steps);
}

TEST(GlossyShading, PhongLobeInTheOpen_IsTheIntegralOfLobeCosineAndShLight) {
  constexpr int order = 6;
  constexpr int count = order * order;
  constexpr float roughness = 0.75f;  // a step of the table
  QuadScene quad;
  quad.add(glossyMaterial(roughness, 1.0f));
  const glm::dvec3 eye(0.8, 0.3, 1.7);
  quad.lookFrom(eye, {0, 0, 0});
  quad.setSky(halvedSky());
  quad.compile();
  quad.bake.glossy = openMatrices(quad.compiled.normals, order, 3);
  viewer::RenderOptions options = square(Shading::Glossy, 129);
  options.lobe = viewer::Lobe::Phong;
  const glm::vec3 pixel = pixelAt(quad.render(options));

  const double exponent = 2.0 / std::pow(roughness, 4) - 2.0;
  const glm::dvec3 mirrored = glm::normalize(glm::dvec3(-eye.x, -eye.y, eye.z));
  const auto lobe = [&](const glm::dvec3& w) {
    return (exponent + 2.0) / (2.0 * pi) * std::pow(std::max(glm::dot(w, mirrored), 0.0), exponent);
  };
  std::vector<double> basis(count);
  std::vector<double> lobeCoefficients(count, 0.0);
  for (int i = 0; i < count; ++i) {
    lobeCoefficients[i] = integrate(200, [&](const glm::dvec3& w) {
      sh::evaluate(w, order, basis);
      return lobe(w) * basis[i];
    });
  }
  const std::vector<double> light = sh::projectEnvironment(quad.environment, order);
  const glm::dvec3 f0(0.8f, 0.6f, 0.4f);
  glm::dvec3 expected(0.0);
  for (int c = 0; c < 3; ++c) {
    expected[c] = f0[c] * integrate(200, [&](const glm::dvec3& w) {
                    sh::evaluate(w, order, basis);
                    double f = 0.0;
                    double l = 0.0;
                    for (int i = 0; i < count; ++i) {
                      f += lobeCoefficients[i] * basis[i];
                      l += light[c * count + i] * basis[i];
                    }
                    return std::max(w.z, 0.0) * f * l;
                  });
  }
  ASSERT_GT(expected.r + expected.g, 0.1);
  expectColor(pixel, expected, 4e-3);
}

TEST(GlossyShading, PhongLobeAlongTheNormalOfAnEvenSky_ReflectsItsF0) {
  QuadScene quad;
  quad.add(glossyMaterial(0.75f, 1.0f));
  quad.lookFrom({0, 0, 2}, {0, 0, 0});
  quad.setSky(constantEnvironment(glm::vec3(1)));
  quad.compile();
  quad.bake.glossy = openMatrices(quad.compiled.normals, 8, 1);
  viewer::RenderOptions options = square(Shading::Glossy);
  options.lobe = viewer::Lobe::Phong;
  expectColor(pixelAt(quad.render(options)), {0.8, 0.6, 0.4}, 1e-3);
}

TEST(Relighting, OnADevice_ShowsWhatTheHostShows) {
  QuadScene quad = litQuad(true);
  quad.bake.haar = openWavelets(quad.compiled.normals, 16, 3);
  quad.bake.glossy = openMatrices(quad.compiled.normals, 4, 3);
  for (const Shading shading : {Shading::Haar, Shading::Glossy}) {
    viewer::RenderInputs inputs = quad.inputs();
    Warnings notes;
    const Picture onHost = viewer::renderPicture(inputs, square(shading), notes);
    inputs.device = &sharedDevice();
    const Picture onDevice = viewer::renderPicture(inputs, square(shading), notes);
    EXPECT_LT(largestDifference(onHost, onDevice), 1e-5 * largest(onHost)) << shadingName(shading);
    EXPECT_THAT(notes, testing::Contains(testing::HasSubstr("as seen from its centre")));
  }
}

/// A quad with two groups: 0.5 and 0.25 of their colours everywhere.
QuadScene groupedQuad(int channels) {
  QuadScene quad;
  quad.add(lambertian({0.9f, 0.7f, 0.5f}));
  quad.lookFrom({0, 0, 2}, {0, 0, 0});
  quad.scene.lights = {makeLight(LightType::Point, {10, 10, 10}, {0, 0, 3})};
  quad.compile();
  LightGroupTransfer transfer{{{"lamp", {2, 3, 4}}, {"sign", {8, 0, 4}}}, channels, 0, {}};
  for (int v = 0; v < 4; ++v) {
    for (int c = 0; c < channels; ++c) {
      const float factor = channels == 1 ? 1.0f : 1.0f - 0.25f * static_cast<float>(c);
      transfer.coefficients.insert(transfer.coefficients.end(), {0.5f * factor, 0.25f * factor});
    }
  }
  quad.bake.lightGroups = transfer;
  return quad;
}

TEST(LightsShading, Groups_AddUpToAlbedoColourFactorAndTransfer) {
  viewer::RenderOptions options = square(Shading::Lights);
  expectColor(pixelAt(groupedQuad(1).render(options)), {0.9 * 3, 0.7 * 1.5, 0.5 * 3}, 1e-5);
  expectColor(pixelAt(groupedQuad(3).render(options)), {0.9 * 3, 0.7 * 0.75 * 1.5, 0.5 * 0.5 * 3}, 1e-5);
  options.groups = {{"lamp", {0, 0, 0}}, {"sign", {0.5f, 1, 2}}};
  expectColor(pixelAt(groupedQuad(1).render(options)), {0.9 * 1, 0, 0.5 * 2}, 1e-5);
}

TEST(LightsShading, UnknownGroup_IsAnErrorThatListsThem) {
  viewer::RenderOptions options = square(Shading::Lights);
  options.groups = {{"lamb", glm::vec3(2)}};
  try {
    groupedQuad(1).render(options);
    FAIL() << "no error";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("lamb"), testing::HasSubstr("lamp, sign")));
  }
}

TEST(LightsShading, EmissiveNodeOfAGroup_GlowsByItsFactor) {
  QuadScene quad;
  Material lamp = lambertian(glm::vec3(0));
  lamp.emission = {4, 2, 1};
  quad.add(lamp);
  quad.scene.meshNodes[0].name = "lamp";
  quad.lookFrom({0, 0, 2}, {0, 0, 0});
  quad.compile();
  quad.bake.lightGroups = LightGroupTransfer{{{"lamp", {4, 2, 1}}}, 1, 0, {0, 0, 0, 0}};
  viewer::RenderOptions options = square(Shading::Lights);
  expectColor(pixelAt(quad.render(options)), {4, 2, 1}, 1e-5);
  options.groups = {{"lamp", {0.5f, 2, 3}}};
  expectColor(pixelAt(quad.render(options)), {2, 4, 3}, 1e-5);
}

TEST(AoShading, Interreflection_BrightensByTheAlbedoAChannel) {
  QuadScene quad;
  quad.add(lambertian({0.9f, 0.5f, 0.0f}));
  quad.lookFrom({0, 0, 2}, {0, 0, 0});
  quad.setSky(constantEnvironment(glm::vec3(1)));
  quad.compile();
  quad.bakeOpen(2, 1, 0.4f);
  viewer::RenderOptions options = square(Shading::Ao);
  expectColor(pixelAt(quad.render(options)), {0.9 * 0.4, 0.5 * 0.4, 0}, 1e-4);
  options.aoCorrection = viewer::AoCorrection::Interreflection;
  expectColor(pixelAt(quad.render(options)), {0.9 * 0.4 / (1 - 0.9 * 0.6), 0.5 * 0.4 / (1 - 0.5 * 0.6), 0},
              1e-4);
}

}  // namespace
}  // namespace prelight
