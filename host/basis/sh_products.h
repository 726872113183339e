#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "basis/sh_evaluate.h"
#include "prelight/basis.h"

namespace prelight::sh {

/// Returns all nonzero Gamma_ijk with i and j < order^2, i <= j, and k < kOrder^2, sorted by i, then j, then
/// k. Exact up to rounding. Gamma is symmetric in i and j. Throws UsageError for a bad order.
std::vector<TripleProduct> tripleProducts(int order, int kOrder);

/// Products with functions of `fOrder` bands, as linear maps of functions of `order` bands. Holds the sparse
/// Gamma (about 0.4 order^5 entries of 12 bytes): make one and convert many f. Bands of f above 2 order - 2
/// have no effect.
class ShProduct {
 public:
  /// Throws UsageError for a bad order.
  ShProduct(int order, int fOrder);

  int order() const { return order_; }
  int fOrder() const { return fOrder_; }
  std::size_t entries() const { return values_.size(); }

  /// Writes out[i][j] = sum_k Gamma_ijk f_k, symmetric: the matrix of multiplying by f and truncating to
  /// `order` bands. f has fOrder^2 entries, out order^4.
  void matrix(std::span<const double> f, std::span<double> out) const;

  /// Writes the first `order` bands of f g, for g of `order` bands. out must not overlap g.
  void multiply(std::span<const double> f, std::span<const double> g, std::span<double> out) const;

 private:
  struct Pair {
    std::uint32_t i = 0;
    std::uint32_t j = 0;
    std::size_t end = 0;  ///< end of its terms, which begin at the end of the previous pair's
  };

  double sum(std::size_t begin, const Pair& pair, std::span<const double> f) const;

  int order_ = 0;
  int fOrder_ = 0;
  std::vector<Pair> pairs_;
  std::vector<std::uint32_t> k_;  ///< [term] k
  std::vector<double> values_;    ///< [term] Gamma
};

/// Returns ShProduct::matrix for one f of fOrder^2 entries: order^4 entries [i][j]. Throws UsageError for a
/// bad order and for coefficients that are too few or not finite.
std::vector<double> productMatrix(std::span<const double> f, int fOrder, int order);

/// Returns the first `order` bands of the product of two functions of fOrder and gOrder bands, by an exact
/// quadrature (the full product has fOrder + gOrder - 1 bands). Throws UsageError for a bad order and for
/// coefficients that are too few or not finite.
std::vector<double> product(std::span<const double> f, int fOrder, std::span<const double> g, int gOrder,
                            int order);

}  // namespace prelight::sh
