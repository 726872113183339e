#pragma once

#include "encodings/registry/registry.h"
#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"
#include "viewer/gl/texture.h"
#include "viewer/programs/drawn_transfer.h"
#include "viewer/techniques/light_map/light_map_lighting.h"

namespace prelight::viewer {

/// Light that arrives at vertices, in an encoding, interpolated in the fragment shader.
class EncodedVertexLighting : public DrawnTransfer {
 public:
  explicit EncodedVertexLighting(const EncodedLight& light);

  void light(const Illumination&) override {}
  void bind(const gl::Program& program) const override;
  void describe(const Illumination&, Warnings&) const override {}

 private:
  gl::BufferTexture values_;  ///< [vertex][number]
};

/// Encoded light of a light map's texels, as a map of layers that hold three numbers each.
LightMap layersOf(const LightMap& map, const EncodedLight& light);

/// Light in an encoding, of those that a bake holds; nullptr: it does not.
const EncodedLight* findEncoded(const std::vector<EncodedLight>& lights, std::string_view encoding);

}  // namespace prelight::viewer
