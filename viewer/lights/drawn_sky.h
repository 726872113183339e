#pragma once

#include <optional>
#include <span>
#include <vector>

#include "images/sky_lamps.h"
#include "prelight/picture.h"
#include "viewer/core/render_inputs.h"
#include "viewer/core/view_state.h"
#include "viewer/gl/texture.h"
#include "viewer/lights/lighting.h"

namespace prelight::viewer {

constexpr int ambientOrder = 3;  ///< bands of a sky that shaders gather around a normal

/// Returns the numbers of bands of a sky that shaders and a bake's transfer ask for. `bake` may be nullptr.
std::vector<int> skyOrdersOf(const Bake* bake);

/// The sky of a view; what it points to stays as long as the DrawnSky.
struct SeenSky {
  const Environment* map = nullptr;  ///< nullptr: black
  const SkyCoefficients* coefficients = nullptr;
  const gl::Texture* texture = nullptr;
  int width = 1;  ///< texels
  /// Its lamps that shine as lamps: the coefficients are then those of the rest, and the map has them.
  std::span<const SkyLamp> lamps = {};
};

/// The sky of a scene: the inputs', an even one where nothing else gives light, or none.
class DrawnSky {
 public:
  /// `emits`: something in the scene emits light. The inputs' environment outlives it.
  DrawnSky(const RenderInputs& inputs, bool emits);

  /// Returns whether nothing lights the view and its shading shows no baked light. A sky of radiance 1 does
  /// then.
  bool isNeutral(const View& view) const;

  SeenSky seenBy(const View& view) const;

  /// From now on views whose shading shades lamps of skies as lamps see those of the sky so.
  void takeLampsOut();

  /// From now on lobes() returns the sky through the lobes of rough surfaces.
  void makeLobes();

  /// Returns the LobeMap as a texture, or nullptr where none was made or the sky is the same everywhere.
  const gl::Texture* lobes() const { return lobes_ ? &*lobes_ : nullptr; }

  /// There is one that is not alike everywhere.
  bool isMap() const {
    return environment_ != nullptr && (environment_->width > 1 || environment_->height > 1);
  }

 private:
  const Environment* environment_;
  bool emits_;
  int order_;
  SkyCoefficients coefficients_;
  bool triedLamps_ = false;
  std::vector<SkyLamp> lamps_;
  SkyCoefficients withoutLamps_;
  Environment neutralMap_;
  SkyCoefficients neutral_;
  SkyCoefficients black_;
  gl::Texture texture_, neutralTexture_, blackTexture_;
  std::optional<gl::Texture> lobes_;
};

}  // namespace prelight::viewer
