#pragma once

#include <cstddef>
#include <span>

#include "prelight/bake.h"
#include "prelight/error.h"
#include "viewer/gl/buffer.h"
#include "viewer/gl/program.h"
#include "viewer/illumination.h"

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

/// Attributes that are left of the 16 that OpenGL promises.
constexpr unsigned lampVisibilityStreams = 4;

/// Texture units of the programs of surfaces.
enum Unit : GLuint {
  baseColorUnit = 0,
  metallicRoughnessUnit = 1,
  emissiveUnit = 2,
  triangleNormalsUnit = 3,
  skyUnit = 4,
  trianglesUnit = 5,         ///< shaders/triangles.glsl
  positionsUnit = 6,         ///< the same
  arrivingUnit = 7,          ///< shaders/glossy.glsl
  lobesUnit = 8,             ///< the same
  lightMapsUnit = 9,         ///< shaders/light_map.glsl
  lightMapCornersUnit = 10,  ///< the same
  causticsUnit = 11,         ///< shaders/surface.frag
  shadowMapsUnit = 12,       ///< shaders/shadows.glsl
  shadowViewsUnit = 13,      ///< the same
  surroundingsUnit = 14,     ///< shaders/surroundings.glsl
  insidesUnit = 15,          ///< the same
  normalTextureUnit = 16,    ///< shaders/normal_map.glsl
  encodedVerticesUnit = 17,  ///< shaders/encoded_light.glsl
  transmissionUnit = 18,
  specularUnit = 19,
  specularColorUnit = 20,
  cornerTangentsUnit = 21,  ///< shaders/normal_map.glsl
  albedosUnit = 22,         ///< shaders/scattering.glsl
  coatUnit = 23,            ///< shaders/top_layers.glsl
  coatRoughnessUnit = 24,   ///< the same
  coatNormalUnit = 25,      ///< the same
  sheenColorUnit = 26,      ///< the same
  sheenRoughnessUnit = 27,  ///< the same
  anisotropyUnit = 28,      ///< shaders/anisotropy.glsl
  filmUnit = 29,            ///< shaders/scattering.glsl
  filmThicknessUnit = 30,   ///< the same
  lampTablesUnit = 31,      ///< shaders/lights.glsl
  screenInputUnit = 32,     ///< shaders/surface.frag, shaders/screen_surface.frag
  screenLampsUnit = 33,     ///< shaders/surface.frag
  screenBounceUnit = 34,    ///< the same
  virtualLightsUnit = 35,   ///< shaders/virtual_lights.glsl
  virtualMapsUnit = 36,     ///< the same
  virtualViewsUnit = 37,    ///< the same
  horizonsUnit = 38,        ///< shaders/horizons.glsl
  objectLightUnit = 39,     ///< shaders/object_light.glsl
  measuredLobesUnit = 40,   ///< shaders/glossy.glsl
  lightMapWallsUnit = 41,   ///< shaders/light_map.glsl
};

/// A value a vertex.
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

  /// Of vertices from `first` on.
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

/// A technique's baked data in OpenGL, and what is computed of it once a light.
class DrawnTransfer {
 public:
  virtual ~DrawnTransfer() = default;

  /// Makes a light ready; called before the first picture and whenever the light has changed.
  virtual void light(const Illumination& light) = 0;

  /// The scene's vertices are at other places. True where light() has to be called for it.
  virtual bool verticesMoved() { return false; }

  /// Replaces the irradiance that it shows, W/m2, [vertex]. False where it shows none.
  virtual bool replaceIrradiance(std::span<const glm::vec3> /*irradiance*/) { return false; }

  /// The scene's materials are others. True where light() has to be called for it.
  virtual bool materialsChanged() { return false; }

  /// Takes the numbers of another bake in place of those that it has, where it can: then light() is called.
  virtual bool takeBake(const Bake&) { return false; }

  /// What the bake has of some vertices, in rows one behind the other, is another now. True where it is
  /// drawn; light() has to be called for it.
  virtual bool replaceRows(std::size_t /*firstVertex*/, std::span<const float> /*rows*/) { return false; }

  /// True where what light() makes ready is for one place of the eye.
  virtual bool dependsOnEye(const Illumination&) const { return false; }

  /// Binds textures, sets the uniforms of the program in use and the attributes of the vertex array in use.
  virtual void bind(const gl::Program& program) const = 0;

  /// What is approximated with a light, for people.
  virtual void describe(const Illumination& light, Warnings& notes) const = 0;
};

}  // namespace prelight::viewer
