#include "basis/haar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "basis/cube_map.h"

namespace prelight {
namespace {

template <typename T>
std::vector<T> randomTexels(int faceSize, unsigned seed, double least = -1.0) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(least, 1.0);
  std::vector<T> values(cubeTexelCount(faceSize));
  for (T& value : values) value = static_cast<T>(uniform(random));
  return values;
}

template <typename T>
double squares(const std::vector<T>& values) {
  long double sum = 0.0;
  for (const T value : values) sum += static_cast<long double>(value) * static_cast<long double>(value);
  return static_cast<double>(sum);
}

template <typename T>
void expectPerfectReconstruction(double tolerance) {
  for (int size = 1; size <= 128; size *= 2) {
    const std::vector<T> texels = randomTexels<T>(size, 7u + static_cast<unsigned>(size));
    std::vector<T> values = texels;
    haar::forward(std::span<T>(values), size);
    haar::inverse(std::span<T>(values), size);
    for (std::size_t i = 0; i < texels.size(); ++i)
      ASSERT_NEAR(values[i], texels[i], tolerance) << size << " " << i;
  }
}

template <typename T>
void expectParseval(double tolerance) {
  for (int size = 1; size <= 128; size *= 2) {
    std::vector<T> values = randomTexels<T>(size, 70u + static_cast<unsigned>(size));
    const double before = squares(values);
    haar::forward(std::span<T>(values), size);
    EXPECT_NEAR(squares(values) / before, 1.0, tolerance) << size;
  }
}

TEST(Haar, ForwardThenInverse_EverySize_GivesTheTexelsBack) {
  expectPerfectReconstruction<float>(1e-6);
  expectPerfectReconstruction<double>(1e-14);
}

TEST(Haar, Forward_EverySize_KeepsSumsOfSquares) {
  expectParseval<float>(1e-6);
  expectParseval<double>(1e-14);
}

TEST(Haar, Forward_AnyTexels_AreProjectionsOntoTheDocumentedFunctions) {
  constexpr int size = 8;
  const std::vector<double> texels = randomTexels<double>(size, 3);
  std::vector<double> coefficients = texels;
  haar::forward(std::span<double>(coefficients), size);
  for (std::uint32_t i = 0; i < coefficients.size(); ++i) {
    const haar::Wavelet wavelet = haar::waveletOf(i, size);
    double projection = 0.0;
    for (int row = 0; row < size; ++row) {
      for (int column = 0; column < size; ++column) {
        const int texel = (wavelet.face * size + row) * size + column;
        projection += haar::valueAt(wavelet, row, column) * texels[static_cast<std::size_t>(texel)];
      }
    }
    EXPECT_NEAR(coefficients[i], projection, 1e-14) << i;
  }
}

TEST(Haar, WaveletOf_KnownIndices_AreAsDocumented) {
  const auto expectWavelet = [](std::uint32_t index, int face, int row, int column, int size,
                                haar::Orientation orientation) {
    const haar::Wavelet wavelet = haar::waveletOf(index, 8);
    EXPECT_EQ(wavelet.face, face) << index;
    EXPECT_EQ(wavelet.row, row) << index;
    EXPECT_EQ(wavelet.column, column) << index;
    EXPECT_EQ(wavelet.size, size) << index;
    EXPECT_EQ(wavelet.orientation, orientation) << index;
  };
  expectWavelet(0, 0, 0, 0, 8, haar::Orientation::Average);
  expectWavelet(64 + 4, 1, 0, 0, 8, haar::Orientation::Horizontal);
  expectWavelet(2 * 64 + 4 * 8, 2, 0, 0, 8, haar::Orientation::Vertical);
  expectWavelet(4 * 8 + 4, 0, 0, 0, 8, haar::Orientation::Diagonal);
  expectWavelet(5 * 64 + 7 * 8 + 6, 5, 6, 6, 2, haar::Orientation::Vertical);
  expectWavelet(2 * 8 + 6, 0, 0, 4, 4, haar::Orientation::Diagonal);
}

TEST(Haar, AllCoefficients_EqualDirectSummationOverTexels) {
  constexpr int size = 64;
  std::vector<float> light = randomTexels<float>(size, 11, 0.0);
  std::vector<float> transfer = randomTexels<float>(size, 12, 0.0);
  double direct = 0.0;
  for (std::size_t i = 0; i < light.size(); ++i) direct += double(light[i]) * double(transfer[i]);
  haar::forward(std::span<float>(light), size);
  haar::forward(std::span<float>(transfer), size);
  double sum = 0.0;
  for (std::size_t i = 0; i < light.size(); ++i) sum += double(light[i]) * double(transfer[i]);
  EXPECT_NEAR(sum / direct, 1.0, 1e-5);
}

}  // namespace
}  // namespace prelight
