#pragma once

#include <span>
#include <vector>

/// Factors a band that trade sharpness for less ringing. Apply them to lights; keep transfer as it is.
namespace prelight::sh {

enum class WindowKind { None, Hanning, Lanczos };

/// Factors of bands 0 to order - 1. Hanning: (1 + cos(pi l / order)) / 2. Lanczos: sin(x) / x, x = pi l /
/// order.
std::vector<double> window(WindowKind kind, int order);

/// Multiplies every band of one or several functions of factors.size()^2 coefficients.
void applyWindow(std::span<double> coefficients, std::span<const double> factors);

/// The weakest smoothing that leaves nothing negative.
struct MinimalWindow {
  double lambda = 0.0;          ///< 0 when nothing was negative
  std::vector<double> factors;  ///< of a band: 1 / (1 + lambda l^2 (l + 1)^2)
};

/// Finds the least lambda for which every one of the functions (one or several of order^2 entries) is >= 0
/// everywhere (to 1e-9 of its mean). Throws UsageError for a bad order, values that are not finite, and a
/// function whose mean is negative or that is 0 in the mean but not everywhere.
MinimalWindow minimalWindow(std::span<const double> coefficients, int order);

/// The least value of a function over the sphere, by a search on a grid and descent from its lowest points.
double minimum(std::span<const double> coefficients, int order);

}  // namespace prelight::sh
