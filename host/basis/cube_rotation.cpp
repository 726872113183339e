#include "basis/cube_rotation.h"

#include <cassert>

#include "base/parallel.h"
#include "basis/cube_overlap.h"

namespace prelight {

CubeMap CubeResampling::apply(const CubeMap& map) const {
  assert(map.faceSize == faceSize && map.radiance.size() + 1 == offsets.size());
  CubeMap result{faceSize, std::vector<glm::vec3>(map.radiance.size())};
  for (std::size_t texel = 0; texel < result.radiance.size(); ++texel) {
    glm::dvec3 sum(0.0);
    for (std::uint32_t k = offsets[texel]; k < offsets[texel + 1]; ++k) {
      sum += static_cast<double>(weights[k]) * glm::dvec3(map.radiance[sources[k]]);
    }
    result.radiance[texel] = glm::vec3(sum);
  }
  return result;
}

CubeResampling rotateByArea(const glm::dmat3& rotation, int faceSize) {
  const CubeTexels texels(faceSize);
  const glm::dmat3 inverse = glm::transpose(rotation);
  const std::size_t count = texels.count();
  std::vector<std::vector<TexelOverlap>> rows(count);
  parallelRanges(count, 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t texel = begin; texel < end; ++texel) {
      auto corners = texelCorners(static_cast<std::uint32_t>(texel), faceSize);
      for (glm::dvec3& corner : corners) corner = inverse * corner;
      overlapTexels(corners, faceSize, rows[texel]);
    }
  });
  CubeResampling result{.faceSize = faceSize, .offsets = {0}, .sources = {}, .weights = {}};
  for (std::size_t texel = 0; texel < count; ++texel) {
    for (const TexelOverlap& overlap : rows[texel]) {
      result.sources.push_back(overlap.texel);
      const double weight = overlap.solidAngle / texels.solidAngle(static_cast<std::uint32_t>(texel));
      result.weights.push_back(static_cast<float>(weight));
    }
    result.offsets.push_back(static_cast<std::uint32_t>(result.sources.size()));
  }
  return result;
}

CubeResampling rotateByPoint(const glm::dmat3& rotation, int faceSize) {
  checkCubeFaceSize(faceSize, "cube map");
  const glm::dmat3 inverse = glm::transpose(rotation);
  CubeResampling result{.faceSize = faceSize, .offsets = {0}, .sources = {}, .weights = {}};
  for (std::uint32_t texel = 0; texel < cubeTexelCount(faceSize); ++texel) {
    result.sources.push_back(cubeTexel(inverse * cubeTexelDirection(texel, faceSize), faceSize));
    result.weights.push_back(1.0f);
    result.offsets.push_back(texel + 1);
  }
  return result;
}

}  // namespace prelight
