#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <string_view>

namespace prelight {

/// Bands of SH in which incident radiance about a place is measured before it is encoded.
constexpr int incidentOrder = 5;
constexpr std::size_t incidentTerms = 25;

/// A way to store the light that arrives at a place of a surface, from which follows its irradiance for any
/// normal of the hemisphere over the surface (for bump-mapped normals). Stored values may be interpolated
/// between places.
struct Encoding {
  std::string_view name;     ///< of options, layers and attributes: "ambient-cube"
  std::string_view summary;  ///< one line for help texts and info
  std::size_t values;        ///< numbers of a place, colours and directions together
  bool inFrame;              ///< values are relative to the frame's tangents; otherwise to the world

  /// `incident`: [channel 3][incidentTerms], radiance (W/(m2 sr)) in real SH as basis/sh.h orders them, world
  /// space. `frame`: columns tangent, bitangent, normal (orthonormal, world space). Fills `values`, all
  /// finite.
  void (*encode)(std::span<const float> incident, const glm::mat3& frame, std::span<float> values);

  /// W/m2 a channel, for a unit normal in world space; never negative.
  glm::vec3 (*irradiance)(std::span<const float> values, const glm::mat3& frame, const glm::vec3& normal);

  /// GLSL 330 of the same: const int encodedValueCount;
  /// vec3 encodedIrradiance(float v[encodedValueCount], mat3 frame, vec3 normal).
  std::string_view shader;
};

}  // namespace prelight
