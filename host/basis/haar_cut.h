#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "basis/haar.h"

namespace prelight::haar {

/// Cuts rows that differ in few coefficients, such as the channels of a transfer, each as keepError() does.
/// Their common part is processed once. Contains working memory: use one per thread.
class RowCutter {
 public:
  /// Cuts rows of `count` coefficients; `varying` lists those that differ, ascending.
  explicit RowCutter(std::size_t count, std::vector<std::uint32_t> varying = {});

  /// Appends the kept coefficients of each row to `kept`, and the end of each row there to `ends`. `shared`
  /// has `count` coefficients and is 0 at the varying ones; `values` holds these: [row][varying].
  void cut(std::span<const float> shared, std::span<const float> values, std::size_t rows,
           double relativeError, SparseRow& kept, std::vector<std::size_t>& ends);

 private:
  double sumUp(std::span<const float> shared);
  double chooseBlocks(double budget);
  void gather(std::span<const float> shared, double limit);
  void narrow(double limit);
  void makeBuckets(double leastBudget, double mostBudget);
  void addTo(std::vector<double>& sums, std::span<const float> values) const;
  float dropLimit(double budget, std::span<const float> own);
  void append(float limit, SparseRow& kept) const;

  std::vector<std::uint32_t> varying_;
  std::vector<std::uint8_t> varies_;   ///< [coefficient]
  std::vector<float> blockGreatest_;   ///< [block of coefficients], a bound of the magnitudes
  std::vector<double> blockSum_;       ///< [block] sum of squares
  std::vector<std::uint32_t> blocks_;  ///< blocks that have candidates
  std::vector<double> budgets_;        ///< [row]
  /// Coefficients that a row may keep, with its own values of the varying ones.
  SparseRow candidates_;
  /// Number of candidates; the lists above have their greatest possible length.
  std::size_t candidateCount_ = 0;
  std::vector<std::size_t> places_;  ///< [varying] index among the candidates
  double dropped_ = 0.0;             ///< sum of squares of coefficients that are not candidates
  std::uint32_t firstBucket_ = 0;    ///< bucket of magnitudes; smaller ones count as in this bucket
  std::uint32_t lastBucket_ = 0;     ///< greater ones count as in this bucket
  std::vector<double> sharedSum_;    ///< [bucket] sum of squares that the rows share
  std::vector<double> bucketSum_;    ///< [bucket] sum of squares of a row
  std::vector<float> undecided_;
};

}  // namespace prelight::haar
