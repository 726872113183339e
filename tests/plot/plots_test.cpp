#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include "basis/ch.h"
#include "basis/kept_sky.h"
#include "basis/sh_zonal.h"
#include "images/picture_codecs.h"
#include "plot/balloon.h"
#include "plot/basis_plots.h"
#include "plot/lobe_plots.h"
#include "plot/sky_plots.h"
#include "plot/transfer_plot.h"
#include "prelight/error.h"
#include "support/gltf_files.h"

namespace prelight::plot {
namespace {

using std::numbers::pi;

/// Integral over the sphere of a function of the angle to the normal.
double integralOf(const PolarCurve& curve) {
  constexpr int steps = 4000;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double angle = pi * (i + 0.5) / steps;
    sum += curve.value(angle) * std::sin(angle) * 2.0 * pi * pi / steps;
  }
  return sum;
}

TEST(LobePlots, Lobes_AreNormalizedWholeAndCut) {
  for (const ReflectionLobe lobe : {ReflectionLobe::Ggx, ReflectionLobe::Phong})
    for (const double roughness : {0.3, 0.6, 1.0}) {
      EXPECT_NEAR(integralOf(lobeCurve(lobe, roughness)), 1.0, 1e-4) << roughness;
      EXPECT_NEAR(integralOf(lobeInHarmonics(lobe, roughness, 8)), 1.0, 1e-4) << roughness;
    }
}

TEST(LobePlots, HarmonicsOfAHighOrder_AreTheLobe) {
  for (const ReflectionLobe lobe : {ReflectionLobe::Ggx, ReflectionLobe::Phong}) {
    const PolarCurve whole = lobeCurve(lobe, 0.5), cut = lobeInHarmonics(lobe, 0.5, 32);
    for (const double angle : {0.0, 0.1, -0.3, 0.8, 1.4, 2.5})
      EXPECT_NEAR(cut.value(angle), whole.value(angle), 0.01 * whole.value(0.0)) << angle;
  }
}

TEST(LobePlots, Metal_IsReciprocalAndMirrors) {
  const PolarCurve from = metalCurve(0.4, 0.9), back = metalCurve(0.4, 0.2);
  EXPECT_NEAR(from.value(0.2), back.value(0.9), 1e-9);
  const PolarCurve narrow = metalCurve(0.1, 0.5);
  EXPECT_GT(narrow.value(0.5), 20.0 * narrow.value(0.8));
  EXPECT_EQ(narrow.value(1.6), 0.0);
}

TEST(LobePlots, MeasuredLambertian_IsItsAlbedoOverPi) {
  MeasuredBrdf brdf;
  brdf.diffuse = {0.2f, 0.5f, 0.8f};
  EXPECT_NEAR(measuredCurve(brdf, 0.7).value(0.3), 0.5 / pi, 1e-6);
}

TEST(SkyPlots, EvenSky_IsExactInEveryBasis) {
  const Environment sky = constantEnvironment(glm::vec3(0.5f, 1.0f, 2.0f));
  EXPECT_LT(skyInHarmonics(sky, 2).error, 1e-6);
  EXPECT_LT(skyInWavelets(sky, 8, 6).error, 1e-6);  // the average of each face
}

TEST(SkyPlots, MoreFunctions_AreNearerToTheSky) {
  const Environment sky = studioEnvironment();
  EXPECT_LT(skyInHarmonics(sky, 12).error, 0.8 * skyInHarmonics(sky, 3).error);
  EXPECT_LT(skyInWavelets(sky, 64, 1000).error, 0.5 * skyInWavelets(sky, 64, 30).error);
}

TEST(SkyPlots, Lights_HaveACircleEach) {
  const Environment sky = studioEnvironment();
  EXPECT_EQ(plotSkyLights(sky, medianCut(sky, 16)).lines.size(), 16u);
}

bool isColor(const Drawing& drawing, int column, int row, const Color& color, int tolerance) {
  const std::size_t at = 4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(drawing.pixels.width) +
                              static_cast<std::size_t>(column));
  for (std::size_t c = 0; c < 3; ++c)
    if (std::abs(drawing.pixels.rgba[at + c] - color[c]) > tolerance) return false;
  return true;
}

