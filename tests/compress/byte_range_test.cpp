#include "compress/compress.h"

#include <gtest/gtest.h>

#include <vector>

namespace prelight {
namespace {

double squaredError(const ByteRange& range, const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) {
    const double error = range.decode(range.encode(value)) - value;
    sum += error * error;
  }
  return sum;
}

// Bytes 0, 100, 200 and 255 of the range from least to greatest miss two of the values by 0.4 steps each. The
// best line through the values halves the squared error: a constant would leave 4 x 0.2^2, and the slope
// lessens that.
TEST(ByteRange, ValuesBesideTheBytes_AreFittedByRegression) {
  const std::vector<double> values{0.0, 100.4, 200.4, 255.0};
  const ByteRange fitted = fitByteRange(values, std::vector<double>(4, 1.0));
  EXPECT_NEAR(squaredError(ByteRange{0.0f, 1.0f}, values), 0.32, 1e-9);
  EXPECT_NEAR(squaredError(fitted, values), 0.158, 0.001);
}

TEST(ByteRange, WeightOfAValue_DrawsTheRangeToIt) {
  const std::vector<double> values{0.0, 100.4, 200.4, 255.0};
  const ByteRange fitted = fitByteRange(values, std::vector<double>{1.0, 1.0, 1000.0, 1.0});
  EXPECT_NEAR(fitted.decode(fitted.encode(200.4)), 200.4, 0.01);
}

TEST(ByteRange, OneValueOrNone_IsKept) {
  const std::vector<double> same(3, -2.5), ones(3, 1.0);
  const ByteRange fitted = fitByteRange(same, ones);
  EXPECT_EQ(fitted.decode(fitted.encode(-2.5)), -2.5);
  EXPECT_EQ(fitByteRange({}, {}).decode(0), 0.0);
}

}  // namespace
}  // namespace prelight
