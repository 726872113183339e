#include "relight/vertex_lights.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "receivers/sampling.h"
#include "receivers/surface_sampler.h"

namespace prelight {

namespace {

using namespace device;

constexpr std::uint32_t mostReceivers = 4096, hemisphereRays = 8;
constexpr std::uint32_t emitterPasses = 4;  ///< each with all samples of a light caster
constexpr float cornerInset = 0.1f;         ///< weight of each of the two other corners

/// A corner's vertex, and the weight of its receiver there.
struct LitCorner {
  std::uint32_t vertex = 0;
  double weight = 0.0;
};

double angleAt(const CompiledScene& scene, const glm::uvec3& t, int corner) {
  const glm::dvec3 p(scene.positions[t[corner]]);
  const glm::dvec3 a = glm::dvec3(scene.positions[t[(corner + 1) % 3]]) - p;
  const glm::dvec3 b = glm::dvec3(scene.positions[t[(corner + 2) % 3]]) - p;
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Returns a receiver near a corner with the vertex's shading normal.
Receiver receiverNear(const CompiledScene& scene, std::uint32_t triangle, int corner) {
  constexpr float own = 1.0f - 2.0f * cornerInset;
  const SurfaceSample sample{triangle, corner == 1 ? own : cornerInset, corner == 2 ? own : cornerInset,
                             1.0f};
  Receiver receiver = receiverAt(scene, sample, Side::Front);
  receiver.seed = sampling::hashInteger(3 * triangle + static_cast<std::uint32_t>(corner));
  if (scene.triangleFlat[triangle] != 0) return receiver;
  const glm::vec3& normal = scene.normals[scene.triangles[triangle][corner]];
  for (int a = 0; a < 3; ++a) receiver.normal[a] = normal[a];
  return receiver;
}

}  // namespace

VertexLights::VertexLights(const CompiledScene& scene, const GroupedLights& lights, Tracer& tracer)
    : tracer_(tracer),
      blockSize_(receiversPerLightBlock(tracer.context().info().kind, lights, 0, mostReceivers)),
      caster_(scene, lights, nullptr, tracer, blockSize_, 0),
      parameters_(tracer.context(), 1),
      receivers_(tracer.context(), blockSize_),
      rays_(tracer.context(), std::size_t{blockSize_} * hemisphereRays),
      hits_(tracer.context(), std::size_t{blockSize_} * hemisphereRays) {}

/// Makes the hemisphere's rays, which are combined with light samples for emitters.
void VertexLights::aimRays(const std::vector<Receiver>& receivers, std::uint32_t pass) {
  std::vector<Ray> rays;
  for (const Receiver& r : receivers)
    for (std::uint32_t k = 0; k < hemisphereRays; ++k) {
      const glm::dvec3 normal(r.normal[0], r.normal[1], r.normal[2]);
      const glm::vec3 w(
          sampling::cosineHemisphere(sampling::sobol(pass * hemisphereRays + k, r.seed), normal));
      rays.push_back({{r.position[0], r.position[1], r.position[2]},
                      r.triangle,
                      {w.x, w.y, w.z},
                      std::numeric_limits<float>::max()});
    }
  rays_.write(std::span<const Ray>(rays));
  tracer_.traceClosest(rays_, hits_, rays.size());
}

/// Casts a block of receivers and appends its values, [receiver][3][group].
void VertexLights::castBlock(const std::vector<Receiver>& receivers, std::vector<float>& values) {
  const auto count = static_cast<std::uint32_t>(receivers.size());
  const CastParameters parameters{count, hemisphereRays, 0, 0, 0, 0.0f, 0.0f, 0.0f};
  parameters_.write(std::span(&parameters, 1));
  const std::uint32_t passes = caster_.hasEmitters() ? emitterPasses : 1;
  std::vector<float> sum, block;
  for (std::uint32_t pass = 0; pass < passes; ++pass) {
    std::vector<Receiver> aimed = receivers;
    for (Receiver& r : aimed) r.firstSample = pass * hemisphereRays;
    receivers_.write(std::span<const Receiver>(aimed));
    if (caster_.hasEmitters()) aimRays(aimed, pass);
    caster_.cast({parameters_, receivers_, rays_, hits_}, count, tracer_, 0, block);
    sum.resize(block.size(), 0.0f);
    for (std::size_t i = 0; i < block.size(); ++i) sum[i] += block[i] / static_cast<float>(passes);
  }
  values.insert(values.end(), sum.begin(), sum.end());
}

std::vector<float> VertexLights::at(const CompiledScene& scene, const VertexRange& range) {
  std::vector<LitCorner> corners;
  std::vector<Receiver> receivers;
  std::vector<float> values;
  for (std::uint32_t t = range.firstTriangle; t < range.firstTriangle + range.triangleCount; ++t)
    for (int k = 0; k < 3; ++k) {
      corners.push_back({scene.triangles[t][k] - range.firstVertex, angleAt(scene, scene.triangles[t], k)});
      receivers.push_back(receiverNear(scene, t, k));
      if (receivers.size() < blockSize_) continue;
      castBlock(receivers, values);
      receivers.clear();
    }
  if (!receivers.empty()) castBlock(receivers, values);

  const std::size_t width = std::size_t{3} * caster_.groupCount();
  std::vector<double> sums(range.vertexCount * width, 0.0), weights(range.vertexCount, 0.0);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    weights[corners[i].vertex] += corners[i].weight;
    for (std::size_t k = 0; k < width; ++k)
      sums[corners[i].vertex * width + k] += corners[i].weight * double(values[i * width + k]);
  }
  std::vector<float> means(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i)
    means[i] = weights[i / width] > 0.0 ? static_cast<float>(sums[i] / weights[i / width]) : 0.0f;
  return means;
}

}  // namespace prelight
