#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

/// Functions that depend only on the angle to an axis. Their *zonal coefficients* z_l = integral f Y_l0, one
/// per band, are those of the function whose axis is z.

namespace prelight::sh {

/// Returns the zonal coefficients of max(cos,0)/pi by band, as a factor: the transfer of an unoccluded
/// receiver with normal n is T_lm = clampedCosine(l) Y_lm(n). (Ramamoorthi and Hanrahan 2001: A_l / pi.)
double clampedCosine(int band);

/// Writes the transfer of an unoccluded receiver: T_i = clampedCosine(l) Y_i(normal).
void openTransfer(const glm::dvec3& normal, int order, std::span<double> values);

/// Returns the sum over bands of factors[l] P_l(cosine), with Legendre polynomials P_l.
double legendreSum(std::span<const double> factors, double cosine);

/// Returns the value of the transfer of an unoccluded receiver in a direction at an angle of this cosine to
/// the normal: max(cos, 0) / pi, cut to the bands.
double openTowards(double cosine, int order);

/// Writes z_l of the function that is 1 within the angle `halfAngle` (0 to pi, radians) of the axis and 0
/// elsewhere; zonal.size() bands. No digits are lost for very small and very large caps. Throws UsageError
/// for an angle outside this range.
void capZonal(double halfAngle, std::span<double> zonal);

/// Writes z_l of the lobe (exponent + 1) / (2 pi) max(cos, 0)^exponent, whose integral is 1; zonal.size()
/// bands, exponent >= 0. Throws UsageError for a negative exponent.
void cosinePowerZonal(double exponent, std::span<double> zonal);

/// Writes the zonal function rotated to a unit axis, zonal.size()^2 coefficients: z_l sqrt(4 pi / (2l+1))
/// Y_lm(axis).
void turnZonal(std::span<const double> zonal, const glm::dvec3& axis, std::span<double> values);

/// Convolves with a zonal kernel (Funk and Hecke): f_lm z_l sqrt(4 pi / (2l+1)). `coefficients` holds one or
/// several functions of zonal.size()^2 entries and is changed in place.
void convolve(std::span<double> coefficients, std::span<const double> zonal);

/// Converts radiance (W/(m2 sr)) to irradiance (W/m2) as a function of the normal, in place: band l times pi
/// clampedCosine(l). `coefficients` holds one or several functions of order^2 entries.
void irradianceFromRadiance(std::span<double> coefficients, int order);

// Windows: factors per band that trade sharpness for less ringing. They should be applied to lights, not to
// transfer.

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
/// everywhere (to 1e-9 of its mean); `precision`: how much larger it may be, relative. Throws UsageError for
/// a bad order, for values that are not finite, and for a function whose mean is negative, or 0 without the
/// function being 0 everywhere.
MinimalWindow minimalWindow(std::span<const double> coefficients, int order, double precision = 1e-7);

/// Returns the least value of a function over the sphere, by a grid search and descent from its lowest
/// points.
double minimum(std::span<const double> coefficients, int order);

}  // namespace prelight::sh
