#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "charts/chart_vertices.h"
#include "export/export_request.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"
#include "prelight/picture.h"

namespace prelight {

/// Charts grouped by brightness, so that an 8-bit picture per range has fine enough steps for its texels.
struct ChartRanges {
  int count = 1;
  std::vector<std::uint8_t> rangeOf;  ///< [chart], 0 is the brightest range; empty: there is one range

  /// Returns the range of a face, 0 for a face without a chart.
  int at(const LightMapLayout& layout, std::size_t face) const;
};

/// Groups charts by their largest value.
ChartRanges findChartRanges(const Picture& picture, const LightMapLayout& layout);

/// Returns a map whose texels in charts of a range are kept; all others are filled from nearby ones, as in
/// irradiancePicture().
Picture pictureOfRange(const Picture& picture, const LightMapLayout& layout, const ChartRanges& ranges,
                       int range);

/// Vertex colours with baked light or occlusion, multiplied by the scene's own vertex colours.
class BakedColors {
 public:
  BakedColors(const CompiledScene& scene, const Bake& bake, ExportForm form);

  /// Returns whether the form has colours.
  bool present() const { return form_ == ExportForm::VertexLight || form_ == ExportForm::VertexOcclusion; }

  /// Returns the radiance, W/(m2 sr), of a colour of 1. It exceeds the radiance of white diffuse surfaces
  /// except for the brightest hundredth.
  float scale() const { return scale_; }

  /// Returns linear colours, 0..1, [vertex of the range]. If `lamp`, the range's material, is given, the
  /// colours include its base colour and emission; else they multiply a base colour and include no emission.
  std::vector<glm::vec4> of(const PrimitiveRange& range, const CompiledMaterial* lamp = nullptr) const;

 private:
  const CompiledScene& scene_;
  const Bake& bake_;
  ExportForm form_;
  float scale_ = 1.0f;
};

}  // namespace prelight
