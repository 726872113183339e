#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "prelight/picture.h"

namespace prelight::benchmarks {

/// Returns the root mean square difference of radiance over pixels and channels. Radiance above 1, about the
/// white of a display, counts as 1. The pictures have the same size.
double pictureRmse(const Picture& first, const Picture& second);

/// An error that was measured against a noisy truth.
struct MeasuredError {
  double rmse = 0.0;           ///< as by pictureRmse(), without the part that is due to the truth's noise
  double standardError = 0.0;  ///< standard error of `rmse` due to the truth's noise
};

/// Returns the error of a picture against two pictures of one truth whose noise is independent, also between
/// pixels. It is the mean of (picture - first) (picture - second), whose expectation is the square of the
/// error without noise.
MeasuredError errorBetween(const Picture& picture, const Picture& first, const Picture& second);

/// Returns whether two errors differ by more than twice the standard error of their difference, assuming
/// independence.
bool differ(const MeasuredError& a, const MeasuredError& b);

/// Two pictures as displayed: [row][column], sRGB-encoded in [0,1].
struct DisplayedPair {
  std::span<const glm::vec3> reference, test;
};

/// Returns whether FLIP can be measured: whether there is a Python with flip-evaluator.
bool canMeasureFlip();

/// Returns the mean FLIP of each pair of pictures of one size, from 0 (alike) to 1, at 67 pixels per degree;
/// nothing if canMeasureFlip() is false.
std::vector<double> measureFlip(std::span<const DisplayedPair> pairs, int width, int height);

}  // namespace prelight::benchmarks
