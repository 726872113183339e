#include "bake/surface_sampler.h"

#include <algorithm>
#include <cmath>

#include "bake/sampling.h"

namespace prelight {

namespace {

/// Rounding of a point of a triangle and of the test against it, in units of the largest coordinate: a few
/// ulp.
constexpr double liftPerMagnitude = 0x1p-19;

/// Samples are drawn this share of the way to the centroid: one that rounding put beyond the edge would see
/// past the wall that meets it there.
constexpr double inset = 0x1p-10;

}  // namespace

SurfaceSampler::SurfaceSampler(const CompiledScene& scene, std::uint64_t seed, Side side,
                               std::uint32_t replicates)
    : scene_(scene),
      seed_(sampling::hashInteger(static_cast<std::uint32_t>(seed) ^
                                  sampling::hashInteger(static_cast<std::uint32_t>(seed >> 32) +
                                                        2u * static_cast<std::uint32_t>(side)))),
      side_(side),
      areas_(scene.triangleCount()),
      active_(scene.triangleCount(), 1),
      replicates_(replicates),
      taken_(std::size_t{scene.triangleCount()} * replicates, 0) {
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    areas_[t] = 0.5 * glm::length(geometricNormal(scene, t));
    totalArea_ += areas_[t];
  }
}

glm::dvec3 orientedNormal(const CompiledScene& scene, std::uint32_t triangle) {
  const glm::dvec3 normal = glm::normalize(geometricNormal(scene, triangle));
  const auto& t = scene.triangles[triangle];
  const glm::dvec3 shading(scene.normals[t.x] + scene.normals[t.y] + scene.normals[t.z]);
  return glm::dot(normal, shading) < 0.0 ? -normal : normal;
}

void SurfaceSampler::pass(double receivers, std::uint32_t raysPerReceiver, const Sink& sink) {
  // Systematic sampling: a comb of unit spacing over the running sum of expected counts, shifted a pass.
  const double shift = sampling::sobol(passes_, seed_).x;
  const double count = scene_.triangleCount();
  double sum = shift;
  const std::uint32_t replicate = passes_ % replicates_;
  ++passes_;
  for (std::uint32_t t = 0; t < scene_.triangleCount(); ++t) {
    if (!active_[t]) continue;
    const double share = 0.5 * (areas_[t] / totalArea_ + 1.0 / count);
    const double expected = receivers * share;
    const auto before = static_cast<std::uint64_t>(sum);
    sum += expected;
    const auto chosen = static_cast<std::uint64_t>(sum) - before;
    for (std::uint64_t i = 0; i < chosen; ++i) {
      const std::uint32_t sequence = t * replicates_ + replicate;
      const std::uint32_t index = taken_[sequence]++;
      const glm::dvec2 u = sampling::sobol(index, seed_ ^ sampling::hashInteger(2 * sequence));
      const glm::dvec2 b = glm::mix(sampling::uniformTriangle(u), glm::dvec2(1.0 / 3.0), inset);
      const SurfaceSample sample{t, static_cast<float>(b.x), static_cast<float>(b.y),
                                 static_cast<float>(areas_[t] / (totalArea_ * share))};
      sink(sample, place(sample, sequence, index, raysPerReceiver));
    }
  }
}

device::Receiver SurfaceSampler::place(const SurfaceSample& sample, std::uint32_t sequence,
                                       std::uint32_t index, std::uint32_t raysPerReceiver) const {
  const auto& t = scene_.triangles[sample.triangle];
  const double b1 = sample.b1, b2 = sample.b2, b0 = 1.0 - b1 - b2;
  const glm::dvec3 p0(scene_.positions[t.x]), p1(scene_.positions[t.y]), p2(scene_.positions[t.z]);
  const glm::dvec3 side = orientedNormal(scene_, sample.triangle) * (side_ == Side::Front ? 1.0 : -1.0);
  glm::dvec3 normal = side;
  if (!scene_.triangleFlat[sample.triangle]) {
    normal = b0 * glm::dvec3(scene_.normals[t.x]) + b1 * glm::dvec3(scene_.normals[t.y]) +
             b2 * glm::dvec3(scene_.normals[t.z]);
    const double length = glm::length(normal);
    normal = length > 1e-6 ? normal / length * (side_ == Side::Front ? 1.0 : -1.0) : side;
  }
  const glm::dvec3 most = glm::max(glm::abs(p0), glm::max(glm::abs(p1), glm::abs(p2)));
  const double lift = liftPerMagnitude * std::max({most.x, most.y, most.z});
  const glm::vec3 position(b0 * p0 + b1 * p1 + b2 * p2 + lift * side);
  const glm::vec3 n(normal), g(side);
  return {{position.x, position.y, position.z},
          sample.triangle,
          {n.x, n.y, n.z},
          seed_ ^ sampling::hashInteger(2 * sequence + 1),
          {g.x, g.y, g.z},
          sampling::shuffledIndex(index, seed_ ^ sampling::hashInteger(~sequence)) * raysPerReceiver};
}

}  // namespace prelight
