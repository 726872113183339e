#pragma once

#include <span>
#include <vector>

/// Factors per band that trade sharpness for less ringing. They should be applied to lights, not to transfer.
namespace prelight::sh {

enum class WindowKind { None, Hanning, Lanczos };

/// Returns the factors of bands 0 to order - 1. Hanning: (1 + cos(pi l / order)) / 2. Lanczos: sin(x) / x, x
/// = pi l / order.
std::vector<double> window(WindowKind kind, int order);

/// Multiplies every band of one or several functions of factors.size()^2 coefficients by its factor.
void applyWindow(std::span<double> coefficients, std::span<const double> factors);

/// The weakest smoothing that leaves no negative values.
struct MinimalWindow {
  double lambda = 0.0;          ///< 0 when no value was negative
  std::vector<double> factors;  ///< [band] 1 / (1 + lambda l^2 (l + 1)^2)
};

/// Finds the least lambda for which every one of the functions (one or several of order^2 entries) is >= 0
/// everywhere (to 1e-9 of its mean). Throws UsageError for a bad order, for values that are not finite, and
/// for a function whose mean is negative, or 0 without the function being 0 everywhere.
MinimalWindow minimalWindow(std::span<const double> coefficients, int order);

/// Returns the least value of a function over the sphere, by a grid search and descent from its lowest
/// points.
double minimum(std::span<const double> coefficients, int order);

}  // namespace prelight::sh
