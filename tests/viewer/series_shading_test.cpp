// Pictures with CH and with compressed SH, compared with those of SH.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "basis/ch.h"
#include "viewer/open_transfers.h"
#include "viewer/picture_checks.h"

namespace prelight {
namespace {

using namespace test;
using viewer::Shading;

using std::numbers::pi;

TEST(ChShading, CoefficientsOfTheSameTransfer_ShowWhatShShows) {
  for (const int order : {1, 3, 6, 14, 32}) {
    for (const int channels : {1, 3}) {
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
      options.skyRotation = 0.7;
      const Picture inSh = quad.render(options);
      options.shading = Shading::Ch;
      const Picture inCh = quad.render(options);
      EXPECT_LT(largestDifference(inSh, inCh), 1e-5 * largest(inSh)) << order << ' ' << channels;
      EXPECT_GT(largest(inSh), 0.1);
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

  // Products of moments at the two corners of the diagonal.
  std::vector<double> sky(36, 0.0);
  sky[0] = std::sqrt(4.0 * pi);
  basis.momentsFromSh(sky, sky);
  double expected = 0.0;
  for (int i = 0; i < 36; ++i)
    expected += 0.5 * sky[i] * (double(naive.coefficients[i]) + naive.coefficients[72 + i]);
  expectColor(pixel, glm::dvec3(expected), 1e-4);
  EXPECT_GT(std::abs(expected - 0.9), 0.05);  // An exact projection shows 0.9.
  EXPECT_THAT(notes, testing::Contains(testing::HasSubstr("naively")));
}

class CompressedShading : public testing::TestWithParam<const char*> {};

TEST_P(CompressedShading, DecodedInTheShader_ShowsWhatTheDecompressedTransferShows) {
  const CompressionRequest request = parseCompression(GetParam());
  for (const int channels : {1, 3}) {
    QuadScene quad = litQuad(true);
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
                         testing::Values("half", "band8", "rgbe", "pca:2:float", "pca:2:half", "pca:2:byte",
                                         "vq:2", "cpca:2:1:float", "cpca:2:1:half", "cpca:2:1:byte"));

}  // namespace
}  // namespace prelight
