#include "basis/ch.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>

#include "basis/quadrature.h"
#include "prelight/error.h"

// [1] Sherif, section 6.5 and table A.1: the functions and a table of their constants, without a
//     closed form for m > 0. Here squaredNorm() is the closed form, and the projection is onto the dual
//     basis.
// [2] Abramowitz and Stegun 22.7.3 and 22.5.33: T_l^(m) is 2^(m-1) (m-1)! l times the Gegenbauer polynomial
//     C_(l-m)^(m), which gives, for m >= 1,
//     T_l^(m) = l / (l - m) (2 z T_(l-1)^(m) - (l + m - 2) / (l - 2) T_(l-2)^(m)).
// [3] Andrews, Askey and Roy, "Special functions", 1999, Theorem 7.1.4': a Gegenbauer polynomial C_n^(a) is
//     the sum of (n + b - 2 k) / b (a)_(n-k) (a - b)_k / (k! (b + 1)_(n-k)) C_(n-2k)^(b), k = 0 ... n/2.

namespace prelight::ch {
namespace {

using Row = std::array<double, maxOrder>;

/// Factors of z Q(l-1) and Q(l-2) in [2], with Q = T_l^(m) / T_m^(m).
double firstFactor(int l, int m) {
  if (m == 0) return l == 1 ? 1.0 : 2.0;
  return 2.0 * l / (l - m);
}

double secondFactor(int l, int m) {
  if (l < m + 2) return 0.0;
  if (m == 0) return 1.0;
  return static_cast<double>(l) * (l + m - 2) / ((l - m) * (l - 2.0));
}

/// Returns the integral of (1 - z^2)^m Q^2. For m > 0, Q is l/m times C_n^(m) of [2], n = l - m, which by [3]
/// with b = m + 1/2 is a sum of polynomials that are orthogonal under the weight. Terms and norms follow from
/// the previous ones.
double squaredNorm(int l, int m) {
  if (m == 0) return l == 0 ? 2.0 : (4.0 * l * l - 2.0) / (4.0 * l * l - 1.0);
  const int n = l - m;
  const double b = m + 0.5;
  Row norms{};  // squared norms of C_i^(b)
  norms[0] = 2.0;
  for (int j = 1; j <= m; ++j) norms[0] *= 2.0 * j / (2.0 * j + 1.0);
  for (int i = 1; i <= n; ++i) norms[i] = norms[i - 1] * (i + 2.0 * m) * (i - 1.0 + b) / (i * (i + b));
  double term = (n + b) / b;
  for (int i = 0; i < n; ++i) term *= (m + i) / (b + 1.0 + i);
  double sum = 0.0;
  for (int k = 0; 2 * k <= n; ++k) {
    sum += term * term * norms[n - 2 * k];
    if (2 * k + 2 <= n)
      term *= (n + b - 2.0 * k - 2.0) / (n + b - 2.0 * k) * (k - 0.5) / (k + 1.0) * (b + n - k) /
              (m + n - k - 1.0);
  }
  return sum * l * l / (static_cast<double>(m) * m);
}

/// The recurrence of the normalised functions divided by sin^m: P(l) = a(l,m) z P(l-1) - c(l,m) P(l-2).
struct ChRecurrence {
  std::array<Row, maxOrder> a{};
  std::array<Row, maxOrder> c{};
  std::array<Row, maxOrder> norm{};  ///< [l][m] norm of sin^m Q, including the wave in phi

  ChRecurrence() {
    for (int m = 0; m < maxOrder; ++m) fillColumn(m);
  }

