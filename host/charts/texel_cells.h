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
/// lie on the texels' charts. The mean of light over a cell is what a texel should hold where light changes
/// within it.
class TexelCells {
 public:
  static constexpr std::size_t placeCount = 16;
  /// The side of a cell, in texels. Bilinear look-ups show a straight edge of a shadow with the least squared
  /// error where cells are 0.77 wide, 0.126 texels per length of the edge for 0.167 of texels as their
  /// middles are. A parabola they show off by h^2 times 0.23 rms, for 0.18.
  static constexpr double side = 0.8;
  using Places = std::array<LightMapTexel, placeCount>;

  /// The arguments outlive it.
  TexelCells(const CompiledScene& scene, const LightMapLayout& layout);

  /// Places around that of a texel, evenly over its cell, and so are the first 2, 4 and 8 of them. They come
  /// in pairs that lie opposite one another about the texel's place, so that the mean of what changes
  /// linearly is what is at the place. Where one of a pair is not on the chart, both move to the row or the
  /// column of the place, or to the place itself. On a chart of one texel they are spread over all of the
  /// chart. All are the texel's own place where it is not whole.
  Places around(const LightMapTexel& texel) const;

 private:
  std::optional<LightMapTexel> at(const LightMapTexel& texel, const glm::dvec2& place) const;
  std::span<const std::uint32_t> facesAt(const glm::dvec2& place) const;
  void spreadOverChart(const LightMapTexel& texel, Places& places) const;

  const CompiledScene& scene_;
  const LightMapLayout& layout_;
  std::vector<std::uint32_t> firstFace_;  ///< [texel of the map], then the end
  std::vector<std::uint32_t> faces_;      ///< those that come into each texel's square
};

/// Receivers of texels, `perTexel` each, [texel][receiver]: at the texels' places, or with `cells` spread
/// over these. Their sequences are the caller's to set.
void spreadReceivers(const CompiledScene& scene, std::span<const LightMapTexel> texels,
                     const TexelCells* cells, std::uint32_t perTexel,
                     std::vector<device::Receiver>& receivers);

}  // namespace prelight
