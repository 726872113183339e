#include "viewer/core/picture_slices.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

namespace prelight::viewer {
namespace {

constexpr double mostGrowth = 4.0;  ///< of a slice over the one before it
/// Times are forgotten by these factors with each slice that takes its time, and with each draft: the machine
/// may have been busy with something else.
constexpr double remembered = 0.97, rememberedOfDrafts = 0.995;
/// A slice may take this many times longer than expected, where it has the dearest samples known.
constexpr double dearest = 2.0;
/// How much longer drafts of twice the width and height are taken to be before any two sizes are known.
constexpr double guessedGrowth = 1.6;
constexpr double enough = 0.7;  ///< of the limit of drafts, so that sizes do not alternate

/// Tall slices could not become narrow enough where a picture's samples begin to cost much.
constexpr int mostRows = 8 * PictureSlices::leastSide;

int towardsLeast(double length) {
  const int side = PictureSlices::leastSide;
  return std::max(1, static_cast<int>(std::lround(length / side))) * side;
}

}  // namespace

PictureSlices::PictureSlices(int width, int height, double seconds)
    : width_(width), height_(height), seconds_(seconds), top_(height) {
  if (!isSliced() || (width <= leastSide && height <= leastSide)) probesDrawn_ = probes;
  startRow();
}

/// The centre, and then the middles of the four quarters.
SampleRect PictureSlices::probe() const {
  constexpr std::array<std::array<double, 2>, probes> places = {
      {{0.5, 0.5}, {0.25, 0.75}, {0.75, 0.75}, {0.25, 0.25}, {0.75, 0.25}}};
  const auto& place = places[static_cast<std::size_t>(probesDrawn_)];
  SampleRect rect{0, 0, std::min(width_, leastSide), std::min(height_, leastSide)};
  rect.x = static_cast<int>(place[0] * (width_ - rect.width));
  rect.y = static_cast<int>(place[1] * (height_ - rect.height));
  return rect;
}

SampleRect PictureSlices::next() const {
  if (probesDrawn_ < probes) return probe();
  const int left = width_ - x_;
  int width = isSliced() ? std::min(left, towardsLeast(samplesNow() / rows_)) : left;
  if (left - width < leastSide) width = left;
  return {x_, top_ - rows_, width, rows_};
}

void PictureSlices::drew(double seconds) {
  const SampleRect rect = next();
  learn(seconds, rect.area());
  if (probesDrawn_ < probes) {
    const bool isDear = seconds > 0.5 * seconds_;
    probesDrawn_ = isDear ? probes : probesDrawn_ + 1;
    if (probesDrawn_ == probes) startRow();
    return;
  }
  x_ += rect.width;
  if (x_ < width_) return;
  top_ -= rows_;
  x_ = 0;
  startRow();
}

/// Returns the time of one sample of a slice, s, without what each slice takes.
double PictureSlices::costOf(double seconds, double samples) const {
  return std::max(seconds - overhead_, 0.0) / samples;
}

void PictureSlices::learn(double seconds, long area) {
  overhead_ = std::min(overhead_, seconds);
  lastSeconds_ = seconds;
  lastSamples_ = static_cast<double>(area);
  dearestSeconds_ *= isSliced() ? std::pow(remembered, seconds / seconds_) : 1.0;
  if (costOf(seconds, lastSamples_) < costOf(dearestSeconds_, dearestSamples_)) return;
  dearestSeconds_ = seconds;
  dearestSamples_ = lastSamples_;
}

/// Returns how many samples the next slice should have.
double PictureSlices::samplesNow() const {
  // Where most of a slice's time is spent on every slice alike, smaller ones would only add to it.
  const double aim = std::max(seconds_, 2.0 * overhead_) - overhead_;
  const double cost =
      std::max(costOf(lastSeconds_, lastSamples_), costOf(dearestSeconds_, dearestSamples_) / dearest);
  const double most = std::max(lastSamples_, static_cast<double>(leastSide * leastSide)) * mostGrowth;
  return cost > 0.0 ? std::min(aim / cost, most) : most;
}

void PictureSlices::startRow() {
  if (!isSliced()) {
    rows_ = top_;
    return;
  }
  const int rows = lastSamples_ > 0.0 ? std::min(towardsLeast(std::sqrt(samplesNow())), mostRows) : leastSide;
  rows_ = top_ - rows < leastSide ? top_ : std::min(rows, top_);
}

void DraftSize::restart() { *this = DraftSize(); }

/// Returns how long a draft of a size should take, which is the next finer one than the present.
double DraftSize::expected(std::size_t finer) const {
  const double known = seconds_[finer], now = seconds_[finer + 1];
  const double coarser = finer + 2 < seconds_.size() ? seconds_[finer + 2] : 0.0;
  if (known > 0.0) return known;
  if (coarser <= 0.0) return guessedGrowth * now;
  // Four times what does not take as long at any size.
  const double fixed = std::clamp((4.0 * coarser - now) / 3.0, 0.0, now);
  return fixed + 4.0 * (now - fixed);
}

void DraftSize::drew(double seconds) {
  if (std::exchange(first_, false)) return;
  const auto size = static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(divisor_)));
  seconds_[size] = seconds;
  for (std::size_t finer = 0; finer < size; ++finer) seconds_[finer] *= rememberedOfDrafts;
  if (seconds > limit && divisor_ < mostDivisor)
    divisor_ *= 2;
  else if (divisor_ > 1 && expected(size - 1) < enough * limit)
    divisor_ /= 2;
}

}  // namespace prelight::viewer
