#include "basis/haar.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "basis/cube_map.h"
#include "basis/haar_cut.h"

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

namespace {

/// Returns the indices of the `count` greatest magnitudes above 0, ascending by index.
std::vector<std::uint32_t> greatest(std::span<const float> magnitudes, std::size_t count) {
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < magnitudes.size(); ++i) {
    if (magnitudes[i] > 0.0f) indices.push_back(i);
  }
  if (indices.size() > count) {
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
      return magnitudes[a] != magnitudes[b] ? magnitudes[a] > magnitudes[b] : a < b;
    };
    std::nth_element(indices.begin(), indices.begin() + static_cast<std::ptrdiff_t>(count), indices.end(),
                     before);
    indices.resize(count);
    std::sort(indices.begin(), indices.end());
  }
  return indices;
}

glm::vec3 lightAt(std::span<const float> light, std::uint32_t i) {
  const std::size_t count = light.size() / 3;
  return {light[i], light[count + i], light[2 * count + i]};
}

}  // namespace

SparseRow keepError(std::span<const float> coefficients, double relativeError) {
  SparseRow row;
  std::vector<std::size_t> ends;
  RowCutter(coefficients.size()).cut(coefficients, {}, 1, relativeError, row, ends);
  return row;
}

std::vector<float> transformLight(const CubeMap& map) {
  checkCubeMap(map, "cube map");
  const std::size_t count = map.radiance.size();
  std::vector<float> light(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    for (int c = 0; c < 3; ++c) light[static_cast<std::size_t>(c) * count + i] = map.radiance[i][c];
  }
  for (std::size_t c = 0; c < 3; ++c)
    forward(std::span<float>(light).subspan(c * count, count), map.faceSize);
  return light;
}

std::vector<float> lightMagnitudes(std::span<const float> light, std::span<const float> weights) {
  assert(light.size() == 3 * weights.size());
  std::vector<float> magnitudes(weights.size());
  for (std::uint32_t i = 0; i < magnitudes.size(); ++i)
    magnitudes[i] = glm::length(lightAt(light, i)) * weights[i];
  return magnitudes;
}

SparseLight selectLight(std::span<const float> light, std::span<const float> weights, std::size_t count) {
  SparseLight selection{greatest(lightMagnitudes(light, weights), count), {}};
  for (const std::uint32_t i : selection.indices) selection.values.push_back(lightAt(light, i));
  return selection;
}

SparseLight SteadySelection::next(std::span<const float> light, std::span<const float> weights) {
  std::vector<float> magnitudes = lightMagnitudes(light, weights);
  const bool first = chosen_.size() != magnitudes.size();
  if (first) {
    chosen_.assign(magnitudes.size(), false);
    presence_.assign(magnitudes.size(), 0.0f);
  }
  for (std::size_t i = 0; i < magnitudes.size(); ++i) {
    if (chosen_[i]) magnitudes[i] *= 1.0f + hysteresis_;
  }
  std::fill(chosen_.begin(), chosen_.end(), false);
  for (const std::uint32_t i : greatest(magnitudes, count_)) chosen_[i] = true;
  SparseLight selection;
  for (std::uint32_t i = 0; i < presence_.size(); ++i) {
    const float target = chosen_[i] ? 1.0f : 0.0f;
    presence_[i] = first ? target : std::clamp(target, presence_[i] - step_, presence_[i] + step_);
    if (presence_[i] <= 0.0f) continue;
    selection.indices.push_back(i);
    selection.values.push_back(presence_[i] * lightAt(light, i));
  }
  return selection;
}

double expectedError(std::span<const float> light, const SparseLight& part, std::span<const float> weights) {
  double total = 0.0, missing = 0.0;
  std::size_t next = 0;
  for (std::uint32_t i = 0; i < weights.size(); ++i) {
    const glm::dvec3 whole(lightAt(light, i));
    glm::dvec3 rest = whole;
    if (next < part.indices.size() && part.indices[next] == i) rest -= glm::dvec3(part.values[next++]);
    const double square = static_cast<double>(weights[i]) * weights[i];
    total += square * glm::dot(whole, whole);
    missing += square * glm::dot(rest, rest);
  }
  return total > 0.0 ? std::sqrt(missing / total) : 0.0;
}

}  // namespace prelight::haar
