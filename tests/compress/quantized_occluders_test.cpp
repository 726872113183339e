#include "compress/quantized_occluders.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/directions.h"
#include "occluders/occluder_record.h"
#include "support/occluders.h"
#include "support/scenes.h"

namespace prelight {
namespace {

// A step of 1 / (2^b - 1) in both coordinates is sqrt(6) times as long on the octahedron, whose faces are at
// distance 1 / sqrt(3).
TEST(Octahedral, AnyDirection_ComesBackWithinACell) {
  std::mt19937 random(1);
  for (const int bits : {8, 12, 16}) {
    double worst = 0.0;
    for (int i = 0; i < 20000; ++i) {
      const glm::dvec3 d = glm::normalize(glm::dvec3(test::randomDirection(random)));
      worst = std::max(worst, glm::length(fromOctahedral(toOctahedral(d, bits), bits) - d));
    }
    EXPECT_LT(worst, 4.25 / ((1 << bits) - 1)) << bits;
    EXPECT_GT(worst, 2.5 / ((1 << bits) - 1)) << bits;
  }
  for (const glm::dvec3& axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, -1)})
    EXPECT_LT(glm::length(fromOctahedral(toOctahedral(axis, 8), 8) - axis), 0.01);
  EXPECT_EQ(glm::length(fromOctahedral(toOctahedral(glm::dvec3(0.0), 8), 8)), 1.0);
}

/// Records whose vectors are no longer than their weights.
class Quantized : public ::testing::Test {
 protected:
  Quantized() {
    for (const glm::vec3& position : made_.positions) vertices_.emplace_back(position);
    for (std::size_t i = 0; i < globalIllumination_.vectors.size(); i += width())
      globalIllumination_.vectors[i].w =
          1.3f * glm::length(glm::vec3(globalIllumination_.vectors[i]) - nearestVertex(i / width()));
  }

  glm::vec3 nearestVertex(std::size_t record) const {
    std::size_t v = 0;
    while (globalIllumination_.offsets[v + 1] <= record) ++v;
    return made_.positions[v];
  }
  std::size_t width() const { return globalIllumination_.stored.size(); }
  OccluderTransfer throughBytes() const {
    return dequantizeOccluders(quantizeOccluders(globalIllumination_, vertices_), vertices_);
  }

  test::MadeOccluders made_ = test::makeOccluders(300, test::everyOptionalVector(), 5);
  OccluderTransfer& globalIllumination_ = made_.transfer;
  std::vector<glm::dvec3> vertices_;
};

TEST_F(Quantized, Records_TakeTheirBytes) {
  const QuantizedOccluders quantized = quantizeOccluders(globalIllumination_, vertices_);
  EXPECT_EQ(quantizedBytes(globalIllumination_.stored), 32u);
  EXPECT_EQ(quantizedBytes({OccluderVector::Position, OccluderVector::Occlusion,
                            OccluderVector::DiffuseNormal, OccluderVector::DiffuseColor}),
            18u);
  EXPECT_EQ(quantized.bytes.size(), 32 * globalIllumination_.recordCount());
}

TEST_F(Quantized, Vectors_ComeBackWithinTheirSteps) {
  const OccluderTransfer read = throughBytes();
  EXPECT_EQ(read.offsets, globalIllumination_.offsets);
  EXPECT_EQ(read.occluders, globalIllumination_.occluders);
  ASSERT_EQ(read.vectors.size(), globalIllumination_.vectors.size());
  const std::size_t occlusion = placeOf(globalIllumination_, OccluderVector::Occlusion);
  for (std::size_t r = 0; r < globalIllumination_.recordCount(); ++r)
    for (std::size_t s = 0; s < width(); ++s) {
      const glm::dvec4 a(globalIllumination_.vectors[r * width() + s]), b(read.vectors[r * width() + s]);
      const double formFactor = globalIllumination_.vectors[r * width() + occlusion].w;
      const double difference = glm::length(glm::dvec3(a) - glm::dvec3(b));
      switch (globalIllumination_.stored[s]) {
        case OccluderVector::Position:
          EXPECT_NEAR(b.w, a.w, 1e-3 * a.w);
          EXPECT_LT(difference, 0.02 * a.w);  // sqrt(18) / 255, and a step of length.
          break;
        case OccluderVector::Occlusion:
          EXPECT_NEAR(b.w, a.w, 2.0 / 65535.0 * std::sqrt(a.w) + 1e-9);
          // The stored value is the root of 1 - r, so that steps of r are widest, 0.008, where r is least.
          EXPECT_LT(difference, 0.006 * a.w + 2e-5);
          EXPECT_LE(glm::length(glm::dvec3(b)), b.w * (1.0 + 1e-6));
          break;
        case OccluderVector::Caustic:
        case OccluderVector::DiffuseNormal:
        case OccluderVector::SpecularNormal:
          EXPECT_NEAR(b.w, a.w, 0.005 * formFactor + 1e-5);
          EXPECT_LT(difference, 0.025 * formFactor + 2e-5);
          EXPECT_LE(glm::length(glm::dvec3(b)), b.w * (1.0 + 1e-6));
          break;
        default:
          EXPECT_LT(difference, 0.5 * std::sqrt(3.0) / 255.0 + 1e-6);
      }
    }
}

TEST_F(Quantized, Error_IsSmallAndThatOfTheLight) {
  const OccluderTransfer read = throughBytes();
  const OccluderQuantizationError error =
      quantizationError(globalIllumination_, read, vertices_, made_.normals);
  EXPECT_GT(error.formFactor, 0.0);
  EXPECT_LT(error.formFactor, 2e-5);
  EXPECT_GT(error.light, 0.0);
  EXPECT_LT(error.light, 0.02);
  EXPECT_EQ(quantizationError(globalIllumination_, globalIllumination_, vertices_, made_.normals).light, 0.0);
}

// A record without direction, one without form factor, and all vertices in one place.
TEST(QuantizedOccluders, Degenerate_StaysFinite) {
  const OccluderTransfer transfer{
      {"a"},
      {OccluderVector::Position, OccluderVector::Occlusion, OccluderVector::DiffuseNormal},
      {0, 2},
      {0, 0},
      {glm::vec4(0.0f), glm::vec4(0.0f), glm::vec4(0.0f), glm::vec4(1, 2, 3, 0), glm::vec4(0, 0, 0, 1),
       glm::vec4(0, 0, 0, 0.5f)}};
  const std::vector<glm::dvec3> vertices = {glm::dvec3(1, 2, 3)};
  const OccluderTransfer read = dequantizeOccluders(quantizeOccluders(transfer, vertices), vertices);
  for (const glm::vec4& vector : read.vectors)
    for (int c = 0; c < 4; ++c) EXPECT_TRUE(std::isfinite(vector[c]));
  EXPECT_EQ(read.vectors[1].w, 0.0f);
  EXPECT_NEAR(read.vectors[4].w, 1.0f, 1e-6f);
  EXPECT_NEAR(glm::length(glm::vec3(read.vectors[4])), 0.0f, 1e-6f);
  const OccluderTransfer none = dequantizeOccluders(
      quantizeOccluders({{}, {OccluderVector::Occlusion}, {0, 0}, {}, {}}, vertices), vertices);
  EXPECT_EQ(none.recordCount(), 0u);
}

}  // namespace
}  // namespace prelight
