#include "fit/symmetric_solve.h"

#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

namespace prelight {

SymmetricFactors::SymmetricFactors(std::vector<double> matrix, double smallest)
    : size_(static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(matrix.size()))))),
      lower_(std::move(matrix)),
      order_(size_) {
  assert(size_ * size_ == lower_.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  double first = 0.0;
  for (; rank_ < size_; ++rank_) {
    std::size_t largest = rank_;
    for (std::size_t i = rank_ + 1; i < size_; ++i)
      if (lower_[i * size_ + i] > lower_[largest * size_ + largest]) largest = i;
    const double pivot = lower_[largest * size_ + largest];
    if (rank_ == 0) first = pivot;
    if (!(pivot > smallest * first)) return;
    swapUnknowns(rank_, largest);
    eliminate(rank_);
  }
}

// Swaps unknowns i < j in the lower triangle, including the finished columns of L.
void SymmetricFactors::swapUnknowns(std::size_t i, std::size_t j) {
  if (i == j) return;
  std::swap(order_[i], order_[j]);
  const auto at = [&](std::size_t row, std::size_t column) -> double& {
    return lower_[row * size_ + column];
  };
  for (std::size_t k = 0; k < i; ++k) std::swap(at(i, k), at(j, k));
  for (std::size_t k = i + 1; k < j; ++k) std::swap(at(k, i), at(j, k));
  for (std::size_t k = j + 1; k < size_; ++k) std::swap(at(k, i), at(k, j));
  std::swap(at(i, i), at(j, j));
}

// Eliminates unknown k from the later ones.
void SymmetricFactors::eliminate(std::size_t k) {
  const double pivot = lower_[k * size_ + k];
  std::vector<double> column(size_ - k - 1);
  for (std::size_t i = k + 1; i < size_; ++i) column[i - k - 1] = lower_[i * size_ + k];
  for (std::size_t i = k + 1; i < size_; ++i) {
    double* row = &lower_[i * size_];
    const double factor = row[k] /= pivot;
    for (std::size_t j = k + 1; j <= i; ++j) row[j] -= factor * column[j - k - 1];
  }
}

void SymmetricFactors::solve(std::span<double> right, std::size_t columns) const {
  assert(right.size() == size_ * columns);
  std::vector<double> x(rank_ * columns);
  for (std::size_t i = 0; i < rank_; ++i)
    for (std::size_t c = 0; c < columns; ++c) x[i * columns + c] = right[order_[i] * columns + c];
  for (std::size_t i = 0; i < rank_; ++i)
    for (std::size_t k = 0; k < i; ++k)
      for (std::size_t c = 0; c < columns; ++c)
        x[i * columns + c] -= lower_[i * size_ + k] * x[k * columns + c];
  for (std::size_t i = rank_; i-- > 0;) {
    for (std::size_t c = 0; c < columns; ++c) x[i * columns + c] /= lower_[i * size_ + i];
    for (std::size_t k = i + 1; k < rank_; ++k)
      for (std::size_t c = 0; c < columns; ++c)
        x[i * columns + c] -= lower_[k * size_ + i] * x[k * columns + c];
  }
  for (std::size_t i = 0; i < size_; ++i)
    for (std::size_t c = 0; c < columns; ++c)
      right[order_[i] * columns + c] = i < rank_ ? x[i * columns + c] : 0.0;
}

}  // namespace prelight
