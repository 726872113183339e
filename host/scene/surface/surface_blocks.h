#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// Returns the share of the sphere around a point that a triangle covers: positive where the point sees its
/// back, negative where it sees its front. For a closed surface that looks outwards, the sum is 1 at points
/// inside and 0 outside: its winding number.
double backShare(const CompiledScene& scene, std::uint32_t triangle, const glm::dvec3& point);

/// The first surface that a ray meets.
struct FirstMet {
  std::uint32_t triangle = 0;
  double distance = 0.0;  ///< in lengths of the direction
  bool back = false;
};

/// A compiled scene's triangles in blocks of consecutive ones, for queries of few points and rays, for which
/// building a hierarchy does not pay. The scene must outlive this object.
class SurfaceBlocks {
 public:
  /// `counts`: [primitive] 1 where its triangles take part in the queries.
  SurfaceBlocks(const CompiledScene& scene, std::span<const std::uint8_t> counts);

  std::size_t blockCount() const { return blocks_.size(); }

  /// Returns [primitive] the sum of backShare() over its triangles; distant blocks count as one flat piece.
  std::vector<double> backShares(const glm::dvec3& point) const;

  std::optional<FirstMet> firstMet(const glm::dvec3& origin, const glm::dvec3& direction) const;

 private:
  struct Block {
    std::uint32_t primitive = 0, firstTriangle = 0, triangleCount = 0;
    glm::dvec3 lower{1e300}, upper{-1e300};
    glm::dvec3 areaVector{0.0};  ///< sum over its triangles, pointing to their fronts, m2
    glm::dvec3 centre() const { return 0.5 * (lower + upper); }
  };

  Block makeBlock(std::uint32_t primitive, std::uint32_t first, std::uint32_t count) const;

  const CompiledScene& scene_;
  std::vector<Block> blocks_;
};

}  // namespace prelight
