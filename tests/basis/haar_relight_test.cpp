#include "techniques/haar/haar_relight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "basis/cube_overlap.h"
#include "basis/random_occluders.h"
#include "benchmarks/lab/haar_rotation.h"
#include "benchmarks/lab/wavelet_trials.h"
#include "techniques/haar/haar_model.h"

namespace prelight {
namespace {

constexpr double degreeOfArc = std::numbers::pi / 180.0;

CubeMap skyWithSun(int faceSize) {
  CubeMap map = gradientSky(faceSize);
  addDisk(map, glm::normalize(glm::dvec3(0.5, 0.7, 0.3)), 1.5 * degreeOfArc,
          glm::vec3(1500.0f, 1400.0f, 1200.0f));
  return map;
}

std::vector<glm::dvec3> sumTexels(const OccludedReceivers& receivers, const CubeMap& light) {
  std::vector<glm::dvec3> result;
  for (const std::vector<float>& texels : receivers.texels) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < texels.size(); ++i) sum += double(texels[i]) * glm::dvec3(light.radiance[i]);
    result.push_back(sum);
  }
  return result;
}

TEST(HaarRelight, AllCoefficients_EqualTheSumOverTexels) {
  const OccludedReceivers receivers(64, 50, 1);
  const CubeMap light = skyWithSun(64);
  const std::vector<glm::dvec3> direct = sumTexels(receivers, light);
  const std::vector<glm::dvec3> lit = haar::relight(receivers.transfer, haar::transformLight(light));
  ASSERT_EQ(lit.size(), direct.size());
  for (std::size_t v = 0; v < lit.size(); ++v) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(lit[v][c] / direct[v][c], 1.0, 1e-5) << v;
  }
}

TEST(HaarRelight, AHundredCoefficients_ShowASkyWithASunWithinTwoPerMille) {
  const OccludedReceivers receivers(64, 300, 2);
  const std::vector<float> light = haar::transformLight(skyWithSun(64));
  const std::vector<glm::dvec3> exact = haar::relight(receivers.transfer, light);
  const haar::TransferModel model = haar::modelTransfer(receivers.transfer, 16);
  const haar::SparseLight chosen = haar::selectLight(light, model.rms, 100);
  const haar::SparseLight fitted = haar::fitSelection(light, chosen, model);
  const double plainError = relativeRms(haar::relight(receivers.transfer, chosen), exact);
  const double fittedError = relativeRms(haar::relight(receivers.transfer, fitted), exact);
  std::printf("100 of 24576 coefficients: %.4f %%, fitted %.4f %%\n", 100.0 * plainError,
              100.0 * fittedError);
  EXPECT_EQ(fitted.indices.size(), 100u);
  EXPECT_LT(fittedError, 0.002);
  EXPECT_LT(fittedError, plainError);
  // Receivers other than those that the model was fitted to.
  const OccludedReceivers others(64, 300, 3);
  const double othersError =
      relativeRms(haar::relight(others.transfer, fitted), haar::relight(others.transfer, light));
  EXPECT_LT(othersError, 0.002);
}

TEST(HaarRelight, MoreCoefficients_HaveLessError) {
  const OccludedReceivers receivers(32, 300, 4);
  const haar::TransferModel model = haar::modelTransfer(receivers.transfer, 16);
  const std::vector<float> light = haar::transformLight(skyWithSun(32));
  const std::vector<glm::dvec3> exact = haar::relight(receivers.transfer, light);
  double before = 1.0, fittedBefore = 1.0;
  for (const std::size_t count : {10u, 30u, 100u, 300u, 1000u, 3000u}) {
    const haar::SparseLight chosen = haar::selectLight(light, model.rms, count);
    const double error = relativeRms(haar::relight(receivers.transfer, chosen), exact);
    const haar::SparseLight fitted = haar::fitSelection(light, chosen, model);
    const double fittedError = relativeRms(haar::relight(receivers.transfer, fitted), exact);
    std::printf("%5zu coefficients: %.4f %%, fitted %.4f %%\n", count, 100.0 * error, 100.0 * fittedError);
    EXPECT_LT(error, before) << count;
    EXPECT_LT(fittedError, fittedBefore) << count;
    before = error;
    fittedBefore = fittedError;
  }
  const haar::SparseLight all = haar::selectLight(light, std::vector<float>(6 * 32 * 32, 1.0f), 6 * 32 * 32);
  EXPECT_LT(relativeRms(haar::relight(receivers.transfer, all), exact), 1e-12);
}

