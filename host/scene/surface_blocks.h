#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// The share of the sphere around a point that a triangle covers: positive where the point sees its back,
/// negative where it sees its front. Of a closed surface that looks outwards they add up to 1 at points
/// within and to 0 outside: its winding number.
double backShare(const CompiledScene& scene, std::uint32_t triangle, const glm::dvec3& point);

/// Where a ray meets a surface first.
struct FirstMet {
  std::uint32_t triangle = 0;
  double distance = 0.0;  ///< in lengths of the direction
  bool back = false;
};

/// A compiled scene's triangles in blocks of some that follow one another, for questions of few points and
/// rays that are not worth a hierarchy. The scene outlives it.
class SurfaceBlocks {
 public:
  /// `counts`: [primitive], 1: its triangles are there for the questions.
  SurfaceBlocks(const CompiledScene& scene, std::span<const std::uint8_t> counts);

  std::size_t blockCount() const { return blocks_.size(); }

  /// [primitive], the sum of backShare() of its triangles; blocks that are far off count as one flat piece.
  std::vector<double> backShares(const glm::dvec3& point) const;

  std::optional<FirstMet> firstMet(const glm::dvec3& origin, const glm::dvec3& direction) const;

 private:
  struct Block {
    std::uint32_t primitive = 0, firstTriangle = 0, triangleCount = 0;
    glm::dvec3 lower{1e300}, upper{-1e300};
    glm::dvec3 areaVector{0.0};  ///< sum over its triangles, to their fronts, m2
    glm::dvec3 centre() const { return 0.5 * (lower + upper); }
  };

  Block makeBlock(std::uint32_t primitive, std::uint32_t first, std::uint32_t count) const;

  const CompiledScene& scene_;
  std::vector<Block> blocks_;
};

}  // namespace prelight
