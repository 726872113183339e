#include "basis/sh_rotation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <string>

#include "basis/quadrature.h"
#include "prelight/error.h"

// R = Rz(a) Ry(b) Rz(c), and Ry(b) = S Rz(-b) S where S swaps y and z [1]. Turning about z mixes m with -m
// alone; S is its own inverse, symmetric, and three quarters of its entries are zero by parity in x, y and z.
// [1] Pinchon and Hoggan, "Rotation matrices for real spherical harmonics", J. Phys. A 40 (2007).

namespace prelight::sh {
namespace {

/// The reflection S of one band: the non-zero entries of every row.
struct Swap {
  struct Entry {
    std::uint8_t column = 0;
    double value = 0.0;
  };
  std::vector<std::vector<Entry>> rows;

  void apply(std::span<const double> in, std::span<double> out) const {
    for (std::size_t r = 0; r < rows.size(); ++r) {
      double sum = 0.0;
      for (const Entry& e : rows[r]) sum += e.value * in[e.column];
      out[r] = sum;
    }
  }
};

bool oddInX(int m) { return m >= 0 ? m % 2 == 1 : m % 2 == 0; }
bool oddInY(int m) { return m < 0; }
bool oddInZ(int l, int m) { return (l + m) % 2 != 0; }

/// Returns S_mk = integral Y_lm(x, y, z) Y_lk(x, z, y), by an exact quadrature.
Swap makeSwap(int l) {
  const int width = 2 * l + 1;
  const int count = coefficientCount(l + 1);
  std::vector<double> sums(static_cast<std::size_t>(width) * width, 0.0);
  std::vector<double> values(count);
  std::vector<double> swapped(count);
  const auto vanishes = [l](int m, int k) {
    return oddInX(m) != oddInX(k) || oddInY(m) != oddInZ(l, k) || oddInZ(l, m) != oddInY(k);
  };
  for (const SphereSample& s : sphereQuadrature(2 * l)) {
    evaluate(s.direction, l + 1, values);
    evaluate({s.direction.x, s.direction.z, s.direction.y}, l + 1, swapped);
    for (int m = -l; m <= l; ++m) {
      for (int k = -l; k <= m; ++k) {
        if (vanishes(m, k)) continue;
        sums[(l + m) * width + l + k] += s.weight * values[l * (l + 1) + m] * swapped[l * (l + 1) + k];
      }
    }
  }
  Swap swap;
  swap.rows.resize(width);
  for (int m = -l; m <= l; ++m) {
    for (int k = -l; k <= l; ++k) {
      if (vanishes(m, k)) continue;
      swap.rows[l + m].push_back(
          {static_cast<std::uint8_t>(l + k), sums[(l + std::max(m, k)) * width + l + std::min(m, k)]});
    }
  }
  return swap;
}

/// Returns the reflection of a band, a mathematical constant that is computed on first use.
const Swap& swapOfBand(int band) {
  static std::array<Swap, maxOrder> swaps;
  static std::array<std::once_flag, maxOrder> made;
  std::call_once(made[band], [band] { swaps[band] = makeSwap(band); });
  return swaps[band];
}

void checkOrthonormal(const glm::dmat3& matrix) {
  const glm::dmat3 square = glm::transpose(matrix) * matrix;
  double sum = 0.0;  // NaN propagates
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) sum += std::abs(square[c][r] - (c == r ? 1.0 : 0.0));
  }
  if (sum <= 1e-5) return;
  throw UsageError("rotation",
                   "expected an orthonormal matrix, got one that is off by " + std::to_string(sum),
                   "leave scale and shear out");
}

}  // namespace

std::vector<double> rotate(std::span<const double> coefficients, int order, const glm::dmat3& rotation) {
  assert(coefficients.size() == static_cast<std::size_t>(coefficientCount(order)));
  const int count = coefficientCount(order);
  const glm::dmat3 inverse = glm::transpose(rotation);
  std::vector<double> basis(count);
  std::vector<double> result(count, 0.0);
  for (const SphereSample& sample : sphereQuadrature(2 * order - 2)) {
    evaluate(inverse * sample.direction, order, basis);
    double value = 0.0;
    for (int i = 0; i < count; ++i) value += coefficients[i] * basis[i];
    evaluate(sample.direction, order, basis);
    for (int i = 0; i < count; ++i) result[i] += sample.weight * value * basis[i];
  }
  return result;
}

ShRotation::Turn::Turn(double c, double s, int order) {
  const double length = std::hypot(c, s);
  cosine[0] = 1.0;
  for (int m = 1; m < order; ++m) {
    cosine[m] = (cosine[m - 1] * c - sine[m - 1] * s) / length;
    sine[m] = (sine[m - 1] * c + cosine[m - 1] * s) / length;
  }
}

