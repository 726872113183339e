#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "basis/sh_products.h"
#include "basis/sh_zonal.h"
#include "library/unit_direction.h"
#include "prelight/basis.h"
#include "prelight/error.h"

namespace prelight {

namespace {

/// Returns room for a coefficient per band.
std::vector<double> bandsOf(int order, const char* where) {
  sh::checkOrder(order, where);
  return std::vector<double>(static_cast<std::size_t>(order));
}

/// Throws UsageError unless a zonal function has 1 to 32 finite bands; returns their number.
int orderOf(std::span<const double> zonal, const char* where) {
  const int order = static_cast<int>(std::min<std::size_t>(zonal.size(), sh::maxOrder + 1));
  sh::checkOrder(order, where);
  sh::checkCoefficients(zonal, zonal.size(), where);
  return order;
}

}  // namespace

std::vector<double> multiplySh(std::span<const double> f, int fOrder, std::span<const double> g, int gOrder,
                               int order) {
  return sh::product(f, fOrder, g, gOrder, order);
}

std::vector<double> productMatrix(std::span<const double> f, int fOrder, int order) {
  return sh::productMatrix(f, fOrder, order);
}

std::vector<TripleProduct> tripleProducts(int order, int kOrder) { return sh::tripleProducts(order, kOrder); }

std::vector<double> zonalClampedCosine(int order) {
  std::vector<double> zonal = bandsOf(order, "zonalClampedCosine");
  for (int l = 0; l < order; ++l)
    zonal[static_cast<std::size_t>(l)] =
        sh::clampedCosine(l) * std::sqrt((2.0 * l + 1.0) / (4.0 * std::numbers::pi));
  return zonal;
}

std::vector<double> zonalCap(double halfAngle, int order) {
  std::vector<double> zonal = bandsOf(order, "zonalCap");
  sh::capZonal(halfAngle, zonal);
  return zonal;
}

std::vector<double> zonalCosinePower(double exponent, int order) {
  std::vector<double> zonal = bandsOf(order, "zonalCosinePower");
  sh::cosinePowerZonal(exponent, zonal);
  return zonal;
}

std::vector<double> rotateZonal(std::span<const double> zonal, const glm::dvec3& axis) {
  const int order = orderOf(zonal, "rotateZonal");
  std::vector<double> values(static_cast<std::size_t>(sh::coefficientCount(order)));
  sh::turnZonal(zonal, unitDirection(axis, "rotateZonal", "axis"), values);
  return values;
}

std::vector<double> convolveSh(std::span<const double> coefficients, std::span<const double> zonal) {
  const auto terms = static_cast<std::size_t>(sh::coefficientCount(orderOf(zonal, "convolveSh")));
  if (coefficients.size() % terms != 0)
    throw UsageError("convolveSh",
                     fmt::format("got {} values, expected a multiple of {}", coefficients.size(), terms));
  sh::checkCoefficients(coefficients, coefficients.size(), "convolveSh");
  std::vector<double> convolved(coefficients.begin(), coefficients.end());
  sh::convolve(convolved, zonal);
  return convolved;
}

}  // namespace prelight
