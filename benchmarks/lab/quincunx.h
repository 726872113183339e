#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace prelight {

/// Wavelets on the quincunx lattice of a cube whose faces share their borders (Sherif 6.6.6): points at the
/// corners of N x N squares a face, those on edges and corners once, 6 N^2 + 2 in all. A step of the
/// transform splits the points like the fields of a chess board, predicts each odd one as the mean of its
/// even neighbours, over edges as within faces, keeps the error of that prediction, and updates the even ones
/// so that the mean over the sphere stays. Every second step works on the board turned by 45 degrees; two
/// steps halve N. Eight corners are left at the end.
///
/// Unlike Haar wavelets these have no seams, but they are neither orthogonal nor local to blocks.
class QuincunxLattice {
 public:
  /// `intervals` is N, a power of two from 2 to 512. Throws UsageError otherwise.
  explicit QuincunxLattice(int intervals);

  std::size_t size() const { return solidAngles_.size(); }
  int intervals() const { return intervals_; }

  /// Returns the point nearest to a texel of a cube map with faces of 2 N texels. The texels nearest to a
  /// point form its cell.
  std::uint32_t pointOf(std::uint32_t texel) const;

  /// Returns the solid angle of a point's cell, sr.
  double solidAngle(std::uint32_t point) const { return solidAngles_[point]; }

  /// Transforms values at points to coefficients, in place.
  void forward(std::span<double> values) const;
  /// Transforms coefficients to values at points: undoes forward().
  void inverse(std::span<double> values) const;

  /// Transforms weights of points to weights of coefficients, in place, as transfer needs: their dot product
  /// with the result of forward() equals that of the points' weights and values.
  void transposedInverse(std::span<double> weights) const;

  /// Returns the L2 norm of every coefficient's function, by which coefficients are ranked. It is measured in
  /// the middle of a face and is used for all functions of a step.
  std::vector<double> functionNorms() const;

 private:
  /// A point that is predicted as the mean of the first `count` of `neighbours`.
  struct Odd {
    std::uint32_t point = 0;
    std::uint32_t count = 0;
    std::array<std::uint32_t, 4> neighbours{};
    std::array<double, 4> updates{};  ///< gain of each neighbour per unit of detail
  };

  std::uint32_t pointAt(const glm::ivec3& place) const;
  std::vector<glm::ivec3> places() const;
  void addStep(int stride, bool diagonal, std::span<const glm::ivec3> places, std::vector<double>& integrals);

  int intervals_;
  std::vector<double> solidAngles_;
  std::vector<std::vector<Odd>> steps_;  ///< fine to coarse
};

}  // namespace prelight
