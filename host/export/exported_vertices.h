#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "export/export_request.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"
#include "prelight/picture.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/load/file_triangles.h"

namespace prelight {

/// Vertices of one instance of a primitive, each with one place in the light map. A vertex where charts meet
/// appears several times.
struct ChartVertices {
  /// [vertex], index in the file's primitive; starts with all of its vertices in order.
  std::vector<std::uint32_t> source;
  std::vector<glm::vec2> coords;       ///< [vertex], 0..1, v down; 0 for vertices without a chart
  std::vector<std::uint32_t> indices;  ///< [3 x triangle of the file]
  std::size_t originals = 0;           ///< number of vertices of the file's primitive

  bool isSplit() const { return source.size() > originals; }
};

/// Finds the vertices for the fronts (firstFace 0) or the backs (firstFace triangleCount) of triangles.
/// Triangles without a chart keep their vertices.
ChartVertices findChartVertices(const FileTriangles& triangles, const LightMapLayout& layout,
                                std::size_t firstFace, std::size_t vertexCount);

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

/// Appends an accessor for a vertex attribute whose element i is element source[i] of `accessor`, and returns
/// its index. Sparse values are filled in, and elements begin at multiples of 4 bytes. Every source must be
/// in range. `negated` is [element of the copy], 1 for a negated value; if any is, values become floats.
/// Empty: none is negated.
int copyVertexAccessor(GltfDocument& document, std::size_t accessor, std::span<const std::uint32_t> source,
                       std::span<const std::uint8_t> negated = {});

}  // namespace prelight
