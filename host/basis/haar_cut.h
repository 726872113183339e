#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "basis/haar_selection.h"

namespace prelight::haar {

/// Cuts rows that differ in few coefficients, such as the channels of a transfer, each as keepError() does.
/// What they share is looked through once. Holds memory to work in: one a thread.
class RowCutter {
 public:
  /// Cuts rows of `count` coefficients; `varying` lists those that differ, ascending.
  explicit RowCutter(std::size_t count, std::vector<std::uint32_t> varying = {});

  /// Appends what is kept of each row to `kept`, and where it ends there to `ends`. `shared` has `count`
  /// coefficients and is 0 at the varying ones, `values` theirs: [row][varying].
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
  std::vector<double> blockSum_;       ///< [block], of squares
  std::vector<std::uint32_t> blocks_;  ///< that have candidates
  std::vector<double> budgets_;        ///< [row]
  SparseRow candidates_;               ///< what a row may keep, with its own values of the varying ones
  std::size_t candidateCount_ = 0;     ///< the lists above are as long as they can get
  std::vector<std::size_t> places_;    ///< [varying], among the candidates
  double dropped_ = 0.0;               ///< sum of squares of what is no candidate
  std::uint32_t firstBucket_ = 0;      ///< of magnitudes, those below count as of it
  std::uint32_t lastBucket_ = 0;       ///< as well
  std::vector<double> sharedSum_;      ///< [bucket], of squares that the rows share
  std::vector<double> bucketSum_;      ///< [bucket], of a row
  std::vector<float> undecided_;
};

}  // namespace prelight::haar
