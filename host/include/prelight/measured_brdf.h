#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace prelight {

/// A measured isotropic BRDF: a Lambertian part, and the remainder tabulated by the angle of the half vector,
/// the angle between half and difference vector, and the azimuth of the latter (Rusinkiewicz 1998). It is
/// reciprocal and conserves energy.
struct MeasuredBrdf {
  static constexpr int halves = 90;  ///< cells of the half vector's angle, whose bounds grow quadratically
  static constexpr int differences = 90;
  static constexpr int turns = 180;   ///< cells of half a turn; the other half is equal by symmetry
  static constexpr int cosines = 48;  ///< entries of `albedos`, at cosines with evenly spaced square roots
  static constexpr int cells = halves * differences * turns;

  std::string name;         ///< name of the file
  glm::vec3 diffuse{0.0f};  ///< albedo of the Lambertian part
  /// [half][difference][turn], 1/sr: reflection minus the Lambertian part, negative where grazing light
  /// reflects less than that part. Empty: the BRDF is Lambertian.
  std::vector<glm::vec3> rest;
  /// [cosine], share of the light from one direction that the remainder reflects.
  std::vector<glm::vec3> albedos;
  float roughness = 1.0f;    ///< roughness of the GGX lobe that samples the remainder best
  float cosineShare = 1.0f;  ///< probability of sampling the remainder by the cosine instead of the lobe
};

}  // namespace prelight
