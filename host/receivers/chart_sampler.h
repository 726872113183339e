#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "prelight/compiled_scene.h"
#include "receivers/surface_sampler.h"
#include "scene/gltf/charts.h"

namespace prelight {

/// Places receivers in the texels of a chart: up to positionsPerTexel jittered positions per texel, only on
/// the surface, with the normals of the normal map.
class ChartSampler {
 public:
  static constexpr std::uint32_t positionsPerTexel = 16;

  /// The arguments must outlive the object.
  ChartSampler(const CompiledScene& scene, const Charts& charts, std::size_t chart, std::uint64_t seed);

  /// Returns the texels that the surface reaches, row by row.
  const std::vector<std::uint32_t>& texels() const { return texels_; }

  /// Returns receiver `index` of `count` in the texel texels()[place]. Its rays continue the texel's sequence
  /// after those of the previous receiver. Positions repeat if the surface covers only a part of the texel.
  device::Receiver receiver(std::size_t place, std::uint32_t index, std::uint32_t count,
                            std::uint32_t raysPerReceiver) const;

  /// Position of a receiver, for effects that depend on its place in the normal texture.
  struct Point {
    std::uint32_t triangle = 0;  ///< index in the scene
    glm::dvec3 weights{0.0};     ///< weights of the triangle's corners
    glm::dvec3 normal{0.0};      ///< unit, without the normal map
  };
  Point point(std::size_t place, std::uint32_t index, std::uint32_t count) const;

 private:
  struct Position {
    std::uint32_t triangle = 0;  ///< index in the scene
    float b1 = 0.0f;
    float b2 = 0.0f;
  };

  SurfaceSample sampleAt(std::size_t place, std::uint32_t index, std::uint32_t count) const;

  const CompiledScene& scene_;
  const Charts& charts_;
  const Chart& chart_;
  std::uint32_t seed_;
  std::vector<std::uint32_t> texels_;
  std::vector<std::uint32_t> firstPosition_;  ///< [place], followed by the end
  std::vector<Position> positions_;
};

}  // namespace prelight
