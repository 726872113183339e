#include "viewer/specular_lobes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "basis/quadrature.h"
#include "basis/sh_zonal.h"

namespace prelight::viewer {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int quadratureNodes = 128;

/// Squared width of GGX as shaders/specular.glsl has it.
double squaredWidth(double roughness) {
  const double alpha = std::max(roughness * roughness, 0.002);
  return alpha * alpha;
}

/// z_l = integral f Y_l0 of the BRDF without Fresnel factor, f = D Vis, seen along the normal. The
/// substitution u = 1 - cos^2-distributed half angles (the distribution function of D cos, Walter et al. 2007
/// Eq. 35) makes f dw = 4 Vis du: smooth however sharp the lobe is.
void ggxZonal(double roughness, std::vector<double>& zonal) {
  const double a2 = squaredWidth(roughness);
  std::fill(zonal.begin(), zonal.end(), 0.0);
  const double horizon = 1.0 / (1.0 + a2);  // half angle of 45 degrees
  for (const LineSample& node : gaussLegendre(quadratureNodes)) {
    const double u = 0.5 * horizon * (node.position + 1.0);
    const double half2 = (1.0 - u) / (1.0 - u + a2 * u);  // squared cosine of the half angle
    const double cosine = 2.0 * half2 - 1.0;
    // Height-correlated Smith (Heitz 2014) with the view along the normal.
    const double visibility = 0.5 / (cosine + std::sqrt(cosine * cosine * (1.0 - a2) + a2));
    const double weight = 0.5 * horizon * node.weight * 4.0 * visibility;
    double before = 0.0;
    double p = 1.0;
    for (std::size_t l = 0; l < zonal.size(); ++l) {
      if (l > 0) {
        const double band = static_cast<double>(l);
        const double next = ((2.0 * band - 1.0) * cosine * p - (band - 1.0) * before) / band;
        before = p;
        p = next;
      }
      zonal[l] += weight * std::sqrt((2.0 * static_cast<double>(l) + 1.0) / (4.0 * pi)) * p;
    }
  }
}

void phongZonal(double roughness, std::vector<double>& zonal) {
  const double exponent = phongExponent(roughness);
  sh::cosinePowerZonal(exponent, zonal);
  for (double& z : zonal) z *= (exponent + 2.0) / (exponent + 1.0);
}

}  // namespace

double phongExponent(double roughness) { return 2.0 / squaredWidth(roughness) - 2.0; }

LobeTable makeLobeTable(Lobe lobe, int order) {
  LobeTable table{order, {}};
  std::vector<double> zonal(static_cast<std::size_t>(order));
  for (int step = 0; step < lobeSteps; ++step) {
    const double roughness = static_cast<double>(step) / (lobeSteps - 1);
    lobe == Lobe::Ggx ? ggxZonal(roughness, zonal) : phongZonal(roughness, zonal);
    for (int l = 0; l < order; ++l) {
      const double factor = std::sqrt(4.0 * pi / (2.0 * l + 1.0)) * zonal[static_cast<std::size_t>(l)];
      table.bands.emplace_back(factor, factor * sh::clampedCosine(l) * (2.0 * l + 1.0) / (4.0 * pi));
    }
  }
  return table;
}

}  // namespace prelight::viewer