TEST(Balloon, ConstantFunction_IsABall) {
  constexpr int side = 100;
  Drawing drawing = blankDrawing(side, side);
  const SphereGrid grid = makeSphereGrid(65, 129);
  drawBalloon(drawing, {0, 0}, side, grid, std::vector<double>(grid.directions.size(), 2.0), 4.0, UpAxis::Y);
  int covered = 0;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) covered += isColor(drawing, x, y, {255, 255, 255}, 0) ? 0 : 1;
  const double radius = 0.48 * side * 2.0 / 4.0;
  EXPECT_NEAR(covered, pi * radius * radius, 0.06 * pi * radius * radius);
}

TEST(Balloon, Cosine_IsBlueUpAndOrangeDown) {
  constexpr int side = 100;
  Drawing drawing = blankDrawing(side, side);
  const SphereGrid grid = makeSphereGrid(65, 129);
  std::vector<double> values;
  for (const glm::dvec3& direction : grid.directions) values.push_back(direction.z);
  drawBalloon(drawing, {0, 0}, side, grid, values, 1.0, UpAxis::Z);
  const auto bluer = [&](int row) {
    const std::size_t at = 4 * (static_cast<std::size_t>(row) * side + side / 2);
    return drawing.pixels.rgba[at + 2] - drawing.pixels.rgba[at];
  };
  EXPECT_GT(bluer(side / 4), 40);
  EXPECT_LT(bluer(3 * side / 4), -40);
}

TEST(BasisPlots, Wavelets_LieWhereTheirCoefficientsDo) {
  const Drawing drawing = plotWavelets(2, faceWavelets(2));
  constexpr int gap = 8, side = 96;
  EXPECT_TRUE(isColor(drawing, gap + side / 2, gap + side / 2, positiveColor, 0));
  const int second = gap + side + gap;  // left against right
  EXPECT_TRUE(isColor(drawing, second + side / 4, gap + side / 2, positiveColor, 0));
  EXPECT_TRUE(isColor(drawing, second + 3 * side / 4, gap + side / 2, negativeColor, 0));
}

TEST(BasisPlots, Harmonics_HaveALabelEach) { EXPECT_EQ(plotHarmonics(ch::evaluate, 3).labels.size(), 9u); }

TEST(TransferPlot, OpenReceiver_SaysItsGreatestValue) {
  std::vector<double> open(64);
  sh::openTransfer({0.0, 1.0, 0.0}, 8, open);
  std::vector<float> row;
  for (int channel = 0; channel < 3; ++channel) row.insert(row.end(), open.begin(), open.end());
  const std::string greatest = fmt::format("order 8, at most {:.3g} per sr", sh::openTowards(1.0, 8));
  for (const std::size_t length : {64u, 192u}) {
    const Drawing drawing = plotTransfer({"open", sh::evaluate, std::span(row).first(length)});
    EXPECT_THAT(drawing.labels.at(0).text, ::testing::HasSubstr(greatest));
  }
  EXPECT_THROW(plotTransfer({"odd", sh::evaluate, std::span(row).first(65)}), UsageError);
}

std::string bytesOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Drawings, FilesHaveLinesAndSvgLabels) {
  const test::TemporaryFolder folder;
  Drawing drawing = blankDrawing(40, 30);
  drawing.lines.push_back({{{5.0, 15.5}, {35.0, 15.5}}, {255, 0, 0}, 3.0});
  drawing.labels.push_back({{20.0, 20.0}, "a < b & c"});
  writeDrawing(folder / "plot.svg", drawing);
  writeDrawing(folder / "plot.png", drawing);
  EXPECT_THAT(bytesOf(folder / "plot.svg"), ::testing::HasSubstr("a &lt; b &amp; c"));
  const std::string png = bytesOf(folder / "plot.png");
  const Image image =
      decodeImage(std::span(reinterpret_cast<const std::uint8_t*>(png.data()), png.size()), "plot.png");
  ASSERT_EQ(image.width, 40);
  ASSERT_EQ(image.height, 30);
  const std::size_t middle = 4 * (15 * 40 + 20), above = 4 * (5 * 40 + 20);
  EXPECT_LT(image.rgba[middle + 1], 5);
  EXPECT_EQ(image.rgba[above + 1], 255);
  EXPECT_THROW(writeDrawing(folder / "plot.jpg", drawing), UsageError);
}

}  // namespace
}  // namespace prelight::plot
