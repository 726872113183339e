#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"
#include "shared/cast_types.h"

namespace prelight {

/// Places spread over the cells of a light map's texels: squares around the texels' places, as far as they
/// lie on the texels' charts. A texel should hold the mean of light over its cell where light changes within
/// it.
class TexelCells {
 public:
  static constexpr std::size_t placeCount = 16;
  /// The side of a cell, in texels. Bilinear look-ups show a straight shadow edge with the least squared
  /// error for cells 0.77 wide: 0.126 texels per length of the edge, against 0.167 for values at the texels'
  /// centres. Their error for a parabola is 0.23 h^2 rms, against 0.18 h^2.
  static constexpr double side = 0.8;
  using Places = std::array<LightMapTexel, placeCount>;

  /// The arguments must outlive this object.
  TexelCells(const CompiledScene& scene, const LightMapLayout& layout);

  /// Returns places around that of a texel, distributed evenly over its cell, as are the first 2, 4 and 8 of
  /// them. They come in pairs opposite one another about the texel's place, so that the mean of a linear
  /// function is its value at the place. Where one of a pair is not on the chart, both move to the row or the
  /// column of the place, or to the place itself. On a chart of one texel they are spread over the entire
  /// chart. All are the texel's own place if it is not whole.
  Places around(const LightMapTexel& texel) const;

  /// Returns places spread over a texel's square, as far as they lie on its chart, those nearest to the
  /// square's middle first.
  std::vector<LightMapTexel> within(const LightMapTexel& texel) const;

 private:
  std::optional<LightMapTexel> at(const LightMapTexel& texel, const glm::dvec2& place) const;
  std::span<const std::uint32_t> facesAt(const glm::dvec2& place) const;
  void spreadOverChart(const LightMapTexel& texel, Places& places) const;

  const CompiledScene& scene_;
  const LightMapLayout& layout_;
  std::vector<std::uint32_t> firstFace_;  ///< [texel of the map], then the end
  std::vector<std::uint32_t> faces_;      ///< faces that reach into each texel's square
};

/// Makes receivers of texels, `perTexel` each, [texel][receiver]: at the texels' places or, with `cells`,
/// spread over these. The caller sets their sequences.
void spreadReceivers(const CompiledScene& scene, std::span<const LightMapTexel> texels,
                     const TexelCells* cells, std::uint32_t perTexel,
                     std::vector<device::Receiver>& receivers);

/// Light of a light map's texels, [texel of the layout], irradiance summed over the channels.
struct TexelLight {
  std::span<const float> sharp;          ///< light of lights whose shadows have sharp edges
  std::span<const float> all;            ///< light of all lights
  std::span<const std::uint8_t> hidden;  ///< 1 inside an object, where the light does not count
};

/// Returns the texels that an edge of sharp light crosses, ascending: those whose sharp light differs from
/// that of one of the eight texels around by more than a small share of all light there. Texels of other
/// charts are not compared.
std::vector<std::uint32_t> edgeTexels(const LightMapLayout& layout, const TexelLight& light);

}  // namespace prelight
