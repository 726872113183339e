#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

namespace prelight {

/// Equirectangular sky of linear radiance. +Y up; the centre column looks along -Z and u grows towards +X.
struct Environment {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> radiance;  ///< [row][column], row 0 at +Y, W/(m2 sr), finite and >= 0

  /// World direction of the point (u, v) in [0,1]^2 of the map.
  static glm::dvec3 direction(double u, double v);
  /// Inverse of direction(): (u, v) of a unit world direction.
  static glm::dvec2 coordinates(const glm::dvec3& direction);
};

/// Reads .hdr or .exr. Throws InputError, also for texels that are not radiance (docs/conventions.md, "Sky").
Environment readEnvironment(const std::filesystem::path& path);

/// A sky of one radiance everywhere.
Environment constantEnvironment(const glm::vec3& radiance);

}  // namespace prelight
