#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace prelight {

/// What an isotropic material reflects, as it was measured: a part that leaves alike in all directions, and
/// the rest in cells of the half vector's angle, the difference vector's angle with it and that one's turn
/// about it (Rusinkiewicz 1998). Reciprocal, and never more than arrives.
struct MeasuredBrdf {
  static constexpr int halves = 90;  ///< cells of the half vector's angle; their bounds grow as squares
  static constexpr int differences = 90;
  static constexpr int turns = 180;   ///< over half a turn: the other half is the same
  static constexpr int cosines = 48;  ///< of `albedos`: squares of equal steps from 0 to 1
  static constexpr int cells = halves * differences * turns;

  std::string name;         ///< of the file
  glm::vec3 diffuse{0.0f};  ///< albedo of the part that leaves alike in all directions
  /// [half][difference][turn], 1/sr, what is reflected beyond that part; below 0 where grazing light leaves
  /// less than that. Empty: there is nothing else.
  std::vector<glm::vec3> rest;
  std::vector<glm::vec3> albedos;  ///< [cosine] share that the rest reflects of light from one direction
  float roughness = 1.0f;          ///< of the GGX lobe by which the rest is sampled best
  float cosineShare = 1.0f;        ///< and the chance with which it is sampled by the cosine instead
};

}  // namespace prelight
