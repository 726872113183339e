#include "basis/sh_products.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "basis/quadrature.h"

// Y_lm = P_l|m|(z) w_m(phi), where w_m is cos(m phi) for m >= 0 and sin(|m| phi) for m < 0. Integrals of
// three such functions split into one over phi, which has a closed form, and one over z, which is that of a
// polynomial: its degree is l1 + l2 + l3, since the phi integral is zero unless |m1| + |m2| + |m3| is even.

namespace prelight::sh {
namespace {

/// Returns the integral of w_a w_b w_c over a full turn.
double azimuthIntegral(int a, int b, int c) {
  const int sines = (a < 0) + (b < 0) + (c < 0);
  if (sines % 2 == 1) return 0.0;
  std::array<int, 3> m = {a, b, c};
  std::sort(m.begin(), m.end(), [](int p, int q) { return std::abs(p) < std::abs(q); });
  if (std::abs(m[0]) + std::abs(m[1]) != std::abs(m[2])) return 0.0;
  if (m[2] == 0) return 2.0 * std::numbers::pi;
  if (m[0] == 0) return std::numbers::pi;
  // cos p cos q cos(p+q) -> pi/2; sin p sin q cos(p+q) -> -pi/2; sin p cos q sin(p+q) -> pi/2.
  return m[0] < 0 && m[1] < 0 ? -0.5 * std::numbers::pi : 0.5 * std::numbers::pi;
}

/// P_lm at the nodes of a Gauss-Legendre rule, [l(l+1)+m][node], and the weights of the nodes.
struct Profiles {
  std::vector<double> weight;
  std::vector<double> values;
  std::size_t nodes = 0;

  Profiles(int order, int degree) {
    const auto rule = gaussLegendre(degree / 2 + 1);
    nodes = rule.size();
    const int count = coefficientCount(order);
    values.resize(count * nodes);
    std::vector<double> basis(count);
    for (std::size_t n = 0; n < nodes; ++n) {
      const double z = rule[n].position;
      weight.push_back(rule[n].weight);
      evaluate({std::sqrt((1.0 - z) * (1.0 + z)), 0.0, z}, order, basis);
      for (int i = 0; i < count; ++i) values[i * nodes + n] = basis[i];
    }
  }

