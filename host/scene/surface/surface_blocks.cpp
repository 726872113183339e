#include "scene/surface/surface_blocks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "scene/surface/triangles.h"

namespace prelight {
namespace {

constexpr std::uint32_t trianglesPerBlock = 64;

/// Distance, in block radii, from which on a block counts as one flat piece, which covers the same share
/// within 2 %.
constexpr double farRadii = 4.0;

glm::dvec3 positionOf(const CompiledScene& scene, std::uint32_t triangle, int corner) {
  return glm::dvec3(scene.positions[scene.triangles[triangle][corner]]);
}

/// Returns true when a ray meets a box nearer than `most`. `inverse`: 1 / direction.
bool meetsBox(const glm::dvec3& lower, const glm::dvec3& upper, const glm::dvec3& origin,
              const glm::dvec3& inverse, double most) {
  const glm::dvec3 a = (lower - origin) * inverse, b = (upper - origin) * inverse;
  const glm::dvec3 first = glm::min(a, b), last = glm::max(a, b);
  const double enters = std::max({first.x, first.y, first.z, 0.0});
  const double leaves = std::min({last.x, last.y, last.z, most});
  return enters <= leaves;
}

}  // namespace

// Van Oosterom and Strackee 1983, "The solid angle of a plane triangle", Eq. 8.
double backShare(const CompiledScene& scene, std::uint32_t triangle, const glm::dvec3& point) {
  const glm::dvec3 a = positionOf(scene, triangle, 0) - point, b = positionOf(scene, triangle, 1) - point,
                   c = positionOf(scene, triangle, 2) - point;
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double volume = glm::dot(a, glm::cross(b, c));
  const double sum = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
  return std::atan2(volume, sum) / (2.0 * std::numbers::pi);
}

SurfaceBlocks::SurfaceBlocks(const CompiledScene& scene, std::span<const std::uint8_t> counts)
    : scene_(scene) {
  for (std::uint32_t p = 0; p < scene.primitives.size(); ++p) {
    const PrimitiveRange& range = scene.primitives[p];
    for (std::uint32_t t = 0; counts[p] != 0 && t < range.triangleCount; t += trianglesPerBlock) {
      Block block;
      block.primitive = p;
      block.firstTriangle = range.firstTriangle + t;
      block.triangleCount = std::min(trianglesPerBlock, range.triangleCount - t);
      blocks_.push_back(block);
    }
  }
  parallelRanges(blocks_.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      blocks_[i] = makeBlock(blocks_[i].primitive, blocks_[i].firstTriangle, blocks_[i].triangleCount);
  });
}

SurfaceBlocks::Block SurfaceBlocks::makeBlock(std::uint32_t primitive, std::uint32_t first,
                                              std::uint32_t count) const {
  Block block;
  block.primitive = primitive;
  block.firstTriangle = first;
  block.triangleCount = count;
  glm::vec3 lower(scene_.positions[scene_.triangles[first].x]), upper(lower);
  for (std::uint32_t t = first; t < first + count; ++t) {
    block.areaVector += 0.5 * geometricNormal(scene_, t);
    for (int corner = 0; corner < 3; ++corner) {
      const glm::vec3& p = scene_.positions[scene_.triangles[t][corner]];
      lower = glm::min(lower, p);
      upper = glm::max(upper, p);
    }
  }
  block.lower = glm::dvec3(lower);
  block.upper = glm::dvec3(upper);
  return block;
}

std::vector<double> SurfaceBlocks::backShares(const glm::dvec3& point) const {
  std::vector<double> shares(scene_.primitives.size(), 0.0);
  for (const Block& block : blocks_) {
    const glm::dvec3 way = block.centre() - point;
    const double square = glm::dot(way, way), diagonal = glm::length(block.upper - block.lower);
    if (square > 0.25 * farRadii * farRadii * diagonal * diagonal) {
      shares[block.primitive] +=
          glm::dot(block.areaVector, way) / (4.0 * std::numbers::pi * square * std::sqrt(square));
      continue;
    }
    for (std::uint32_t t = 0; t < block.triangleCount; ++t)
      shares[block.primitive] += backShare(scene_, block.firstTriangle + t, point);
  }
  return shares;
}

std::optional<FirstMet> SurfaceBlocks::firstMet(const glm::dvec3& origin, const glm::dvec3& direction) const {
  const glm::dvec3 inverse = 1.0 / direction;
  double nearest = 1e300;
  std::optional<FirstMet> met;
  for (const Block& block : blocks_) {
    if (!meetsBox(block.lower, block.upper, origin, inverse, nearest)) continue;
    for (std::uint32_t t = block.firstTriangle; t < block.firstTriangle + block.triangleCount; ++t) {
      const std::optional<double> away = distanceTo(scene_, t, origin, direction);
      if (!away || !(*away > 0.0 && *away < nearest)) continue;
      nearest = *away;
      met = FirstMet{t, nearest, glm::dot(geometricNormal(scene_, t), direction) > 0.0};
    }
  }
  return met;
}

}  // namespace prelight
