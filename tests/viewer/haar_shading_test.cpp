// Pictures with wavelet transfer, compared with closed forms and with the host.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "basis/cube_overlap.h"
#include "basis/random_occluders.h"
#include "techniques/haar/haar_model.h"
#include "techniques/haar/haar_relight.h"
#include "viewer/lights/illumination.h"
#include "viewer/open_transfers.h"
#include "viewer/picture_checks.h"

namespace prelight {
namespace {

using namespace test;
using viewer::Shading;

using std::numbers::pi;

/// Radiance before albedo in the middle of a quad, which lies on the diagonal of its corners 0 and 2.
glm::dvec3 onDiagonal(const std::vector<glm::dvec3>& corners) { return 0.5 * (corners[0] + corners[2]); }

TEST(HaarShading, OpenSurface_UnderSkiesAndDirectionalLights_MatchesTheClosedForm) {
  for (const int channels : {1, 3}) {
    QuadScene quad = litQuad(false);
    quad.scene.lights.clear();
    quad.bake.haar = openWavelets(quad.compiled.normals, 32, channels);
    viewer::RenderOptions options = square(Shading::Haar);
    options.skyRotation = -0.5 * pi;  // Turns the red half to +Z, which the quad faces.
    // Blue comes from the upper half of the sky, half of the quad's hemisphere.
    expectColor(pixelAt(quad.render(options)), {0.9, 0.0, 0.25}, 2e-3);

    quad.hasEnvironment = false;
    options.lights = {{makeLight(LightType::Directional, {3, 3, 3}, {}, {0.3, -0.4, -1})}};
    const double e = 3.0 / std::sqrt(1.25) / pi;
    expectColor(pixelAt(quad.render(options)), {0.9 * e, 0.7 * e, 0.5 * e}, 3e-3);
  }
}

TEST(HaarShading, FewTerms_AreTheLightsMostImportantOnesFitted) {
  QuadScene quad = litQuad(false);
  quad.scene.lights.clear();
  quad.bake.haar = openWavelets(quad.compiled.normals, 16, 1);
  viewer::RenderOptions options = square(Shading::Haar);
  options.haarTerms = 5;
  options.skyRotation = 0.4;
  const auto light = haar::transformLight(cubeFromEnvironment(viewer::turnedSky(quad.environment, 0.4), 16));
  const HaarTransfer& transfer = *quad.bake.haar;
  const auto shown = [&](const haar::SparseLight& part) {
    return glm::dvec3(0.9, 0.7, 0.5) * glm::max(onDiagonal(haar::relight(transfer, part)), 0.0);
  };
  const haar::TransferModel model = haar::modelTransfer(transfer, haar::usualRank);
  const glm::dvec3 expected = shown(haar::selectFitted(light, 5, model));
  expectColor(pixelAt(quad.render(options)), expected, 1e-4);
  EXPECT_GT(glm::length(shown(haar::selectLight(light, model.rms, 5)) - expected), 1e-3);
}

/// Quads side by side, each with the transfer of one receiver at all corners, so that the quad's colour is
/// that of a single vertex.
struct Tiles {
  static constexpr int across = 15;
  static constexpr int faceSize = 32;
  static constexpr double distance = 3.0;  ///< Distance of the camera.
  QuadScene quads;
  OccludedReceivers receivers{faceSize, across* across, 11};

  Tiles() {
    HaarTransfer transfer{faceSize, 1, 0, {0}, {}, {}};
    for (int tile = 0; tile < across * across; ++tile) {
      const glm::dvec3 place(2.0 * centre(tile % across), 2.0 * centre(tile / across), 0.0);
      quads.add(lambertian(glm::vec3(1.0f)), 1.0f / across, glm::translate(glm::dmat4(1.0), place));
      const auto row = static_cast<std::size_t>(tile);
      const std::uint32_t begin = receivers.transfer.offsets[row], end = receivers.transfer.offsets[row + 1];
      for (int corner = 0; corner < 4; ++corner) {
        haar::appendRow(
            transfer, {{receivers.transfer.indices.begin() + begin, receivers.transfer.indices.begin() + end},
                       {receivers.transfer.values.begin() + begin, receivers.transfer.values.begin() + end}});
      }
    }
    quads.lookFrom({0, 0, distance}, {0, 0, 0});
    quads.compile();
    quads.bake.haar = std::move(transfer);
  }

  /// Centre of a tile's column or row, in [-0.5, 0.5].
  static double centre(int at) { return (at + 0.5) / across - 0.5; }

  /// Colour of each tile.
  std::vector<glm::dvec3> colors(const viewer::RenderOptions& options) const {
    const Picture picture = quads.render(options);
    const double scale = 1.0 / (distance * std::tan(0.5 * quads.scene.cameras[0].yFov));
    std::vector<glm::dvec3> result;
    for (int tile = 0; tile < across * across; ++tile)
      result.emplace_back(
          pixelAt(picture, 0.5 + scale * centre(tile % across), 0.5 - scale * centre(tile / across)));
    return result;
  }
};

/// A smooth sky that is bright towards the zenith.
Environment smoothSky() {
  Environment sky{64, 32, {}};
  for (int row = 0; row < sky.height; ++row) {
    const auto up = static_cast<float>(Environment::direction(0.5, (row + 0.5) / sky.height).y);
    for (int column = 0; column < sky.width; ++column)
      sky.radiance.emplace_back(0.4f + 0.3f * up, 0.5f + 0.4f * up, 0.7f + 0.3f * up);
  }
  return sky;
}

TEST(HaarShading, FewTermsOfASkyAndASun_ErrSeveralTimesLessThanUnfittedOnes) {
  Tiles tiles;
  tiles.quads.setSky(smoothSky());
  tiles.quads.scene.lights = {makeLight(LightType::Directional, {3, 2.8f, 2.4f}, {}, {-0.5, -0.7, -0.3})};
  viewer::RenderOptions options = square(Shading::Haar, 16 * Tiles::across);
  const std::vector<glm::dvec3> exact = tiles.colors(options);

  CubeMap cube = cubeFromEnvironment(tiles.quads.environment, Tiles::faceSize);
  addDirectional(cube, glm::normalize(glm::dvec3(0.5, 0.7, 0.3)), {3, 2.8f, 2.4f});
  const std::vector<float> light = haar::transformLight(cube);
  const HaarTransfer& rows = tiles.receivers.transfer;
  const std::vector<glm::dvec3> all = haar::relight(rows, light);
  ASSERT_LT(relativeRms(exact, all), 1e-3) << "the picture shows other tiles than it should";

  for (const std::size_t terms : {100u, 300u}) {
    options.haarTerms = terms;
    const double fitted = relativeRms(tiles.colors(options), exact);
    const double plain =
        relativeRms(haar::relight(rows, haar::selectLight(light, haar::coefficientRms(rows), terms)), all);
    std::printf("%zu of 6144 coefficients: %.4f %%, fitted %.4f %%\n", terms, 100.0 * plain, 100.0 * fitted);
    EXPECT_LT(5.0 * fitted, plain) << terms;
    EXPECT_GT(fitted, 0.0);
  }
}

}  // namespace
}  // namespace prelight
