#include "benchmarks/lab/haar_rotation.h"

#include <algorithm>

#include "basis/haar.h"

namespace prelight::haar {

WaveletRotation::WaveletRotation(const glm::dmat3& rotation, int faceSize, double columnError)
    : faceSize_(faceSize), columnError_(columnError), resampling_(rotateByArea(rotation, faceSize)) {
  const std::size_t count = cubeTexelCount(faceSize);
  offsets_.assign(count + 1, 0);
  for (const std::uint32_t source : resampling_.sources) ++offsets_[source + 1];
  for (std::size_t i = 0; i < count; ++i) offsets_[i + 1] += offsets_[i];
  targets_.resize(resampling_.sources.size());
  weights_.resize(resampling_.sources.size());
  std::vector<std::uint32_t> next(offsets_.begin(), offsets_.end() - 1);
  for (std::uint32_t target = 0; target < count; ++target) {
    for (std::uint32_t k = resampling_.offsets[target]; k < resampling_.offsets[target + 1]; ++k) {
      const std::uint32_t place = next[resampling_.sources[k]]++;
      targets_[place] = target;
      weights_[place] = resampling_.weights[k];
    }
  }
  resampling_ = {};
}

const SparseRow& WaveletRotation::column(std::uint32_t coefficient) {
  const auto found = columns_.find(coefficient);
  if (found != columns_.end()) return found->second;
  const Wavelet wavelet = waveletOf(coefficient, faceSize_);
  std::vector<double> texels(cubeTexelCount(faceSize_), 0.0);
  for (int row = wavelet.row; row < wavelet.row + wavelet.size; ++row) {
    for (int column = wavelet.column; column < wavelet.column + wavelet.size; ++column) {
      const auto source = static_cast<std::uint32_t>((wavelet.face * faceSize_ + row) * faceSize_ + column);
      const double value = valueAt(wavelet, row, column);
      for (std::uint32_t k = offsets_[source]; k < offsets_[source + 1]; ++k) {
        texels[targets_[k]] += value * static_cast<double>(weights_[k]);
      }
    }
  }
  forward(std::span<double>(texels), faceSize_);
  const std::vector<float> coefficients(texels.begin(), texels.end());
  // Coefficients that cancel leave rounding errors, which are dropped here.
  return columns_.emplace(coefficient, keepError(coefficients, std::max(columnError_, 1e-7))).first->second;
}

SparseLight WaveletRotation::rotate(const SparseLight& light) {
  std::vector<glm::dvec3> sum(cubeTexelCount(faceSize_), glm::dvec3(0.0));
  std::vector<bool> touched(sum.size(), false);
  for (std::size_t j = 0; j < light.indices.size(); ++j) {
    const SparseRow& to = column(light.indices[j]);
    for (std::size_t k = 0; k < to.indices.size(); ++k) {
      sum[to.indices[k]] += static_cast<double>(to.values[k]) * glm::dvec3(light.values[j]);
      touched[to.indices[k]] = true;
    }
  }
  SparseLight rotated;
  for (std::uint32_t i = 0; i < sum.size(); ++i) {
    if (!touched[i]) continue;
    rotated.indices.push_back(i);
    rotated.values.push_back(glm::vec3(sum[i]));
  }
  return rotated;
}

}  // namespace prelight::haar
