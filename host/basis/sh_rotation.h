#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "basis/sh_evaluate.h"

namespace prelight::sh {

/// Returns the coefficients of the rotated function f'(w) = f(R^-1 w), for one channel of order^2 entries.
/// Exact up to rounding: a product quadrature integrates every product of two functions of that order
/// exactly. Slow: the reference of ShRotation.
std::vector<double> rotate(std::span<const double> coefficients, int order, const glm::dmat3& rotation);

/// A rotation that can be applied to many functions: f'(w) = f(R^-1 w). It consists of three turns about z
/// and two fixed sparse reflections, each exact and orthogonal up to rounding at every order, so that errors
/// do not grow in sequences of rotations. Also accepts a matrix that mirrors (determinant -1).
class ShRotation {
 public:
  /// Throws UsageError for a bad order and for a matrix that is not orthonormal to 1e-5.
  ShRotation(int order, const glm::dmat3& rotation);

  int order() const { return order_; }

  /// Rotates one or several consecutive functions of order^2 entries. `in` and `out` have the same size and
  /// may be the same. The float variant computes in double precision and rounds once.
  void apply(std::span<const double> in, std::span<double> out) const;
  void apply(std::span<const float> in, std::span<float> out) const;

  /// Returns the matrix of a band, (2l+1)^2 entries [row][column]: f'_lm = sum D[l+m][l+k] f_lk.
  std::vector<double> bandMatrix(int band) const;

 private:
  /// cos(m a) and sin(m a) for all m.
  struct Turn {
    std::array<double, maxOrder> cosine{};
    std::array<double, maxOrder> sine{};
    Turn() = default;
    Turn(double c, double s, int order);
    void apply(int band, std::span<double> values) const;
  };

  void applyBand(int band, std::span<double> values) const;

  int order_ = 0;
  bool mirrors_ = false;
  Turn first_;
  Turn middle_;
  Turn last_;
};

/// Throws UsageError for a matrix that is not orthonormal to 1e-5.
void checkRotation(const glm::dmat3& rotation);

/// Rotates one or several functions of order^2 entries in place. Throws as the rotation's constructor does.
void turn(std::span<double> coefficients, int order, const glm::dmat3& rotation);

/// Returns the matrices of all bands below `order`, one after the other.
std::vector<double> bandMatrices(int order, const glm::dmat3& rotation);

}  // namespace prelight::sh
