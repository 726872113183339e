#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <unordered_map>
#include <vector>

#include "basis/cube_overlap.h"
#include "basis/haar.h"

namespace prelight::haar {

/// Rotation of lights in the wavelet basis (Wang, Ng, Luebke and Humphreys 2006): column j is the transform
/// of the rotated j-th wavelet. Columns are computed when they are first needed and then kept, so only those
/// of a light's coefficients exist. The rotated light is the same compressed light at every angle, so nothing
/// appears or vanishes between frames.
class WaveletRotation {
 public:
  /// Prepares f'(w) = f(R^-1 w). Every column drops coefficients up to the relative L2 error `columnError` in
  /// [0, 1); 0 makes it equal to rotateByArea() followed by the transform.
  WaveletRotation(const glm::dmat3& rotation, int faceSize, double columnError);

  const SparseRow& column(std::uint32_t coefficient);

  /// Rotates the coefficients of a light. The result has more coefficients, ascending by index.
  SparseLight rotate(const SparseLight& light);

 private:
  int faceSize_;
  double columnError_;
  CubeResampling resampling_;
  std::vector<std::uint32_t> offsets_;  ///< [source texel] offsets into the transposed resampling
  std::vector<std::uint32_t> targets_;
  std::vector<float> weights_;
  std::unordered_map<std::uint32_t, SparseRow> columns_;
};

}  // namespace prelight::haar
