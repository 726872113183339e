#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

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

}  // namespace prelight::haar