TEST(HaarRelight, Rms_OfRows_IsTheirRootMeanSquare) {
  HaarTransfer transfer{
      .faceSize = 1, .channels = 1, .bounces = 0, .offsets = {0}, .indices = {}, .values = {}};
  haar::appendRow(transfer, {{0, 5}, {3.0f, 1.0f}});
  haar::appendRow(transfer, {{0}, {-4.0f}});
  const std::vector<float> rms = haar::coefficientRms(transfer);
  ASSERT_EQ(rms.size(), 6u);
  EXPECT_FLOAT_EQ(rms[0], std::sqrt(12.5f));
  EXPECT_FLOAT_EQ(rms[5], std::sqrt(0.5f));
  EXPECT_EQ(rms[1], 0.0f);
}

TEST(HaarRelight, GatheredBounce_LightsAsTheSendersDo) {
  const OccludedReceivers receivers(16, 20, 5);
  std::vector<std::vector<haar::Link>> links(20);
  for (std::uint32_t v = 0; v < 20; ++v) {
    for (std::uint32_t k = 1; k <= v % 4; ++k) {
      links[v].push_back({(v + 3 * k) % 20, glm::vec3(0.1f * static_cast<float>(k), 0.05f, 0.2f)});
    }
  }
  const std::vector<float> light = haar::transformLight(skyWithSun(16));
  const std::vector<glm::dvec3> direct = haar::relight(receivers.transfer, light);
  const HaarTransfer bounce = haar::gatherBounce(receivers.transfer, links, 0.0);
  EXPECT_EQ(bounce.channels, 3);
  EXPECT_EQ(bounce.bounces, 1);
  const std::vector<glm::dvec3> lit = haar::relight(bounce, light);
  const std::vector<glm::dvec3> both = haar::relight(haar::addTransfer(receivers.transfer, bounce), light);
  ASSERT_EQ(lit.size(), 20u);
  for (std::size_t v = 0; v < 20; ++v) {
    glm::dvec3 expected(0.0);
    for (const haar::Link& link : links[v]) expected += glm::dvec3(link.weight) * direct[link.sender];
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(lit[v][c], expected[c], 1e-5 * (1.0 + expected[c])) << v;
      EXPECT_NEAR(both[v][c], direct[v][c] + expected[c], 1e-5 * (1.0 + both[v][c])) << v;
    }
  }
}

TEST(HaarRelight, GatheredBounce_DropsUpToItsError) {
  const OccludedReceivers receivers(16, 10, 6);
  const std::vector<std::vector<haar::Link>> links(10, {{3, glm::vec3(0.5f)}, {4, glm::vec3(0.25f)}});
  const HaarTransfer whole = haar::gatherBounce(receivers.transfer, links, 0.0);
  const HaarTransfer sparse = haar::gatherBounce(receivers.transfer, links, 0.05);
  EXPECT_LT(sparse.values.size(), whole.values.size() / 2);
  double kept = 0.0, total = 0.0;
  for (const float value : sparse.values) kept += double(value) * value;
  for (const float value : whole.values) total += double(value) * value;
  EXPECT_NEAR(std::sqrt(1.0 - kept / total), 0.045, 0.005 + 1e-6);
}

TEST(HaarRelight, KeptRows_AreThoseThatKeepErrorLeaves) {
  const OccludedReceivers whole(16, 5, 10), sparse(16, 5, 10, 0.1);
  const HaarTransfer kept = haar::keepRows(whole.transfer, 0.1);
  EXPECT_EQ(kept.offsets, sparse.transfer.offsets);
  EXPECT_EQ(kept.indices, sparse.transfer.indices);
  EXPECT_EQ(kept.values, sparse.transfer.values);
}

TEST(HaarRelight, ChooseBasis_TakesHarmonicsForSmoothLightsAndWaveletsForSmall) {
  const OccludedReceivers receivers(32, 100, 7);
  const std::vector<float> weights = haar::coefficientRms(receivers.transfer);
  const haar::BasisChoice smooth = haar::chooseBasis(gradientSky(32), 3, 9, weights);
  EXPECT_FALSE(smooth.haar);
  EXPECT_LT(smooth.shError, 0.01);
  const haar::BasisChoice sunny = haar::chooseBasis(skyWithSun(32), 6, 36, weights);
  EXPECT_TRUE(sunny.haar);
  EXPECT_GT(sunny.shError, 0.1);
}

TEST(HaarModel, OfNoDirections_LeavesTheLightAsItIs) {
  const OccludedReceivers receivers(8, 20, 8);
  const haar::TransferModel model = haar::modelTransfer(receivers.transfer, 0);
  EXPECT_EQ(model.rms, haar::coefficientRms(receivers.transfer));
  const std::vector<float> light = haar::transformLight(skyWithSun(8));
  const haar::SparseLight chosen = haar::selectLight(light, model.rms, 30);
  const haar::SparseLight fitted = haar::fitSelection(light, chosen, model);
  EXPECT_EQ(fitted.indices, chosen.indices);
  EXPECT_EQ(fitted.values, chosen.values);
  EXPECT_NEAR(haar::expectedError(light, chosen, model), haar::expectedError(light, chosen, model.rms), 1e-9);
}

