#include "benchmarks/scenes/displacement.h"

#include "receivers/sampling.h"

namespace prelight::benchmarks {

namespace {

/// Value noise of three components in [-1, 1], smooth, with a lattice of unit spacing.
glm::dvec3 noise(const glm::dvec3& p) {
  const glm::ivec3 cell(glm::floor(p));
  const glm::dvec3 f = p - glm::floor(p);
  const glm::dvec3 s = f * f * (3.0 - 2.0 * f);
  glm::dvec3 sum(0.0);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 at(corner & 1, corner >> 1 & 1, corner >> 2);
    const glm::dvec3 w = glm::mix(1.0 - s, s, glm::dvec3(at));
    const glm::uvec3 q(cell + at);
    const std::uint32_t hash = sampling::hashInteger(q.x ^ sampling::hashInteger(q.y + 0x9e3779b9u) ^
                                                     sampling::hashInteger(q.z + 0x3c6ef372u));
    const glm::dvec3 value(unitOf(hash), unitOf(sampling::hashInteger(hash + 1)),
                           unitOf(sampling::hashInteger(hash + 2)));
    sum += w.x * w.y * w.z * (2.0 * value - 1.0);
  }
  return sum;
}

}  // namespace

void displace(MeshShape& shape, double amplitude, double frequency, double seed) {
  for (glm::vec3& position : shape.positions) {
    const glm::dvec3 p = frequency * glm::dvec3(position) + 37.0 * seed;
    position += glm::vec3(amplitude * (noise(p) + 0.5 * noise(2.3 * p) + 0.25 * noise(5.1 * p)));
  }
}

}  // namespace prelight::benchmarks
