#pragma once

#include <array>
#include <complex>
#include <vector>

#include "prelight/picture.h"

/// Skies seen through the reflection lobes of rough surfaces, for look-ups in pictures that render in real
/// time: the split sum of [1]. A lobe is the one of GGX microfacets, alpha = roughness^2, seen along the
/// normal and weighted by the cosine. It is alike all around, so that the sky's spherical harmonics become
/// those of the filtered sky when each band is scaled (Funk and Hecke).
/// [1] Karis 2013, "Real Shading in Unreal Engine 4".
namespace prelight {

/// Returns the factors of the bands 0, 1, ... of a lobe, the first of which is 1, up to `order` bands. Those
/// below 1e-5 are left out.
std::vector<double> lobeFactors(double alpha, int order);

/// Returns 1 less the mean cosine between a lobe's directions and its axis: 0 for a mirror, 1/3 for alpha 1.
double lobeSpread(double alpha);

/// Returns the alpha in [0, 1] of a lobe of a spread in [0, 1/3]: the inverse of lobeSpread().
double alphaOfSpread(double spread);

/// A sky's spherical harmonics, from which maps of any lobe follow.
class SkyLobes {
 public:
  /// Takes radiance as constant over each texel, in steps of 0.7 degrees.
  explicit SkyLobes(const Environment& sky);

  /// Returns the mean radiance over the lobe about the centre of each texel, in a map of width x width / 2
  /// texels laid out as an Environment. alpha > 0: below 0.015 lobes are narrower than what is kept of the
  /// sky.
  Environment map(double alpha, int width) const;

 private:
  using Coefficients = std::array<std::complex<double>, 3>;  ///< one per channel

  int order_ = 0;
  /// [m][l - m], the integrals of radiance times the normalised Legendre function of l and m times
  /// e^(-i m azimuth), where columns count the azimuth.
  std::vector<std::vector<Coefficients>> bands_;
};

}  // namespace prelight
