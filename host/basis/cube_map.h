#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "prelight/picture.h"

/// Functions of world directions on the six faces of a cube, laid out as an OpenGL cube map: faces +X, -X,
/// +Y, -Y, +Z, -Z, and the texel index face S^2 + row S + column for faces of S x S texels. With a = 2u - 1
/// and b = 2v - 1, where u grows with the column and v with the row, the point (u, v) of a face looks along
///
///     +X ( 1, -b, -a)   +Y (a,  1,  b)   +Z ( a, -b,  1)
///     -X (-1, -b,  a)   -Y (a, -1, -b)   -Z (-a, -b, -1)
namespace prelight {

constexpr int cubeFaces = 6;
constexpr int maxCubeFaceSize = 1024;

/// A face's frame: the direction of (u, v) is axis + a right + b down, not normalised.
struct CubeFace {
  glm::dvec3 axis;
  glm::dvec3 right;
  glm::dvec3 down;
};

const CubeFace& cubeFace(int face);

constexpr std::size_t cubeTexelCount(int faceSize) {
  return std::size_t(cubeFaces) * static_cast<std::size_t>(faceSize) * static_cast<std::size_t>(faceSize);
}

/// Throws UsageError naming `where` unless the size is a power of two from 1 to 1024.
void checkCubeFaceSize(int faceSize, const std::string& where);

/// Returns the unit direction of the point (u, v) in [0,1]^2 of a face.
glm::dvec3 cubeDirection(int face, double u, double v);

/// Returns the unit direction of a texel's centre.
glm::dvec3 cubeTexelDirection(std::uint32_t texel, int faceSize);

/// Returns the texel in which a direction (any length but 0) lies. On the seam of two faces it is the one of
/// the x axis before y before z.
std::uint32_t cubeTexel(const glm::dvec3& direction, int faceSize);

/// Integrals of the unit direction over the texels of a face, [row][column], along right, down and axis of
/// the face.
template <typename T>
struct CubeMoments {
  std::vector<T> x, y, z;
};

/// Tables for integrals over texels, in closed form. All faces are alike, so they hold one face.
class CubeTexels {
 public:
  /// Throws UsageError for a size that checkCubeFaceSize() refuses.
  explicit CubeTexels(int faceSize);

  int faceSize() const { return faceSize_; }
  std::size_t count() const { return cubeTexelCount(faceSize_); }

  /// Returns the solid angle of a texel in sr; the sum over all texels is 4 pi.
  double solidAngle(std::uint32_t texel) const { return solidAngles_[texel % solidAngles_.size()]; }

  /// Returns the integral of the unit direction w over a texel. Its dot product with a normal is the exact
  /// integral of n.w.
  glm::dvec3 moment(std::uint32_t texel) const;

  /// Computes the transfer of an unoccluded receiver: the integral of max(n.w, 0) / pi over every texel, also
  /// those that the horizon cuts. `out` has count() entries, whose sum is 1. Thread-safe.
  void open(const glm::dvec3& normal, std::span<double> out) const;
  void open(const glm::dvec3& normal, std::span<float> out) const;

 private:
  int faceSize_;
  std::vector<double> solidAngles_;  ///< [row][column]
  CubeMoments<double> moments_;
  CubeMoments<float> shortMoments_;  ///< in single precision, for results in single precision
};

/// Linear radiance of the texels, constant over each.
struct CubeMap {
  int faceSize = 0;
  std::vector<glm::vec3> radiance;  ///< [face][row][column], W/(m2 sr), finite and >= 0
};

/// Throws UsageError for a bad size and InputError for a wrong number of texels or the first one that is
/// negative or not finite; both name `where`.
void checkCubeMap(const CubeMap& map, const std::string& where);

/// Returns a sky on a cube: the mean radiance of the sky over each texel. The overlap of the sky's texels and
/// the cube's is integrated in smooth pieces, so that no energy is lost however small a bright texel is.
/// Throws UsageError for a bad size, InputError for a sky with negative or non-finite texels.
CubeMap cubeFromEnvironment(const Environment& environment, int faceSize);

}  // namespace prelight
