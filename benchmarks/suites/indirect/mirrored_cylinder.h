#pragma once

#include <cstddef>
#include <random>
#include <vector>

#include "shared/photon_types.h"

namespace prelight::benchmarks {

/// The caustic that parallel light throws onto the floor of a cylinder mirrored inside, of radius 0.5 m
/// around the middle of the square of makeSquares(1): a nephroid, in closed form. The light travels towards
/// +x and down; what the wall reflects at angle a lands a horizontal way s further, uniform up to the far
/// wall.
class MirroredCylinder {
 public:
  /// Photons of 1 W together.
  static std::vector<device::Photon> photons(std::size_t count, std::mt19937& random);

  /// Irradiance of 1 W at (x, z), W/m2; infinite on the caustic itself.
  static double irradiance(double x, double z);
};

}  // namespace prelight::benchmarks
