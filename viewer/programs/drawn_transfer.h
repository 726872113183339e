#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "prelight/bake.h"
#include "prelight/error.h"
#include "prelight/plan.h"
#include "viewer/core/render_inputs.h"
#include "viewer/gl/program.h"
#include "viewer/lights/illumination.h"
#include "viewer/programs/surface_input.h"
#include "viewer/programs/texture_units.h"
#include "viewer/scene/vertex_stream.h"

namespace prelight::viewer {

struct PictureState;

/// A technique's data in OpenGL, and what is computed from it once per light.
class DrawnTransfer : public SurfaceInput {
 public:
  /// Makes a light ready; called before the first picture and whenever the light has changed.
  virtual void light(const Illumination& light) = 0;

  /// Tells that the scene's vertices have moved. True where light() has to be called for it.
  virtual bool verticesMoved() { return false; }

  /// Draws what pictures read besides, such as shadow maps; called before every picture, after light().
  virtual void prepare(const PictureState&) {}

  /// Shows light that was found anew. Throws Error where it has not as many values as before.
  virtual void takeLight(const FoundLight&) {}

  /// Further pictures of the same view would show more of what has moved.
  virtual bool isBehind() const { return false; }

  /// What prepare() drew is that of a draft.
  virtual bool isCoarse() const { return false; }

  /// Side of the square of pixels that share samples of lights in a face of a cube map, which is shown
  /// smaller and blurred.
  static constexpr int usualTurnsInFaces = 4;
  virtual int turnsInFaces() const { return usualTurnsInFaces; }

  /// Adds what prepare() draws under a light and what it leaves out.
  virtual void addPlan(const Illumination&, std::vector<PlannedPass>&) const {}

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
