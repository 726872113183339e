#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <string_view>

namespace prelight {

/// Bands of the SH in which incident radiance at a place is measured before it is encoded.
constexpr int incidentOrder = 5;
constexpr std::size_t incidentTerms = 25;

/// A representation of the light arriving at a place on a surface, from which the irradiance follows for any
/// normal in the hemisphere over the surface (for bump-mapped normals). Stored values may be interpolated
/// between places.
struct Encoding {
  std::string_view name;     ///< in options, layers and attributes: "ambient-cube"
  std::string_view summary;  ///< one line for help texts and info
  std::size_t values;        ///< numbers per place, including colours and directions
  bool inFrame;              ///< whether values are relative to the frame's tangents instead of the world

  /// Encodes `incident`, [channel 3][incidentTerms], radiance (W/(m2 sr)) in real SH in world space, in the
  /// order of basis/sh.h. The columns of `frame` are tangent, bitangent and normal (orthonormal, world
  /// space). Fills `values` with finite numbers.
  void (*encode)(std::span<const float> incident, const glm::mat3& frame, std::span<float> values);

  /// Returns irradiance per channel, W/m2, >= 0, for a unit normal in world space.
  glm::vec3 (*irradiance)(std::span<const float> values, const glm::mat3& frame, const glm::vec3& normal);

  /// GLSL 330 source of the same function: const int encodedValueCount; vec3 encodedIrradiance(float
  /// v[encodedValueCount], mat3 frame, vec3 normal).
  std::string_view shader;
};

/// Returns the three numbers of an encoding from `first` on as a colour.
inline glm::vec3 storedColour(std::span<const float> values, std::size_t first) {
  return {values[first], values[first + 1], values[first + 2]};
}

/// Returns the embedded irradiance.glsl of an encoding's folder, such as "ambient_cube". Throws
/// std::out_of_range for an unknown folder.
std::string_view encodingShader(std::string_view folder);

}  // namespace prelight