  const double* of(int l, int m) const { return values.data() + (l * (l + 1) + std::abs(m)) * nodes; }
};

struct Band {
  int l = 0;
  int m = 0;
};

/// Adds Gamma_ijk for one pair and one m of k, over the bands of k that the triangle rule permits.
void addTerms(const Profiles& profiles, Band a, Band b, int m, int kOrder, std::vector<TripleProduct>& out) {
  const double azimuth = azimuthIntegral(a.m, b.m, m);
  if (azimuth == 0.0) return;
  std::vector<double> product(profiles.nodes);
  const double* pa = profiles.of(a.l, a.m);
  const double* pb = profiles.of(b.l, b.m);
  for (std::size_t n = 0; n < profiles.nodes; ++n) product[n] = azimuth * profiles.weight[n] * pa[n] * pb[n];
  int first = std::max(std::abs(a.l - b.l), std::abs(m));
  first += (a.l + b.l + first) % 2;  // odd sums of bands give odd functions
  for (int l = first; l <= std::min(a.l + b.l, kOrder - 1); l += 2) {
    const double* pk = profiles.of(l, m);
    double sum = 0.0;
    for (std::size_t n = 0; n < profiles.nodes; ++n) sum += product[n] * pk[n];
    // An accidental zero leaves a rounding error far below the smallest value for these orders.
    if (std::abs(sum) < 1e-14) continue;
    out.push_back({static_cast<std::uint32_t>(a.l * (a.l + 1) + a.m),
                   static_cast<std::uint32_t>(b.l * (b.l + 1) + b.m),
                   static_cast<std::uint32_t>(l * (l + 1) + m), sum});
  }
}

/// Returns the m that w_a w_b may contain: +-(|a| + |b|) and +-(|a| - |b|), each once, a sine when exactly
/// one of the two is.
std::vector<int> productWaves(int a, int b) {
  const int sign = (a < 0) != (b < 0) ? -1 : 1;
  const int sum = std::abs(a) + std::abs(b);
  const int difference = std::abs(std::abs(a) - std::abs(b));
  std::vector<int> waves = {sign * sum};
  if (difference != sum && (sign > 0 || difference > 0)) waves.push_back(sign * difference);
  return waves;
}

std::vector<Band> bandsOf(int order) {
  std::vector<Band> bands;
  for (int l = 0; l < order; ++l) {
    for (int m = -l; m <= l; ++m) bands.push_back({l, m});
  }
  return bands;
}

}  // namespace

std::vector<TripleProduct> tripleProducts(int order, int kOrder) {
  checkOrder(order, "triple product");
  checkOrder(kOrder, "triple product");
  const Profiles profiles(std::max(order, kOrder), 2 * (order - 1) + std::min(kOrder - 1, 2 * (order - 1)));
  const std::vector<Band> bands = bandsOf(order);
  std::vector<TripleProduct> out;
  for (std::size_t i = 0; i < bands.size(); ++i) {
    for (std::size_t j = i; j < bands.size(); ++j) {
      const auto begin = static_cast<std::ptrdiff_t>(out.size());
      for (const int m : productWaves(bands[i].m, bands[j].m)) {
        addTerms(profiles, bands[i], bands[j], m, kOrder, out);
      }
      std::sort(out.begin() + begin, out.end(), [](const auto& a, const auto& b) { return a.k < b.k; });
    }
  }
  return out;
}

ShProduct::ShProduct(int order, int fOrder) : order_(order), fOrder_(fOrder) {
  for (const TripleProduct& t : tripleProducts(order, fOrder)) {
    if (pairs_.empty() || pairs_.back().i != t.i || pairs_.back().j != t.j) pairs_.push_back({t.i, t.j, 0});
    k_.push_back(t.k);
    values_.push_back(t.value);
    pairs_.back().end = values_.size();
  }
}

double ShProduct::sum(std::size_t begin, const Pair& pair, std::span<const double> f) const {
  double sum = 0.0;
  for (std::size_t t = begin; t < pair.end; ++t) sum += values_[t] * f[k_[t]];
  return sum;
}

void ShProduct::matrix(std::span<const double> f, std::span<double> out) const {
  const std::size_t count = coefficientCount(order_);
  assert(f.size() == static_cast<std::size_t>(coefficientCount(fOrder_)) && out.size() == count * count);
  std::fill(out.begin(), out.end(), 0.0);
  std::size_t begin = 0;
  for (const Pair& pair : pairs_) {
    const double value = sum(begin, pair, f);
    out[pair.i * count + pair.j] = value;
    out[pair.j * count + pair.i] = value;
    begin = pair.end;
  }
}

void ShProduct::multiply(std::span<const double> f, std::span<const double> g, std::span<double> out) const {
  assert(f.size() == static_cast<std::size_t>(coefficientCount(fOrder_)) && g.size() == out.size() &&
         out.size() == static_cast<std::size_t>(coefficientCount(order_)));
  std::fill(out.begin(), out.end(), 0.0);
  std::size_t begin = 0;
  for (const Pair& pair : pairs_) {
    const double value = sum(begin, pair, f);
    out[pair.i] += value * g[pair.j];
    if (pair.i != pair.j) out[pair.j] += value * g[pair.i];
    begin = pair.end;
  }
}

std::vector<double> productMatrix(std::span<const double> f, int fOrder, int order) {
  const ShProduct product(order, fOrder);
  checkCoefficients(f, coefficientCount(fOrder), "product matrix");
  const std::size_t count = coefficientCount(order);
  std::vector<double> out(count * count);
  product.matrix(f, out);
  return out;
}

std::vector<double> product(std::span<const double> f, int fOrder, std::span<const double> g, int gOrder,
                            int order) {
  for (const int n : {fOrder, gOrder, order}) checkOrder(n, "product");
  checkCoefficients(f, coefficientCount(fOrder), "product");
  checkCoefficients(g, coefficientCount(gOrder), "product");
  std::vector<double> values(coefficientCount(order));
  std::vector<double> out(values.size(), 0.0);
  for (const SphereSample& s : sphereQuadrature(fOrder + gOrder + order - 3)) {
    const double both = s.weight * reconstruct(f, fOrder, s.direction) * reconstruct(g, gOrder, s.direction);
    evaluate(s.direction, order, values);
    for (std::size_t i = 0; i < values.size(); ++i) out[i] += both * values[i];
  }
  return out;
}

}  // namespace prelight::sh
