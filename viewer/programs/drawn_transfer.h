#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "prelight/bake.h"
#include "prelight/error.h"
#include "viewer/gl/program.h"
#include "viewer/lights/illumination.h"
#include "viewer/programs/surface_input.h"
#include "viewer/programs/texture_units.h"
#include "viewer/scene/vertex_stream.h"

namespace prelight::viewer {

/// A technique's baked data in OpenGL, and what is computed from it once per light.
class DrawnTransfer : public SurfaceInput {
 public:
  /// Makes a light ready; called before the first picture and whenever the light has changed.
  virtual void light(const Illumination& light) = 0;

  /// Tells that the scene's vertices have moved. True where light() has to be called for it.
  virtual bool verticesMoved() { return false; }

  /// Replaces the irradiance that it shows, W/m2, [vertex]. False where it shows none.
  virtual bool replaceIrradiance(std::span<const glm::vec3> /*irradiance*/) { return false; }

  /// Tells that the scene's materials have changed. True where light() has to be called for it.
  virtual bool materialsChanged() { return false; }

  /// Takes the numbers of another bake in place of those that it has, where it can: then light() is called.
  virtual bool takeBake(const Bake&) { return false; }

  /// Replaces the transfer of vertices from `firstVertex` on, in rows one behind the other. True where it is
  /// drawn; light() has to be called for it.
  virtual bool replaceRows(std::size_t /*firstVertex*/, std::span<const float> /*rows*/) { return false; }

  /// True where what light() makes ready is for one place of the eye.
  virtual bool dependsOnEye(const Illumination&) const { return false; }

  /// Adds notes on what is approximated under a light.
  virtual void describe(const Illumination& light, Warnings& notes) const = 0;
};

}  // namespace prelight::viewer
