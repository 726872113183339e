#pragma once

#include <memory>
#include <vector>

#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "techniques/chart_transfer/chart_places.h"
#include "viewer/core/chart_atlas.h"
#include "viewer/gl/texture.h"
#include "viewer/programs/drawn_transfer.h"

namespace prelight::viewer {

/// Texels around a map in the atlas that repeat its edge, for bilinear look-ups.
constexpr int chartBorder = 1;

ChartAtlas chartAtlasOf(const ChartTransfer& transfer);

/// [vertex] place in the atlas, layer, and 1 where there is a map.
std::vector<glm::vec4> chartCoords(const ChartTransfer& transfer, const CompiledScene& scene,
                                   const ChartAtlas& atlas);

/// Whether a normal map gives the texels of a map other normals than the surface has.
bool hasBumps(const CompiledScene& scene, const ChartTransfer::Map& map);

/// SH transfer of light maps, beside that of the vertices, which primitives without a light map have: the
/// light through every texel is computed once a light, on the host, and looked up in the fragment shader.
class ChartLighting : public DrawnTransfer {
 public:
  /// Transfer and scene outlive it.
  ChartLighting(const ChartTransfer& transfer, const CompiledScene& scene,
                std::unique_ptr<DrawnTransfer> vertices);

  void light(const Illumination& light) override;
  bool verticesMoved() override;
  void bind(const gl::Program& program) const override;
  void describe(const Illumination& light, Warnings& notes) const override;

 private:
  const ChartTransfer& transfer_;
  const CompiledScene& scene_;
  std::unique_ptr<DrawnTransfer> vertices_;
  ChartAtlas atlas_;
  VertexStream coords_;
  gl::Texture radiance_;
  std::vector<std::vector<ChartPlace>> places_;  ///< [map][texel], once lamps have shone
  bool lampsShine_ = false;                      ///< in the last light
};

}  // namespace prelight::viewer
