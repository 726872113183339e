#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace prelight {

/// Factors L D L^T of a symmetric, positive semidefinite matrix, with the largest remaining pivot first
/// (Golub and Van Loan 2013, sec. 4.2.8).
class SymmetricFactors {
 public:
  /// `matrix` is [n][n]. Directions whose pivot is at most `smallest` times the first count as null space:
  /// solutions have no component along them.
  SymmetricFactors(std::vector<double> matrix, double smallest);

  /// Replaces right-hand sides, [n][columns], by solutions.
  void solve(std::span<double> right, std::size_t columns) const;

 private:
  void swapUnknowns(std::size_t i, std::size_t j);
  void eliminate(std::size_t k);

  std::size_t size_ = 0, rank_ = 0;
  std::vector<double> lower_;  ///< [n][n]: D on the diagonal, L below it; the rest is not read
  std::vector<std::size_t> order_;
};

}  // namespace prelight
