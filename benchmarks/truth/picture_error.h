#pragma once

#include "prelight/picture.h"

namespace prelight::benchmarks {

/// Root of the mean square over pixels and channels of radiance, all above 1 taken for 1, which is about a
/// display's white. Pictures are of one size.
double pictureRmse(const Picture& first, const Picture& second);

/// An error that was measured against a truth that has noise.
struct MeasuredError {
  double rmse = 0.0;           ///< in the measure of pictureRmse, without the truth's part of it
  double standardError = 0.0;  ///< standard error of `rmse` by the truth's noise
};

/// Error of a picture against two pictures of one truth whose noise is independent, from pixel to pixel as
/// well: the mean of (picture - first) (picture - second), whose expectation is the square of the error
/// alone.
MeasuredError errorBetween(const Picture& picture, const Picture& first, const Picture& second);

/// The errors differ by more than twice the standard error of their difference, taken for independent.
bool differ(const MeasuredError& a, const MeasuredError& b);

}  // namespace prelight::benchmarks
