#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "basis/cube_map.h"

/// Orthonormal two-dimensional Haar wavelets on each face of a cube map (the non-standard decomposition: rows
/// and columns take turns at every level). The transform works in place: a coefficient's index is its place
/// in the cube map, face S^2 + row S + column (basis/cube_map.h).
///
/// A level combines the averages of four blocks of h x h texels, h = 1, 2, 4 ... S/2, with upper left corners
/// at (r, c), (r, c+h), (r+h, c), (r+h, c+h). With these averages named p q / s t in that order, it writes
///
///     at (r,   c  ):  (p + q + s + t) / 2    the average of the block of 2h x 2h, used by the next level
///     at (r,   c+h):  (p - q + s - t) / 2    horizontal detail: left against right
///     at (r+h, c  ):  (p + q - s - t) / 2    vertical detail: upper against lower
///     at (r+h, c+h):  (p - q - s + t) / 2    diagonal detail
///
/// At the end (0, 0) holds the sum of the face's texels over S. Sums of squares are kept, and so are dot
/// products.

namespace prelight::haar {

enum class Orientation : std::uint32_t { Average = 0, Horizontal = 1, Vertical = 2, Diagonal = 3 };

/// The support of a coefficient's function and its values there: +-1 / size, where Average is positive
/// everywhere and the others have the signs of the table above.
struct Wavelet {
  int face = 0;
  int row = 0;  ///< upper left texel of its square support
  int column = 0;
  int size = 1;  ///< texels along a side of the support: 2h, or S for the average
  Orientation orientation = Orientation::Average;
};

/// Returns the function of a coefficient. With (row, column) of the index and h the lowest bit set in row |
/// column, the support begins at (row & ~h, column & ~h). A set bit h in column means horizontal, in row
/// vertical, in both diagonal. (0, 0) is the face's average.
Wavelet waveletOf(std::uint32_t index, int faceSize);

/// Returns the value of a wavelet at a texel of its face.
double valueAt(const Wavelet& wavelet, int row, int column);

/// Transforms texels to coefficients, in place. `values` has 6 S^2 entries; S is a power of two.
void forward(std::span<float> values, int faceSize);
void forward(std::span<double> values, int faceSize);

/// Transforms coefficients to texels, in place: the inverse of forward().
void inverse(std::span<float> values, int faceSize);
void inverse(std::span<double> values, int faceSize);

// Selection of coefficients: of transfer when it is stored, and of the light when it is used.

/// The kept coefficients of a row, ascending by index.
struct SparseRow {
  std::vector<std::uint32_t> indices;
  std::vector<float> values;
};

/// Returns the fewest coefficients, largest first, whose relative L2 error is at most `relativeError` in [0,
/// 1]: the square root of the ratio of the dropped sum of squares to the total. 0 keeps all nonzero
/// coefficients. Takes linear time.
SparseRow keepError(std::span<const float> coefficients, double relativeError);

/// Returns the coefficients of a cube map's radiance, [channel][i]. Throws as checkCubeMap() does.
std::vector<float> transformLight(const CubeMap& map);

/// The selected coefficients of a light, shared by its channels, ascending by index.
struct SparseLight {
  std::vector<std::uint32_t> indices;
  std::vector<glm::vec3> values;
};

/// A selected coefficient of a light.
struct LitWavelet {
  std::uint32_t index = 0;  ///< below 6 faceSize^2
  glm::vec3 color{0.0f};
};

/// Returns [i] the importance of the light's coefficients: the root of the sum over channels of squares,
/// times the weight. With coefficientRms() of a transfer as weights it is the RMS contribution of a
/// coefficient to the lit result.
std::vector<float> lightMagnitudes(std::span<const float> light, std::span<const float> weights);

/// Returns the `count` most important coefficients unchanged (Ng et al. 2003; Kautz 2004).
SparseLight selectLight(std::span<const float> light, std::span<const float> weights, std::size_t count);

/// Keeps a selection steady while a light changes from frame to frame: a selected coefficient stays selected
/// until its magnitude falls below 1 / (1 + hysteresis) of one that is not, and coefficients fade in and out
/// over `frames` frames. Values are always those of the present light.
class SteadySelection {
 public:
  SteadySelection(std::size_t count, float hysteresis, int frames)
      : count_(count), hysteresis_(hysteresis), step_(1.0f / static_cast<float>(frames)) {}

  /// Returns the selection for the next frame's light: at least `count` coefficients, and those that are
  /// fading out. The first call selects without fading.
  SparseLight next(std::span<const float> light, std::span<const float> weights);

 private:
  std::size_t count_;
  float hysteresis_;
  float step_;
  std::vector<float> presence_;  ///< [i] from 0, out, to 1, in
  std::vector<bool> chosen_;
};

/// Returns the expected relative RMS error of results lit by a part of the light, assuming uncorrelated
/// transfer coefficients: the root of the sum of squared magnitudes of light - part, divided by that of the
/// light.
double expectedError(std::span<const float> light, const SparseLight& part, std::span<const float> weights);

}  // namespace prelight::haar
