#include "viewer/techniques/glossy/specular_lobes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "basis/quadrature.h"
#include "basis/sh_zonal.h"

namespace prelight::viewer {
namespace {

using std::numbers::pi;
constexpr int quadratureNodes = 128;

/// Squared width of GGX as shaders/scattering.glsl has it.
double squaredWidth(double roughness) {
  const double alpha = std::max(roughness * roughness, 0.002);
  return alpha * alpha;
}

/// Adds what directions with u in [from, to] contribute to z_l = integral f Y_l0, f = D Vis the BRDF without
/// Fresnel factor, seen along the normal. u is the distribution function of half vectors, D cos (Walter et
/// al. 2007, Eq. 35); it makes f dw = 4 Vis du, smooth however sharp the lobe is.
void addGgx(double a2, double from, double to, std::vector<double>& zonal) {
  for (const LineSample& node : gaussLegendre(quadratureNodes)) {
    const double u = from + 0.5 * (to - from) * (node.position + 1.0);
    const double half2 = (1.0 - u) / (1.0 - u + a2 * u);  // squared cosine of the half angle
    const double cosine = 2.0 * half2 - 1.0;
    const double above = std::max(cosine, 0.0);
    // Height-correlated Smith (Heitz 2014) with the view along the normal.
    const double visibility = 0.5 / (above + std::sqrt(above * above * (1.0 - a2) + a2));
    const double weight = 0.5 * (to - from) * node.weight * 4.0 * visibility;
    for (std::size_t l = 0; l < zonal.size(); ++l) {
      const auto band = static_cast<unsigned>(l);
      zonal[l] += weight * std::sqrt((2.0 * band + 1.0) / (4.0 * pi)) * std::legendre(band, cosine);
    }
  }
}

/// Beyond 90 degrees, where seen along the normal there is nothing but below it in slanted views, the lobe
/// goes on with the masking of the horizon.
void ggxZonal(double roughness, std::vector<double>& zonal) {
  const double a2 = squaredWidth(roughness);
  std::fill(zonal.begin(), zonal.end(), 0.0);
  const double horizon = 1.0 / (1.0 + a2);  // u of a half angle of 45 degrees
  addGgx(a2, 0.0, horizon, zonal);
  addGgx(a2, horizon, 1.0, zonal);
}

void phongZonal(double roughness, std::vector<double>& zonal) {
  const double exponent = phongExponent(roughness);
  sh::cosinePowerZonal(exponent, zonal);
  for (double& z : zonal) z *= (exponent + 2.0) / (exponent + 1.0);
}

/// Funk and Hecke: what a zonal function does to a band.
double bandFactor(const std::vector<double>& zonal, int band) {
  return std::sqrt(4.0 * pi / (2.0 * band + 1.0)) * zonal[static_cast<std::size_t>(band)];
}

/// Least value of a zonal function over its largest, on a grid that every band is smooth on.
double leastOverLargest(const std::vector<double>& zonal) {
  constexpr int steps = 512;
  double least = 0.0;
  double largest = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double cosine = std::cos(pi * i / steps);
    double value = 0.0;
    for (std::size_t l = 0; l < zonal.size(); ++l) {
      const auto band = static_cast<unsigned>(l);
      value += zonal[l] * std::sqrt((2.0 * band + 1.0) / (4.0 * pi)) * std::legendre(band, cosine);
    }
    least = std::min(least, value);
    largest = std::max(largest, value);
  }
  return least / largest;
}

std::vector<double> smoothed(const std::vector<double>& zonal, double lambda) {
  std::vector<double> result = zonal;
  for (std::size_t l = 0; l < result.size(); ++l) {
    const double bend = static_cast<double>(l * (l + 1));
    result[l] /= 1.0 + lambda * bend * bend;  // Sloan 2017, as sh::minimalWindow
  }
  return result;
}

/// The weakest smoothing that leaves nothing below -1/1000 of the peak.
void smooth(std::vector<double>& zonal) {
  constexpr double tolerated = -1e-3;
  if (leastOverLargest(zonal) >= tolerated) return;
  double weak = 0.0;
  double strong = 1.0;
  while (leastOverLargest(smoothed(zonal, strong)) < tolerated) strong *= 4.0;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (weak + strong);
    (leastOverLargest(smoothed(zonal, middle)) < tolerated ? weak : strong) = middle;
  }
  zonal = smoothed(zonal, strong);
}

}  // namespace

double phongExponent(double roughness) { return 2.0 / squaredWidth(roughness) - 2.0; }

LobeTable makeLobeTable(Lobe lobe, int order) {
  LobeTable table{order, {}};
  std::vector<double> zonal(static_cast<std::size_t>(order));
  for (int step = 0; step < lobeSteps; ++step) {
    const double roughness = static_cast<double>(step) / (lobeSteps - 1);
    if (lobe == Lobe::Ggx) {
      ggxZonal(roughness, zonal);
      smooth(zonal);
    } else {
      phongZonal(roughness, zonal);
    }
    for (int l = 0; l < order; ++l) {
      const double factor = bandFactor(zonal, l);
      table.bands.emplace_back(factor, factor * sh::clampedCosine(l) * (2.0 * l + 1.0) / (4.0 * pi));
    }
  }
  return table;
}

}  // namespace prelight::viewer
