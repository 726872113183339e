#include "basis/haar_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace prelight {
namespace {

/// Reference for keepError() by sorting: it drops the smallest coefficients as long as their squares sum to
/// no more than the permitted part.
haar::SparseRow sortedCut(const std::vector<float>& row, double relativeError) {
  std::vector<double> magnitudes(row.begin(), row.end());
  double total = 0.0, dropped = 0.0, limit = 0.0;
  for (double& m : magnitudes) {
    m = std::abs(m);
    total += m * m;
  }
  std::sort(magnitudes.begin(), magnitudes.end());
  for (const double m : magnitudes) {
    dropped += m * m;
    if (dropped > relativeError * relativeError * total) break;
    limit = m;
  }
  haar::SparseRow kept;
  for (std::uint32_t i = 0; i < row.size(); ++i) {
    if (std::abs(row[i]) <= limit) continue;
    kept.indices.push_back(i);
    kept.values.push_back(row[i]);
  }
  return kept;
}

/// Rows of `count` coefficients that fall off as wavelets do, with a stretch of zeros. Every fifth
/// coefficient varies from row to row.
struct Rows {
  std::vector<std::uint32_t> varying;
  std::vector<float> shared;
  std::vector<float> own;  ///< [row][varying]

  std::vector<float> whole(std::size_t row) const {
    std::vector<float> values = shared;
    for (std::size_t k = 0; k < varying.size(); ++k) values[varying[k]] = own[row * varying.size() + k];
    return values;
  }
};

Rows makeRows(std::uint32_t count, std::size_t rows) {
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  const auto next = [&] { return normal(random) * std::exp(2.0f * normal(random)); };
  Rows made;
  for (std::uint32_t i = 0; i < count; ++i) {
    const bool varies = i % 5 == 2;
    if (varies) made.varying.push_back(i);
    made.shared.push_back(varies || (i > count / 4 && i < count / 2) ? 0.0f : next());
  }
  for (std::size_t k = 0; k < rows * made.varying.size(); ++k) made.own.push_back(k % 9 == 0 ? 0.0f : next());
  return made;
}

TEST(RowCutter, RowsThatShareCoefficients_AreEachCutAsIfAlone) {
  for (const std::uint32_t count : {1u, 15u, 1000u, 6144u}) {
    const Rows rows = makeRows(count, 3);
    haar::RowCutter cutter(count, rows.varying);
    for (const double error : {0.0, 0.001, 0.02, 0.3}) {
      haar::SparseRow kept;
      std::vector<std::size_t> ends = {0};
      cutter.cut(rows.shared, rows.own, 3, error, kept, ends);
      ASSERT_EQ(ends.size(), 4u);
      for (std::size_t r = 0; r < 3; ++r) {
        const haar::SparseRow expected = sortedCut(rows.whole(r), error);
        const auto begin = static_cast<std::ptrdiff_t>(ends[r]),
                   end = static_cast<std::ptrdiff_t>(ends[r + 1]);
        EXPECT_EQ(std::vector(kept.indices.begin() + begin, kept.indices.begin() + end), expected.indices)
            << count << " coefficients, row " << r << ", error " << error;
        EXPECT_EQ(std::vector(kept.values.begin() + begin, kept.values.begin() + end), expected.values);
      }
    }
  }
}

TEST(RowCutter, RowsOfNothingAndErrorOfOne_KeepNothing) {
  const Rows rows = makeRows(100, 2);
  haar::RowCutter cutter(100, rows.varying);
  haar::SparseRow kept;
  std::vector<std::size_t> ends;
  cutter.cut(rows.shared, rows.own, 2, 1.0, kept, ends);
  cutter.cut(std::vector<float>(100), std::vector<float>(2 * rows.varying.size()), 2, 0.02, kept, ends);
  EXPECT_EQ(ends, std::vector<std::size_t>(4, 0));
  EXPECT_TRUE(kept.indices.empty());
}

// One row may be far weaker than the others; the coefficients that all rows share then weigh differently in
// each.
TEST(RowCutter, RowsOfVeryDifferentStrength_KeepWhatTheirOwnSumAllows) {
  Rows rows = makeRows(2000, 2);
  for (std::size_t k = 0; k < rows.varying.size(); ++k) rows.own[k] *= 1000.0f;
  haar::RowCutter cutter(2000, rows.varying);
  haar::SparseRow kept;
  std::vector<std::size_t> ends;
  cutter.cut(rows.shared, rows.own, 2, 0.02, kept, ends);
  EXPECT_EQ(ends[0], sortedCut(rows.whole(0), 0.02).indices.size());
  EXPECT_EQ(ends[1] - ends[0], sortedCut(rows.whole(1), 0.02).indices.size());
}

}  // namespace
}  // namespace prelight
