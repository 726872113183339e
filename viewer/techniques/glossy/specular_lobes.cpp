#include "viewer/techniques/glossy/specular_lobes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "basis/quadrature.h"
#include "basis/sh_zonal.h"

namespace prelight::viewer {
namespace {

using std::numbers::pi;
constexpr int quadratureNodes = 256;
constexpr std::size_t wholeBands = 48;  ///< hold all lobes but those of mirrors

/// Squared width of GGX as shaders/scattering.glsl has it.
double squaredWidth(double roughness) {
  const double alpha = std::max(roughness * roughness, 0.002);
  return alpha * alpha;
}

/// Adds what directions with u in [from, to] contribute to z_l = integral f Y_l0, f = D Vis the BRDF without
/// Fresnel factor, seen along the normal. u is the distribution function of half vectors, D cos (Walter et
/// al. 2007, Eq. 35); it makes f dw = 4 Vis du, smooth however sharp the lobe is.
void addGgx(const std::vector<LineSample>& nodes, double a2, double from, double to,
            std::vector<double>& zonal) {
  for (const LineSample& node : nodes) {
    const double u = from + 0.5 * (to - from) * (node.position + 1.0);
    const double half2 = (1.0 - u) / (1.0 - u + a2 * u);  // squared cosine of the half angle
    const double cosine = 2.0 * half2 - 1.0;
    const double above = std::max(cosine, 0.0);
    // Height-correlated Smith (Heitz 2014) with the view along the normal.
    const double visibility = 0.5 / (above + std::sqrt(above * above * (1.0 - a2) + a2));
    const double weight = 0.5 * (to - from) * node.weight * 4.0 * visibility;
    double before = 0.0, legendre = 1.0;
    for (std::size_t l = 0; l < zonal.size(); ++l) {
      const auto band = static_cast<double>(l);
      if (l > 0)
        before =
            std::exchange(legendre, ((2.0 * band - 1.0) * cosine * legendre - (band - 1.0) * before) / band);
      zonal[l] += weight * std::sqrt((2.0 * band + 1.0) / (4.0 * pi)) * legendre;
    }
  }
}

/// Beyond 90 degrees, where seen along the normal there is nothing but below it in slanted views, the lobe
/// goes on with the masking of the horizon.
void ggxZonal(const std::vector<LineSample>& nodes, double roughness, std::vector<double>& zonal) {
  const double a2 = squaredWidth(roughness);
  std::fill(zonal.begin(), zonal.end(), 0.0);
  const double horizon = 1.0 / (1.0 + a2);  // u of a half angle of 45 degrees
  addGgx(nodes, a2, 0.0, horizon, zonal);
  addGgx(nodes, a2, horizon, 1.0, zonal);
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

/// A zonal function on a grid of angles that every band is smooth on.
class ZonalGrid {
 public:
  explicit ZonalGrid(std::size_t order) : order_(order) {
    for (int i = 0; i <= steps; ++i) {
      const double cosine = std::cos(pi * i / steps);
      for (std::size_t l = 0; l < order; ++l) {
        const auto band = static_cast<unsigned>(l);
        values_.push_back(std::sqrt((2.0 * band + 1.0) / (4.0 * pi)) * std::legendre(band, cosine));
      }
    }
  }

  /// Returns the least value over the largest.
  double leastOverLargest(const std::vector<double>& zonal) const {
    double least = 0.0, largest = 0.0;
    for (std::size_t i = 0; i <= steps; ++i) {
      least = std::min(least, value(zonal, i));
      largest = std::max(largest, value(zonal, i));
    }
    return least / largest;
  }

  /// Returns the angle at which half of the value on the axis is left, rad.
  double halfWidth(const std::vector<double>& zonal) const {
    const double half = 0.5 * value(zonal, 0);
    for (std::size_t i = 1; i <= steps; ++i) {
      const double here = value(zonal, i), before = value(zonal, i - 1);
      if (here < half) return pi / steps * (static_cast<double>(i) - (half - here) / (before - here));
    }
    return pi;
  }

 private:
  static constexpr int steps = 512;

  double value(const std::vector<double>& zonal, std::size_t step) const {
    return std::inner_product(zonal.begin(), zonal.end(),
                              values_.begin() + static_cast<std::ptrdiff_t>(step * order_), 0.0);
  }

  std::size_t order_;
  std::vector<double> values_;  ///< [step][band]
};

std::vector<double> smoothed(const std::vector<double>& zonal, double lambda) {
  std::vector<double> result = zonal;
  for (std::size_t l = 0; l < result.size(); ++l) {
    const double bend = static_cast<double>(l * (l + 1));
    result[l] /= 1.0 + lambda * bend * bend;  // Sloan 2017, as sh::minimalWindow
  }
  return result;
}

/// Smooths a lobe as weakly as leaves nothing below -1/1000 of its peak, but never so much that it becomes
/// wider than the cut one by more than a seventh: what is negative then, shaders clamp.
void smooth(const ZonalGrid& grid, std::vector<double>& zonal) {
  constexpr double tolerated = -1e-3, widest = 8.0 / 7.0;
  const double width = widest * grid.halfWidth(zonal);
  const auto isEnough = [&](double lambda) {
    const std::vector<double> result = smoothed(zonal, lambda);
    return grid.leastOverLargest(result) >= tolerated || grid.halfWidth(result) >= width;
  };
  if (isEnough(0.0)) return;
  double weak = 0.0, strong = 1.0;
  while (!isEnough(strong)) strong *= 4.0;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (weak + strong);
    (isEnough(middle) ? strong : weak) = middle;
  }
  zonal = smoothed(zonal, strong);
}

/// Returns the share of a lobe that is left to the bands that represent it: all where they differ little from
/// it in the mean square over directions.
double heldShare(const std::vector<double>& whole, const std::vector<double>& represented) {
  constexpr double little = 0.1, much = 0.4;  // root mean square, of the lobe's own
  double lost = 0.0, all = 0.0;
  for (std::size_t l = 0; l < whole.size(); ++l) {
    const double left = l < represented.size() ? represented[l] : 0.0;
    all += whole[l] * whole[l];
    lost += (whole[l] - left) * (whole[l] - left);
  }
  const double t = std::clamp((std::sqrt(lost / all) - little) / (much - little), 0.0, 1.0);
  return 1.0 - t * t * (3.0 - 2.0 * t);
}

}  // namespace

double phongExponent(double roughness) { return 2.0 / squaredWidth(roughness) - 2.0; }

std::vector<glm::vec2> LobeTable::texels() const {
  const auto length = static_cast<std::ptrdiff_t>(order);
  std::vector<glm::vec2> result;
  for (std::size_t step = 0; step < shares.size(); ++step) {
    const auto first = bands.begin() + static_cast<std::ptrdiff_t>(step) * length;
    result.insert(result.end(), first, first + length);
    result.emplace_back(0.0f, shares[step]);
  }
  return result;
}

LobeTable makeLobeTable(Lobe lobe, int order) {
  LobeTable table{order, {}, {}};
  const ZonalGrid grid(static_cast<std::size_t>(order));
  const std::vector<LineSample> nodes = gaussLegendre(quadratureNodes);
  std::vector<double> whole(wholeBands);
  for (int step = 0; step < lobeSteps; ++step) {
    const double roughness = static_cast<double>(step) / (lobeSteps - 1);
    lobe == Lobe::Ggx ? ggxZonal(nodes, roughness, whole) : phongZonal(roughness, whole);
    std::vector<double> zonal(whole.begin(), whole.begin() + order);
    if (lobe == Lobe::Ggx) smooth(grid, zonal);  // Phong's is cut, as its closed form is
    for (int l = 0; l < order; ++l) {
      const double factor = bandFactor(zonal, l);
      table.bands.emplace_back(factor, factor * sh::clampedCosine(l) * (2.0 * l + 1.0) / (4.0 * pi));
    }
    table.shares.push_back(static_cast<float>(heldShare(whole, zonal)));
  }
  return table;
}

}  // namespace prelight::viewer
