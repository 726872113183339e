#pragma once

#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"
#include "viewer/gl/texture.h"
#include "viewer/programs/drawn_transfer.h"

namespace prelight::viewer {

/// [face][3] texels from the upper left; far to the left where there is no chart.
std::vector<glm::vec2> lightMapCorners(const LightMapLayout& layout);

/// [row][column] shares of the ways to the right and below at which walls stand, in rows of `width` texels,
/// at least the layout's; empty where the layout has no walls.
std::vector<glm::vec2> lightMapWalls(const LightMapLayout& layout, int width);

/// The irradiance of a light map, looked up bilinearly in the fragment shader: light that stays as it is
/// baked. Where the map holds directions, normal textures turn it.
class LightMapLighting : public DrawnTransfer {
 public:
  LightMapLighting(const LightMap& map, const CompiledScene& scene);

  void light(const Illumination&) override {}
  void bind(const gl::Program& program) const override;
  void describe(const Illumination& light, Warnings& notes) const override;

  /// Replaces the map's values, laid out as they were. Throws Error for another number of them.
  void fill(std::span<const float> values);

 private:
  int frontFaces_;  ///< backs are counted from here
  int width_, height_, coefficients_;
  bool walled_;  ///< there are walls
  gl::BufferTexture corners_;
  gl::BufferTexture walls_;
  gl::Texture layers_;  ///< of coefficients
};

}  // namespace prelight::viewer
