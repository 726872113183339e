// Light of lamps at a finite distance through transfer, compared with closed forms.
#include "viewer/lights/receiver_lamps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "basis/ch.h"
#include "basis/sh_zonal.h"
#include "viewer/open_transfers.h"
#include "viewer/picture_checks.h"

namespace prelight {
namespace {

using namespace test;
using viewer::Shading;

using std::numbers::pi;

constexpr int order = 3;

SeenLamp lampAt(double cosine) { return {{0, 0, 1}, {3, 2, 1}, cosine, false}; }

double openOf(double cosine) { return sh::openTowards(cosine, order); }

TEST(ReceiverLamp, Open_ShinesAsItIsWhateverTheOrder) {
  for (const double cosine : {1.0, 0.7, 0.2}) {
    const double open = openOf(cosine);
    for (const bool sharp : {false, true}) {
      const glm::dvec3 light = lampThroughTransfer(lampAt(cosine), glm::dvec3(open), open, sharp);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(light[c], (3 - c) * cosine / pi, 1e-12);
    }
  }
}

TEST(ReceiverLamp, HalfBlocked_ShinesByHalf) {
  const double open = openOf(0.6);
  for (const bool sharp : {false, true})
    EXPECT_NEAR(lampThroughTransfer(lampAt(0.6), glm::dvec3(0.5 * open), open, sharp).x, 1.5 * 0.6 / pi,
                1e-12);
}

TEST(ReceiverLamp, SharpenedShare_EndsInShadowAndInLight) {
  const double open = openOf(0.6);
  const auto share = [&](double share, bool sharp) {
    return lampThroughTransfer(lampAt(0.6), glm::dvec3(share * open), open, sharp).x / (3.0 * 0.6 / pi);
  };
  EXPECT_NEAR(share(0.2, true), 0.0, 1e-12);
  EXPECT_NEAR(share(0.8, true), 1.0, 1e-12);
  EXPECT_NEAR(share(0.2, false), 0.2, 1e-12);
}

TEST(ReceiverLamp, Softness_IsThatOfWhatTheReceiverSees) {
  const glm::dvec3 point(0.0, 0.0, 0.0), normal(0.0, 0.0, 1.0);
  viewer::ShadedLight ball;
  ball.position = {0.0f, 0.0f, 10.0f};
  for (const auto& [radius, isSoft] : {std::pair(0.0f, false), {0.13f, false}, {0.15f, true}}) {
    ball.radius = radius;
    EXPECT_EQ(seenFrom(ball, point, normal).isSoft, isSoft) << radius;
  }
  viewer::ShadedLight sun;
  sun.kind = viewer::LightKind::Directional;
  for (const auto& [radius, isSoft] : {std::pair(0.0047f, false), {0.02f, true}}) {
    sun.radius = radius;
    EXPECT_EQ(seenFrom(sun, point, normal).isSoft, isSoft) << radius;
  }
}

TEST(ReceiverLamp, Bounces_AddToTheExactLightAndStayBehindTheHorizon) {
  const double open = openOf(0.6), bounced = 0.05;
  EXPECT_NEAR(lampThroughTransfer(lampAt(0.6), glm::dvec3(open + bounced), open, false).x,
              3.0 * (0.6 / pi + bounced), 1e-12);
  const double behind = openOf(-0.1);  // what truncation leaves there is no light
  EXPECT_GT(behind, 0.01);
  for (const double more : {0.0, bounced})
    EXPECT_NEAR(lampThroughTransfer(lampAt(-0.1), glm::dvec3(behind + more), behind, false).x, 3.0 * more,
                1e-12);
}

/// An open quad below a lamp that stands close to one of its corners, in all bases.
QuadScene quadByALamp(double openness, int channels) {
  QuadScene quad = litQuad(true);
  quad.hasEnvironment = false;
  quad.scene.lights = {makeLight(LightType::Point, {3, 2, 1}, {0.8, 0.6, 1.5})};
  HarmonicTransfer sh{order, channels, 0, {}};
  std::vector<double> open(order * order);
  for (const glm::vec3& normal : quad.compiled.normals) {
    sh::openTransfer(glm::dvec3(normal), order, open);
    for (int c = 0; c < channels; ++c)
      for (const double value : open) sh.coefficients.push_back(static_cast<float>(openness * value));
  }
  quad.bake.sh = sh;
  quad.bake.ch = sh;
  const ch::Basis basis(order);
  for (std::size_t at = 0; at < sh.coefficients.size(); at += open.size()) {
    const auto row = std::span(quad.bake.ch->coefficients).subspan(at, open.size());
    basis.fromSh(row, row);
  }
  quad.bake.haar = openWavelets(quad.compiled.normals, 32, channels);
  for (float& value : quad.bake.haar->values) value *= static_cast<float>(openness);
  quad.bake.glossy = openMatrices(quad.compiled.normals, order, channels);
  for (float& value : quad.bake.glossy->matrices) value *= static_cast<float>(openness);
  return quad;
}

/// Radiance at the middle of the quad, which lies between its corners 0 and 2.
glm::dvec3 middleOf(const QuadScene& quad) {
  glm::dvec3 sum(0.0);
  for (const std::size_t corner : {0, 2}) {
    const glm::dvec3 path = quad.scene.lights[0].position - glm::dvec3(quad.compiled.positions[corner]);
    const double distance = glm::length(path);
    sum += 0.5 * path.z / (distance * distance * distance) * glm::dvec3(quad.scene.lights[0].intensity);
  }
  return glm::dvec3(0.9, 0.7, 0.5) * sum / pi;
}

/// Pixels along a side, so many that the middle one lies close to the diagonal.
constexpr int finePixels = 129;

/// Wavelets are off by the bend of the cosine within texels.
TEST(LampsThroughTransfer, OpenSurface_IsLitExactlyInEveryBasis) {
  for (const int channels : {1, 3}) {
    const QuadScene quad = quadByALamp(1.0, channels);
    for (const Shading shading : {Shading::Sh, Shading::Ch, Shading::Haar, Shading::Glossy})
      expectColor(pixelAt(quad.render(square(shading, finePixels))), middleOf(quad), 3e-3);
  }
}

TEST(LampsThroughTransfer, HalfOpenSurface_IsLitByHalfInEveryBasis) {
  const QuadScene quad = quadByALamp(0.5, 1);
  for (const Shading shading : {Shading::Sh, Shading::Ch, Shading::Haar, Shading::Glossy})
    expectColor(pixelAt(quad.render(square(shading, finePixels))), 0.5 * middleOf(quad), 5e-3);
}

/// Texels see the lamp from where they are: the middle one of a map from straight below its place.
TEST(LampsThroughTransfer, TexelsOfCharts_AreLitFromWhereTheyLie) {
  QuadScene quad = quadByALamp(1.0, 1);
  ChartTransfer::Map map{0, 9, 9, {}, {}};
  for (const glm::vec3& p : quad.compiled.positions)
    map.coords.emplace_back(0.5f * (p.x + 1.0f), 0.5f * (1.0f - p.y));
  for (std::size_t texel = 0; texel < map.texels(); ++texel)
    map.coefficients.insert(map.coefficients.end(), quad.bake.sh->coefficients.begin(),
                            quad.bake.sh->coefficients.begin() + order * order);
  quad.bake.chartTransfer = ChartTransfer{order, 1, 0, {map}};
  const glm::dvec3 path = quad.scene.lights[0].position;  // from the middle
  const double distance = glm::length(path);
  const glm::dvec3 expected = glm::dvec3(0.9, 0.7, 0.5) * glm::dvec3(quad.scene.lights[0].intensity) *
                              path.z / (pi * distance * distance * distance);
  expectColor(pixelAt(quad.render(square(Shading::Sh))), expected, 2e-3);
}

}  // namespace
}  // namespace prelight
