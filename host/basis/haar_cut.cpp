#include "basis/haar_cut.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace prelight::haar {
namespace {

constexpr std::size_t blockSize = 16;
constexpr int narrowings = 2;
constexpr unsigned bucketShift = 19;  ///< keeps of a float's bits its exponent and four bits of its fraction

std::uint32_t bucketOf(float value) { return std::bit_cast<std::uint32_t>(std::abs(value)) >> bucketShift; }

float leastOf(std::uint32_t bucket) { return std::bit_cast<float>(bucket << bucketShift); }

/// Returns the sum of squares, in eight partial sums that compilers can vectorise.
double squaredNorm(std::span<const float> values) {
  std::array<double, 8> sums{};
  std::size_t i = 0;
  for (; i + 8 <= values.size(); i += 8)
    for (std::size_t k = 0; k < 8; ++k) sums[k] += double(values[i + k]) * double(values[i + k]);
  for (; i < values.size(); ++i) sums[0] += double(values[i]) * double(values[i]);
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

std::span<const float> blockOf(std::span<const float> values, std::size_t block) {
  return values.subspan(block * blockSize, std::min(blockSize, values.size() - block * blockSize));
}

float greatestMagnitude(std::span<const float> values) {
  std::array<float, 4> most{};
  std::size_t i = 0;
  for (; i + 4 <= values.size(); i += 4)
    for (std::size_t k = 0; k < 4; ++k) {
      const float magnitude = std::abs(values[i + k]);
      most[k] = magnitude > most[k] ? magnitude : most[k];
    }
  for (; i < values.size(); ++i) most[0] = std::max(most[0], std::abs(values[i]));
  return std::max({most[0], most[1], most[2], most[3]});
}

}  // namespace

RowCutter::RowCutter(std::size_t count, std::vector<std::uint32_t> varying)
    : varying_(std::move(varying)),
      varies_(count, 0),
      blockGreatest_((count + blockSize - 1) / blockSize),
      blockSum_(blockGreatest_.size()),
      candidates_{std::vector<std::uint32_t>(count), std::vector<float>(count)},
      places_(varying_.size()) {
  for (const std::uint32_t i : varying_) varies_[i] = 1;
}

void RowCutter::cut(std::span<const float> shared, std::span<const float> values, std::size_t rows,
                    double relativeError, SparseRow& kept, std::vector<std::size_t>& ends) {
  assert(relativeError >= 0.0 && relativeError <= 1.0);
  assert(shared.size() == varies_.size() && values.size() == rows * varying_.size());
  const std::size_t width = varying_.size();
  if (relativeError >= 1.0) return ends.insert(ends.end(), rows, kept.indices.size()), void();
  const double total = sumUp(shared);
  budgets_.clear();
  for (std::size_t r = 0; r < rows; ++r)
    budgets_.push_back(relativeError * relativeError *
                       (total + squaredNorm(values.subspan(r * width, width))));
  const auto [least, most] = std::minmax_element(budgets_.begin(), budgets_.end());
  gather(shared, chooseBlocks(*least));
  for (int pass = 0; pass < narrowings; ++pass)
    narrow((*least - dropped_) / static_cast<double>(candidateCount_));
  for (std::size_t j = 0, k = 0; k < width; ++j)
    if (candidates_.indices[j] == varying_[k]) places_[k++] = j;
  makeBuckets(*least - dropped_, *most);
  for (std::size_t r = 0; r < rows; ++r) {
    const auto own = values.subspan(r * width, width);
    for (std::size_t k = 0; k < width; ++k) candidates_.values[places_[k]] = own[k];
    append(dropLimit(budgets_[r] - dropped_, own), kept);
    ends.push_back(kept.indices.size());
  }
}

// Computes sums of squares and bounds of magnitudes per block; returns the sum of all squares.
double RowCutter::sumUp(std::span<const float> shared) {
  double total = 0.0;
  for (std::size_t b = 0; b < blockSum_.size(); ++b) {
    const auto block = blockOf(shared, b);
    blockGreatest_[b] = greatestMagnitude(block);
    blockSum_[b] = blockGreatest_[b] > 0.0f ? squaredNorm(block) : 0.0;
    total += blockSum_[b];
  }
  for (const std::uint32_t i : varying_) blockGreatest_[i / blockSize] = std::numeric_limits<float>::max();
  return total;
}

// Finds the blocks that have candidates, and returns the limit of their squares. All squares up to the mean
// permitted error may be dropped together, and that mean grows as blocks without greater squares are left
// out.
double RowCutter::chooseBlocks(double budget) {
  blocks_.clear();
  for (std::uint32_t b = 0; b < blockSum_.size(); ++b)
    if (blockGreatest_[b] > 0.0f) blocks_.push_back(b);
  dropped_ = 0.0;
  double limit = 0.0;
  for (std::size_t before = 0; before != blocks_.size();) {
    before = blocks_.size();
    limit =
        std::max(budget - dropped_, 0.0) / static_cast<double>(std::max<std::size_t>(before, 1) * blockSize);
    std::size_t count = 0;
    for (const std::uint32_t b : blocks_) {
      const bool stays = double(blockGreatest_[b]) * double(blockGreatest_[b]) > limit;
      blocks_[count] = b;
      count += stays ? 1 : 0;
      dropped_ += stays ? 0.0 : blockSum_[b];
    }
    blocks_.resize(count);
  }
  return limit;
}

// Collects the candidates: the varying coefficients and all whose square is above the limit.
void RowCutter::gather(std::span<const float> shared, double limit) {
  std::uint32_t* indices = candidates_.indices.data();
  float* values = candidates_.values.data();
  const std::uint8_t* varies = varies_.data();
  std::size_t count = 0;
  double dropped = dropped_;
  for (const std::uint32_t b : blocks_) {
    std::uint32_t i = b * static_cast<std::uint32_t>(blockSize);
    for (const float value : blockOf(shared, b)) {
      const double square = double(value) * double(value);
      // No branches here and below, because they could not be predicted.
      const bool stays = (square > limit) | (varies[i] != 0);
      indices[count] = i++;
      values[count] = value;
      count += stays ? 1 : 0;
      dropped += square * static_cast<double>(!stays);
    }
  }
  candidateCount_ = count;
  dropped_ = dropped;
}

// Reduces the candidates to those that gather() would have collected with this limit.
void RowCutter::narrow(double limit) {
  std::uint32_t* indices = candidates_.indices.data();
  float* values = candidates_.values.data();
  const std::uint8_t* varies = varies_.data();
  std::size_t count = 0;
  double dropped = dropped_;
  for (std::size_t j = 0; j < candidateCount_; ++j) {
    const double square = double(values[j]) * double(values[j]);
    const bool stays = (square > limit) | (varies[indices[j]] != 0);
    indices[count] = indices[j];
    values[count] = values[j];
    count += stays ? 1 : 0;
    dropped += square * static_cast<double>(!stays);
  }
  candidateCount_ = count;
  dropped_ = dropped;
}

// Sums the candidates' squares by magnitude, without the varying ones. Magnitudes below the mean permitted
// error may all be dropped, and none above the entire error.
void RowCutter::makeBuckets(double leastBudget, double mostBudget) {
  const auto bucketOfSquare = [](double square) {
    return bucketOf(static_cast<float>(std::sqrt(std::max(square, 0.0))));
  };
  firstBucket_ = bucketOfSquare(leastBudget / static_cast<double>(std::max<std::size_t>(candidateCount_, 1)));
  lastBucket_ = std::max(firstBucket_, bucketOfSquare(mostBudget) + 1);
  sharedSum_.assign(lastBucket_ - firstBucket_ + 1, 0.0);
  addTo(sharedSum_, std::span(candidates_.values).first(candidateCount_));
}

void RowCutter::addTo(std::vector<double>& sums, std::span<const float> values) const {
  const std::uint32_t first = firstBucket_, last = lastBucket_;
  double* out = sums.data();
  for (const float value : values)
    out[std::clamp(bucketOf(value), first, last) - first] += double(value) * double(value);
}

// Returns the magnitude up to which candidates can be dropped within a sum of squares; 0 if none can. Equal
// magnitudes are dropped together or not at all.
float RowCutter::dropLimit(double budget, std::span<const float> own) {
  if (!(budget > 0.0) || candidateCount_ == 0) return 0.0f;
  bucketSum_ = sharedSum_;
  addTo(bucketSum_, own);
  std::uint32_t bucket = 0;
  double dropped = 0.0;
  while (bucket < bucketSum_.size() && dropped + bucketSum_[bucket] <= budget)
    dropped += bucketSum_[bucket++];
  const float from = bucket > 0 ? leastOf(firstBucket_ + bucket) : 0.0f;
  const float to = firstBucket_ + bucket < lastBucket_ ? leastOf(firstBucket_ + bucket + 1)
                                                       : std::numeric_limits<float>::infinity();
  undecided_.resize(candidateCount_);
  std::size_t count = 0;
  for (const float value : std::span(candidates_.values).first(candidateCount_)) {
    undecided_[count] = std::abs(value);
    count +=
        static_cast<std::size_t>(std::abs(value) >= from) & static_cast<std::size_t>(std::abs(value) < to);
  }
  undecided_.resize(count);
  std::sort(undecided_.begin(), undecided_.end());
  float limit = bucket > 0 ? std::nextafter(from, 0.0f) : 0.0f;
  for (std::size_t i = 0; i < undecided_.size();) {
    std::size_t end = i;
    while (end < undecided_.size() && undecided_[end] == undecided_[i]) ++end;
    dropped += static_cast<double>(end - i) * double(undecided_[i]) * double(undecided_[i]);
    if (dropped > budget) break;
    limit = undecided_[i];
    i = end;
  }
  return limit;
}

void RowCutter::append(float limit, SparseRow& kept) const {
  std::size_t size = kept.indices.size();
  kept.indices.resize(size + candidateCount_);
  kept.values.resize(size + candidateCount_);
  std::uint32_t* indices = kept.indices.data();
  float* values = kept.values.data();
  for (std::size_t j = 0; j < candidateCount_; ++j) {
    indices[size] = candidates_.indices[j];
    values[size] = candidates_.values[j];
    size += std::abs(candidates_.values[j]) > limit ? 1 : 0;
  }
  kept.indices.resize(size);
  kept.values.resize(size);
}

}  // namespace prelight::haar
