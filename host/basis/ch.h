#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "basis/sh_evaluate.h"
#include "basis/sh_rotation.h"

/// Sherif's "cpherical harmonics": C_lm = K_lm (1 - z^2)^(m/2) T_l^(m)(z) {1, cos(m phi), sin(m phi)}, where
/// T_l^(m) is the m-th derivative of the Chebyshev polynomial and K_lm > 0 makes the norm over the sphere 1.
/// Axes, signs and index l(l+1)+m are those of prelight::sh.
///
/// They are not orthogonal: functions of the same m whose bands differ by an even number overlap. Two kinds
/// of numbers therefore describe a function f, and they are not the same:
///   coefficients a, so that f = sum a_i C_i (the projection onto the dual basis);
///   moments p_i = <f, C_i> (what a naive projection calls coefficients).
/// The integral of a product is sum a_i p_i, coefficients of either function with moments of the other. The
/// first n bands of CH and of SH span the same functions.
namespace prelight::ch {

constexpr int maxOrder = sh::maxOrder;

/// Returns K_lm for 0 <= |m| <= l < maxOrder, with respect to T_l^(m) without normalisation (so that it falls
/// like 1 / (2^m m!)), and including the norm of cos(m phi). Exact up to rounding. Throws UsageError outside
/// this range.
double constant(int l, int m);

/// A step of the recurrence. C_lm = P_lm(z) times the real or, for m < 0, the imaginary part of (x + iy)^|m|,
/// and P_lm = up z P_(l-1)m - down P_(l-2)m from P_mm on.
struct Step {
  double up = 0.0;
  double down = 0.0;
};

/// Return the step to l, 0 <= m < l < maxOrder, and P_mm. Throw UsageError outside this range.
Step step(int l, int m);
double sectoral(int m);

/// Writes the values of all n^2 functions in a unit direction, by a recurrence in l. `values` has order^2
/// entries. Throws UsageError for a bad order.
void evaluate(const glm::dvec3& direction, int order, std::span<double> values);

/// Exact maps between SH and CH of one order. C = B Y with B lower triangular per m and parity of l: every
/// map is one or two sparse triangular products or substitutions, with condition number below 0.9 sqrt(order)
/// + 1.
class Basis {
 public:
  /// Throws UsageError for a bad order.
  explicit Basis(int order);

  int order() const { return order_; }

  /// Converts SH coefficients y to CH coefficients a with sum a_i C_i = sum y_i Y_i. Input and output have
  /// order^2 entries each and may be the same.
  void fromSh(std::span<const double> sh, std::span<double> ch) const;
  void fromSh(std::span<const float> sh, std::span<float> ch) const;

  /// Converts CH coefficients to SH coefficients of sum a_i C_i: the inverse of fromSh.
  void toSh(std::span<const double> ch, std::span<double> sh) const;
  void toSh(std::span<const float> ch, std::span<float> sh) const;

  /// Computes the moments <f, C_i> of a function given by its SH coefficients. With transfer stored as CH
  /// coefficients a, the radiance is sum a_i p_i with the moments p of the light. Summing p_i C_i is the
  /// naive reconstruction.
  void momentsFromSh(std::span<const double> sh, std::span<double> moments) const;
  void momentsFromSh(std::span<const float> sh, std::span<float> moments) const;

  /// Computes the SH coefficients of the projection with the given moments: the inverse of momentsFromSh.
  void shFromMoments(std::span<const double> moments, std::span<double> sh) const;

  /// Convert between moments and coefficients, by the Gram matrix and its inverse.
  void dualFromMoments(std::span<const double> moments, std::span<double> ch) const;
  void momentsFromDual(std::span<const double> ch, std::span<double> moments) const;

  /// Computes the coefficients of the rotated function, through SH and back: CH's own matrices are not
  /// orthogonal and mix bands. Throws UsageError when the rotation is of another order.
  void rotate(const sh::ShRotation& rotation, std::span<const double> ch, std::span<double> rotated) const;

  /// Returns B_ij = <C_i, Y_j>, which is 0 unless i and j share m and the parity of l, and l_j <= l_i.
  /// Indices are below order^2.
  double shCoefficient(int i, int j) const;

  /// Returns <C_i, C_j>.
  double gram(int i, int j) const;

 private:
  double b(int m, int l, int k) const { return b_[(m * order_ + l) * order_ + k]; }

  int order_ = 0;
  std::vector<double> b_;  ///< [m][l of C][l of Y], m >= 0
};

}  // namespace prelight::ch
