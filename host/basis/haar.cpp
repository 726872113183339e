#include "basis/haar.h"

#include <bit>
#include <cassert>

#include "basis/cube_map.h"

// [1] Stollnitz, DeRose and Salesin, "Wavelets for computer graphics: a primer", 1995: non-standard
// decomposition. [2] Sweldens, "The lifting scheme", 1996: a step overwrites what it has read, so that no
// copy is needed.

namespace prelight::haar {
namespace {

/// Performs one level on the four averages of a block. It is its own inverse.
template <typename T>
void step(T& p, T& q, T& s, T& t) {
  // Along the rows; the factor 1/sqrt(2) of both steps is applied below.
  const T upper = p + q, lower = s + t;
  const T upperDetail = p - q, lowerDetail = s - t;
  p = T(0.5) * (upper + lower);  // along the columns, with both factors
  q = T(0.5) * (upperDetail + lowerDetail);
  s = T(0.5) * (upper - lower);
  t = T(0.5) * (upperDetail - lowerDetail);
}

template <typename T>
void level(T* face, int size, int half) {
  for (int row = 0; row < size; row += 2 * half) {
    T* upper = face + static_cast<std::size_t>(row) * size;
    T* lower = upper + static_cast<std::size_t>(half) * size;
    for (int c = 0; c < size; c += 2 * half) step(upper[c], upper[c + half], lower[c], lower[c + half]);
  }
}

template <typename T>
void forwardFaces(std::span<T> values, int size) {
  assert(size >= 1 && std::has_single_bit(static_cast<unsigned>(size)) &&
         values.size() == cubeTexelCount(size));
  const std::size_t count = values.size() / cubeFaces;
  for (std::size_t face = 0; face < cubeFaces; ++face) {
    for (int half = 1; half < size; half *= 2) level(values.data() + face * count, size, half);
  }
}

template <typename T>
void inverseFaces(std::span<T> values, int size) {
  assert(size >= 1 && std::has_single_bit(static_cast<unsigned>(size)) &&
         values.size() == cubeTexelCount(size));
  const std::size_t count = values.size() / cubeFaces;
  for (std::size_t face = 0; face < cubeFaces; ++face) {
    for (int half = size / 2; half >= 1; half /= 2) level(values.data() + face * count, size, half);
  }
}

}  // namespace

Wavelet waveletOf(std::uint32_t index, int faceSize) {
  const auto size = static_cast<std::uint32_t>(faceSize);
  assert(index < cubeTexelCount(faceSize));
  const std::uint32_t row = index / size % size, column = index % size;
  Wavelet wavelet{.face = static_cast<int>(index / (size * size)), .size = faceSize};
  const std::uint32_t either = row | column;
  if (either == 0) return wavelet;
  const std::uint32_t half = either & (~either + 1);
  wavelet.row = static_cast<int>(row & ~half);
  wavelet.column = static_cast<int>(column & ~half);
  wavelet.size = static_cast<int>(2 * half);
  wavelet.orientation =
      static_cast<Orientation>(((column & half) != 0 ? 1u : 0u) | ((row & half) != 0 ? 2u : 0u));
  return wavelet;
}

double valueAt(const Wavelet& wavelet, int row, int column) {
  const int r = row - wavelet.row, c = column - wavelet.column;
  if (r < 0 || c < 0 || r >= wavelet.size || c >= wavelet.size) return 0.0;
  const auto orientation = static_cast<std::uint32_t>(wavelet.orientation);
  const bool right = (orientation & 1u) != 0 && 2 * c >= wavelet.size;
  const bool lower = (orientation & 2u) != 0 && 2 * r >= wavelet.size;
  return (right != lower ? -1.0 : 1.0) / wavelet.size;
}

void forward(std::span<float> values, int faceSize) { forwardFaces(values, faceSize); }
void forward(std::span<double> values, int faceSize) { forwardFaces(values, faceSize); }
void inverse(std::span<float> values, int faceSize) { inverseFaces(values, faceSize); }
void inverse(std::span<double> values, int faceSize) { inverseFaces(values, faceSize); }

}  // namespace prelight::haar