void ShRotation::Turn::apply(int band, std::span<double> values) const {
  for (int m = 1; m <= band; ++m) {
    const double even = values[band + m];
    const double odd = values[band - m];
    values[band + m] = cosine[m] * even - sine[m] * odd;
    values[band - m] = sine[m] * even + cosine[m] * odd;
  }
}

ShRotation::ShRotation(int order, const glm::dmat3& rotation) : order_(order) {
  checkOrder(order, "rotation");
  checkOrthonormal(rotation);
  mirrors_ = glm::determinant(rotation) < 0.0;
  const glm::dmat3 r = mirrors_ ? -rotation : rotation;  // a mirror is a rotation after w -> -w
  // R z = (cos a sin b, sin a sin b, cos b). Where sin b vanishes, any a is suitable: the rest of the
  // rotation is taken from Rz(-a) R, whose second row is (sin c, cos c, 0), a unit vector in any case.
  const double sinB = std::hypot(r[2].x, r[2].y);
  const double cosA = sinB > 0.0 ? r[2].x / sinB : 1.0;
  const double sinA = sinB > 0.0 ? r[2].y / sinB : 0.0;
  const double sinC = cosA * r[0].y - sinA * r[0].x;
  const double cosC = cosA * r[1].y - sinA * r[1].x;
  first_ = Turn(cosC, sinC, order);
  middle_ = Turn(r[2].z, -sinB, order);
  last_ = Turn(cosA, sinA, order);
  for (int l = 0; l < order; ++l) swapOfBand(l);
}

void ShRotation::applyBand(int band, std::span<double> values) const {
  const Swap& swap = swapOfBand(band);
  std::array<double, 2 * maxOrder> buffer;
  first_.apply(band, values);
  swap.apply(values, buffer);
  middle_.apply(band, buffer);
  swap.apply(buffer, values);
  last_.apply(band, values);
  if (mirrors_ && band % 2 == 1) {
    for (double& v : values) v = -v;
  }
}

void ShRotation::apply(std::span<const double> in, std::span<double> out) const {
  const std::size_t count = coefficientCount(order_);
  assert(in.size() == out.size() && in.size() % count == 0);
  std::copy(in.begin(), in.end(), out.begin());
  for (std::size_t function = 0; function < out.size(); function += count) {
    for (std::size_t l = 0; l < static_cast<std::size_t>(order_); ++l) {
      applyBand(static_cast<int>(l), out.subspan(function + l * l, 2 * l + 1));
    }
  }
}

void ShRotation::apply(std::span<const float> in, std::span<float> out) const {
  const std::size_t count = coefficientCount(order_);
  assert(in.size() == out.size() && in.size() % count == 0);
  std::array<double, 2 * maxOrder> values;
  for (std::size_t function = 0; function < out.size(); function += count) {
    for (std::size_t l = 0; l < static_cast<std::size_t>(order_); ++l) {
      const std::size_t begin = function + l * l;
      const std::size_t width = 2 * l + 1;
      std::copy_n(in.begin() + begin, width, values.begin());
      applyBand(static_cast<int>(l), std::span(values).first(width));
      for (std::size_t i = 0; i < width; ++i) out[begin + i] = static_cast<float>(values[i]);
    }
  }
}

std::vector<double> ShRotation::bandMatrix(int band) const {
  assert(band >= 0 && band < order_);
  const int width = 2 * band + 1;
  std::vector<double> matrix(static_cast<std::size_t>(width) * width);
  std::vector<double> column(width);
  for (int k = 0; k < width; ++k) {
    std::fill(column.begin(), column.end(), 0.0);
    column[k] = 1.0;
    applyBand(band, column);
    for (int m = 0; m < width; ++m) matrix[m * width + k] = column[m];
  }
  return matrix;
}

void checkRotation(const glm::dmat3& rotation) { (void)ShRotation(1, rotation); }

void turn(std::span<double> coefficients, int order, const glm::dmat3& rotation) {
  ShRotation(order, rotation).apply(coefficients, coefficients);
}

std::vector<double> bandMatrices(int order, const glm::dmat3& rotation) {
  const ShRotation turned(order, rotation);
  std::vector<double> matrices;
  for (int band = 0; band < order; ++band) {
    const std::vector<double> matrix = turned.bandMatrix(band);
    matrices.insert(matrices.end(), matrix.begin(), matrix.end());
  }
  return matrices;
}

}  // namespace prelight::sh