TEST(HaarModel, OfAsManyDirectionsAsRows_ExpectsTheErrorThatThereIs) {
  const OccludedReceivers receivers(8, 20, 9);
  const haar::TransferModel model = haar::modelTransfer(receivers.transfer, 20);
  const std::vector<float> light = haar::transformLight(skyWithSun(8));
  const std::vector<glm::dvec3> exact = haar::relight(receivers.transfer, light);
  for (const std::size_t count : {5u, 20u, 80u}) {
    const haar::SparseLight chosen = haar::selectLight(light, model.rms, count);
    const double measured = relativeRms(haar::relight(receivers.transfer, chosen), exact);
    EXPECT_NEAR(haar::expectedError(light, chosen, model) / measured, 1.0, 0.02) << count;
  }
}

TEST(HaarModel, OfEqualRows_IsTheirOneDirection) {
  const OccludedReceivers one(8, 1, 12);
  for (const int rows : {1, 2, 4, 16, 64}) {
    HaarTransfer transfer{8, 1, 0, {0}, {}, {}};
    for (int row = 0; row < rows; ++row)
      haar::appendRow(transfer, {one.transfer.indices, one.transfer.values});
    const haar::TransferModel model = haar::modelTransfer(transfer, 16);
    double left = 0.0, whole = 0.0;
    for (std::size_t i = 0; i < model.rms.size(); ++i) {
      left += double(model.rest[i]) * model.rest[i];
      whole += double(model.rms[i]) * model.rms[i];
    }
    EXPECT_LT(std::sqrt(left / whole), 0.01) << rows;
  }
}

TEST(HaarModel, OfManyRowsInThreeChannels_KnowsThemAll) {
  // Channels that have nothing in common, 4096 vertices: every third of the rows belongs to one channel.
  HaarTransfer transfer{1, 3, 1, {0}, {}, {}};
  for (int v = 0; v < 4096; ++v) {
    const float value = 1.0f + 0.5f * std::sin(static_cast<float>(v));
    for (std::uint32_t c = 0; c < 3; ++c) haar::appendRow(transfer, {{c}, {value}});
  }
  const haar::TransferModel model = haar::modelTransfer(transfer, 3);
  for (int i = 0; i < 3; ++i) {
    EXPECT_GT(model.rms[i], 0.5f);
    EXPECT_LT(model.rest[i], 0.2f * model.rms[i]) << "coefficient " << i << " is not explained";
  }
}

glm::dmat3 turnAroundY(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{c, 0.0, -s}, {0.0, 1.0, 0.0}, {s, 0.0, c}};
}

TEST(WaveletRotation, WithWholeColumns_IsTheTransformOfTheRotatedTexels) {
  constexpr int size = 16;
  const CubeMap map = skyWithSun(size);
  const std::vector<float> light = haar::transformLight(map);
  const glm::dmat3 rotation = turnAroundY(0.3);
  haar::WaveletRotation wavelets(rotation, size, 0.0);
  const std::vector<float> ones(cubeTexelCount(size), 1.0f);
  const haar::SparseLight rotated = wavelets.rotate(haar::selectLight(light, ones, ones.size()));
  const std::vector<float> expected = haar::transformLight(rotateByArea(rotation, size).apply(map));
  std::vector<float> dense(expected.size(), 0.0f);
  for (std::size_t k = 0; k < rotated.indices.size(); ++k) {
    for (int c = 0; c < 3; ++c) dense[c * ones.size() + rotated.indices[k]] = rotated.values[k][c];
  }
  double greatest = 0.0;
  for (const float value : expected) greatest = std::max(greatest, std::abs(double(value)));
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(dense[i], expected[i], 1e-5 * greatest) << i;
}

TEST(WaveletRotation, WithSparserColumns_StaysWithinTheirError) {
  constexpr int size = 32;
  haar::WaveletRotation whole(turnAroundY(0.2), size, 0.0), sparse(turnAroundY(0.2), size, 0.05);
  for (const std::uint32_t index : {0u, 1u, 16u, 529u, 5000u}) {
    const haar::SparseRow &all = whole.column(index), &few = sparse.column(index);
    EXPECT_LT(few.indices.size(), all.indices.size()) << index;
    double kept = 0.0, total = 0.0;
    for (const float value : few.values) kept += double(value) * value;
    for (const float value : all.values) total += double(value) * value;
    EXPECT_LE(std::sqrt(1.0 - kept / total), 0.05 + 1e-6) << index;
  }
}

}  // namespace
}  // namespace prelight
