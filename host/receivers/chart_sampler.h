#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "prelight/compiled_scene.h"
#include "receivers/surface_sampler.h"
#include "scene/gltf/charts.h"

namespace prelight {

/// Places receivers in the texels of a chart: up to positionsPerTexel of them each, jittered, only where the
/// surface is, with the normal map's normals.
class ChartSampler {
 public:
  static constexpr std::uint32_t positionsPerTexel = 16;

  /// The arguments outlive it.
  ChartSampler(const CompiledScene& scene, const Charts& charts, std::size_t chart, std::uint64_t seed);

  /// Texels that the surface reaches, row by row.
  const std::vector<std::uint32_t>& texels() const { return texels_; }

  /// Receiver `index` of `count` of the texel at a place of texels(). Its rays follow those of the receiver
  /// before in the texel's sequence; where the surface covers a part of the texel, positions repeat.
  device::Receiver receiver(std::size_t place, std::uint32_t index, std::uint32_t count,
                            std::uint32_t raysPerReceiver) const;

  /// Where the same receiver lies, for what depends on its place in the normal texture.
  struct Point {
    std::uint32_t triangle = 0;  ///< of the scene
    glm::dvec3 weights{0.0};     ///< of its corners
    glm::dvec3 normal{0.0};      ///< unit, without bumps
  };
  Point point(std::size_t place, std::uint32_t index, std::uint32_t count) const;

 private:
  struct Position {
    std::uint32_t triangle = 0;  ///< of the scene
    float b1 = 0.0f;
    float b2 = 0.0f;
  };

  SurfaceSample sampleAt(std::size_t place, std::uint32_t index, std::uint32_t count) const;

  const CompiledScene& scene_;
  const Charts& charts_;
  const Chart& chart_;
  std::uint32_t seed_;
  std::vector<std::uint32_t> texels_;
  std::vector<std::uint32_t> firstPosition_;  ///< [place], then the end
  std::vector<Position> positions_;
};

}  // namespace prelight
