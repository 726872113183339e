#pragma once

#include <cstddef>
#include <span>

#include "viewer/gl/buffer.h"

namespace prelight::viewer {

/// Vertex attributes, by their location in surface.vert.
enum class Attribute : GLuint {
  Position = 0,       ///< vec3, scene coordinates
  Normal = 1,         ///< vec3, unit
  TexCoords = 2,      ///< vec4: of the base colour, of metalness and roughness
  Openness = 3,       ///< vec3, what an object that a cube map lights leaves of its light
  Color = 4,          ///< vec4, linear
  Accessibility = 5,  ///< float, baked AO or what a transfer does to an even sky
  BentNormal = 6,     ///< vec4, baked, w: aperture of its cone; zero where there is none
  Radiance = 7,       ///< vec3, transferred light before albedo
  Glow = 8,           ///< vec3, factor of the emission
  ChartCoord = 9,     ///< vec4: place and layer in the light maps, 1 where there is one
  Reflected = 10,     ///< vec3, radiance to the eye of what other surfaces mirror
  Through =
      10,  ///< vec3, the same as Radiance or Accessibility of the other side, which vector occluders lack
  Highlight = 11,       ///< float, share of the lights' specular reflection that shadows leave
  LampVisibility = 12,  ///< vec4, the first of lampVisibilityStreams, of NearLampPass
};

/// Number of attributes that hold lamps' visibility: the rest of the 16 that OpenGL promises.
constexpr unsigned lampVisibilityStreams = 4;

/// A vertex attribute with one value per vertex.
class VertexStream {
 public:
  template <typename T>
  VertexStream(Attribute attribute, std::span<const T> values)
      : attribute_(attribute), components_(sizeof(T) / sizeof(float)), buffer_(GL_ARRAY_BUFFER, values) {}

  template <typename T>
  void fill(std::span<const T> values) const {
    buffer_.fill(GL_ARRAY_BUFFER, values, GL_DYNAMIC_DRAW);
  }

  Attribute attribute() const { return attribute_; }

  /// Replaces the values of vertices from `first` on.
  template <typename T>
  void replace(std::size_t first, std::span<const T> values) const {
    buffer_.replace(GL_ARRAY_BUFFER, first * sizeof(T), values);
  }

  const gl::Buffer& buffer() const { return buffer_; }

  /// Ties it to the vertex array in use.
  void attach() const {
    glBindBuffer(GL_ARRAY_BUFFER, buffer_.name());
    glEnableVertexAttribArray(static_cast<GLuint>(attribute_));
    glVertexAttribPointer(static_cast<GLuint>(attribute_), components_, GL_FLOAT, GL_FALSE, 0, nullptr);
  }

 private:
  Attribute attribute_;
  GLint components_;
  gl::Buffer buffer_;
};

}  // namespace prelight::viewer