  void fillColumn(int m) {
    for (int l = m; l < maxOrder; ++l) {
      norm[l][m] = 1.0 / std::sqrt((m == 0 ? 2.0 : 1.0) * std::numbers::pi * squaredNorm(l, m));
      if (l > m) a[l][m] = firstFactor(l, m) * norm[l][m] / norm[l - 1][m];
      if (l > m + 1) c[l][m] = secondFactor(l, m) * norm[l][m] / norm[l - 2][m];
    }
  }
};

const ChRecurrence& chRecurrence() {
  static const ChRecurrence table;
  return table;
}

/// Calls work(m, signed m) for every column of functions of one m.
template <typename Work>
void forEachColumn(int order, Work work) {
  for (int m = 0; m < order; ++m) {
    work(m, m);
    if (m > 0) work(m, -m);
  }
}

int at(int l, int m) { return l * (l + 1) + m; }

void checkIndex(const char* where, int l, int m) {
  if (l >= 0 && l < maxOrder && std::abs(m) <= l) return;
  throw UsageError(where, "expected 0 <= |m| <= l < " + std::to_string(maxOrder) +
                              ", got l = " + std::to_string(l) + ", m = " + std::to_string(m));
}

template <typename Map>
void throughDouble(std::span<const float> in, std::span<float> out, Map map) {
  std::vector<double> values(in.begin(), in.end());
  map(values, values);
  std::transform(values.begin(), values.end(), out.begin(), [](double v) { return static_cast<float>(v); });
}

}  // namespace

double constant(int l, int m) {
  checkIndex("CH constant", l, m);
  const int k = std::abs(m);
  double derivative = 1.0;  // T_m^(m) = 2^(m-1) m!
  for (int i = 1; i <= k; ++i) derivative *= i == 1 ? 1.0 : 2.0 * i;
  return chRecurrence().norm[l][k] / derivative;
}

Step step(int l, int m) {
  checkIndex("CH recurrence", l, m);
  return {chRecurrence().a[l][std::abs(m)], chRecurrence().c[l][std::abs(m)]};
}

double sectoral(int m) {
  checkIndex("CH recurrence", std::abs(m), m);
  return chRecurrence().norm[std::abs(m)][std::abs(m)];
}

void evaluate(const glm::dvec3& direction, int order, std::span<double> values) {
  sh::checkOrder(order, "CH");
  assert(values.size() >= static_cast<std::size_t>(order * order));
  const ChRecurrence& table = chRecurrence();
  double real = 1.0;  // real part of (x + iy)^m
  double imaginary = 0.0;
  for (int m = 0; m < order; ++m) {
    if (m > 0) {
      const double next = real * direction.x - imaginary * direction.y;
      imaginary = imaginary * direction.x + real * direction.y;
      real = next;
    }
    double before = 0.0;
    double p = table.norm[m][m];
    for (int l = m; l < order; ++l) {
      if (l > m) {
        const double next = table.a[l][m] * direction.z * p - table.c[l][m] * before;
        before = p;
        p = next;
      }
      values[at(l, m)] = p * real;
      if (m > 0) values[at(l, -m)] = p * imaginary;
    }
  }
}

Basis::Basis(int order) : order_(order) {
  sh::checkOrder(order, "CH");
  b_.assign(static_cast<std::size_t>(order) * order * order, 0.0);
  std::vector<double> c(sh::coefficientCount(order));
  std::vector<double> y(c.size());
  // At azimuth 0 the waves of m >= 0 are 1; over a turn their square integrates to 2 pi or pi.
  for (const LineSample& s : gaussLegendre(order)) {
    const glm::dvec3 w(std::sqrt((1.0 - s.position) * (1.0 + s.position)), 0.0, s.position);
    evaluate(w, order, c);
    sh::evaluate(w, order, y);
    for (int m = 0; m < order; ++m) {
      const double weight = s.weight * (m == 0 ? 2.0 : 1.0) * std::numbers::pi;
      for (int l = m; l < order; ++l) {
        for (int k = l; k >= m; k -= 2) b_[(m * order + l) * order + k] += weight * c[at(l, m)] * y[at(k, m)];
      }
    }
  }
}

void Basis::fromSh(std::span<const double> sh, std::span<double> ch) const {
  assert(sh.size() == static_cast<std::size_t>(order_ * order_) && ch.size() == sh.size());
  // y = B^T a, upper triangular: from the highest band down.
  forEachColumn(order_, [&](int m, int wave) {
    for (int l = order_ - 1; l >= m; --l) {
      double sum = sh[at(l, wave)];
      for (int k = l + 2; k < order_; k += 2) sum -= b(m, k, l) * ch[at(k, wave)];
      ch[at(l, wave)] = sum / b(m, l, l);
    }
  });
}

void Basis::toSh(std::span<const double> ch, std::span<double> sh) const {
  assert(sh.size() == static_cast<std::size_t>(order_ * order_) && ch.size() == sh.size());
  forEachColumn(order_, [&](int m, int wave) {
    for (int l = m; l < order_; ++l) {
      double sum = 0.0;
      for (int k = l; k < order_; k += 2) sum += b(m, k, l) * ch[at(k, wave)];
      sh[at(l, wave)] = sum;
    }
  });
}

void Basis::momentsFromSh(std::span<const double> sh, std::span<double> moments) const {
  assert(sh.size() == static_cast<std::size_t>(order_ * order_) && moments.size() == sh.size());
  forEachColumn(order_, [&](int m, int wave) {
    for (int l = order_ - 1; l >= m; --l) {
      double sum = 0.0;
      for (int k = l; k >= m; k -= 2) sum += b(m, l, k) * sh[at(k, wave)];
      moments[at(l, wave)] = sum;
    }
  });
}

void Basis::shFromMoments(std::span<const double> moments, std::span<double> sh) const {
  assert(sh.size() == static_cast<std::size_t>(order_ * order_) && moments.size() == sh.size());
  forEachColumn(order_, [&](int m, int wave) {
    for (int l = m; l < order_; ++l) {
      double sum = moments[at(l, wave)];
      for (int k = l - 2; k >= m; k -= 2) sum -= b(m, l, k) * sh[at(k, wave)];
      sh[at(l, wave)] = sum / b(m, l, l);
    }
  });
}

void Basis::dualFromMoments(std::span<const double> moments, std::span<double> ch) const {
  shFromMoments(moments, ch);
  fromSh(ch, ch);
}

void Basis::momentsFromDual(std::span<const double> ch, std::span<double> moments) const {
  toSh(ch, moments);
  momentsFromSh(moments, moments);
}

void Basis::fromSh(std::span<const float> sh, std::span<float> ch) const {
  throughDouble(sh, ch, [&](std::span<const double> in, std::span<double> out) { fromSh(in, out); });
}

void Basis::toSh(std::span<const float> ch, std::span<float> sh) const {
  throughDouble(ch, sh, [&](std::span<const double> in, std::span<double> out) { toSh(in, out); });
}

void Basis::momentsFromSh(std::span<const float> sh, std::span<float> moments) const {
  throughDouble(sh, moments,
                [&](std::span<const double> in, std::span<double> out) { momentsFromSh(in, out); });
}

void Basis::rotate(const sh::ShRotation& rotation, std::span<const double> ch,
                   std::span<double> rotated) const {
  if (rotation.order() != order_) {
    throw UsageError("CH rotation", "expected a rotation of order " + std::to_string(order_) + ", got " +
                                        std::to_string(rotation.order()));
  }
  toSh(ch, rotated);
  rotation.apply(rotated, rotated);
  fromSh(rotated, rotated);
}

double Basis::shCoefficient(int i, int j) const {
  assert(i >= 0 && i < order_ * order_ && j >= 0 && j < order_ * order_);
  const int l = static_cast<int>(std::sqrt(static_cast<double>(i)));
  const int k = static_cast<int>(std::sqrt(static_cast<double>(j)));
  const int m = i - l * (l + 1);
  if (m != j - k * (k + 1) || k > l || (l - k) % 2 == 1) return 0.0;
  return b(std::abs(m), l, k);
}

double Basis::gram(int i, int j) const {
  double sum = 0.0;
  for (int k = 0; k <= std::min(i, j); ++k) sum += shCoefficient(i, k) * shCoefficient(j, k);
  return sum;
}

}  // namespace prelight::ch
