#include "gather/indirect_light.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bake/surface_sampler.h"
#include "gather/final_gather.h"
#include "photon/density_estimator.h"

namespace prelight {

namespace {

using Clock = std::chrono::steady_clock;

/// Of half the scene's diagonal: photons farther than that tell nothing of a texel.
constexpr double widestEstimate = 0.25;

double sceneRadius(const CompiledScene& scene) {
  return 0.5 * glm::length(glm::dvec3(scene.boundsMax) - glm::dvec3(scene.boundsMin));
}

std::uint32_t mixed(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

SurfaceSample sampleOf(const CompiledScene& compiled, const LightMapTexel& texel, Side& side) {
  const bool back = texel.face >= compiled.triangleCount();
  side = back ? Side::Back : Side::Front;
  SurfaceSample sample;
  sample.triangle = back ? texel.face - compiled.triangleCount() : texel.face;
  const glm::dvec2 weights = keptOffEdges(compiled, sample.triangle, glm::dvec2(texel.b1, texel.b2));
  sample.b1 = static_cast<float>(weights.x);
  sample.b2 = static_cast<float>(weights.y);
  sample.weight = 1.0f;
  return sample;
}

std::vector<device::Receiver> receiversOf(const CompiledScene& compiled, const LightMapLayout& layout,
                                          std::uint64_t seed) {
  std::vector<device::Receiver> receivers;
  receivers.reserve(layout.texels.size());
  const auto folded = static_cast<std::uint32_t>(seed ^ (seed >> 32));
  for (const LightMapTexel& texel : layout.texels) {
    Side side{};
    const SurfaceSample sample = sampleOf(compiled, texel, side);
    receivers.push_back(receiverAt(compiled, sample, side));
    receivers.back().seed = mixed(texel.texel + mixed(folded));
    receivers.back().firstSample = 0;
  }
  return receivers;
}

std::vector<glm::vec3> spread(const LightMapLayout& layout, const std::vector<glm::vec3>& values) {
  std::vector<glm::vec3> grid(layout.texelCount(), glm::vec3(0.0f));
  for (std::size_t i = 0; i < values.size(); ++i) grid[layout.texels[i].texel] = values[i];
  return grid;
}

class Stages {
 public:
  explicit Stages(IndirectReport& report) : report_(report) {}
  void mark(const char* name) {
    const Clock::time_point now = Clock::now();
    report_.stageSeconds.emplace_back(name, std::chrono::duration<double>(now - last_).count());
    last_ = now;
  }

 private:
  IndirectReport& report_;
  Clock::time_point last_ = Clock::now();
};

}  // namespace

std::vector<glm::vec3> approximateIrradiance(const CompiledScene& compiled, const LightMapLayout& layout,
                                             const DensitySurface& surface, const PhotonHits& hits,
                                             int nearestPhotons, const Device& device) {
  DensityOptions options;
  options.nearest = nearestPhotons;
  DensityEstimator estimator(surface, options, device);
  estimator.setPhotons(makePhotonMaps(hits.photons, surface));
  const auto radius = static_cast<float>(widestEstimate * sceneRadius(compiled));
  std::vector<device::DensityQuery> queries;
  queries.reserve(layout.texels.size());
  for (const device::Receiver& r : receiversOf(compiled, layout, 0)) {
    device::DensityQuery query{};
    for (int k = 0; k < 3; ++k) {
      query.position[k] = r.position[k];
      query.normal[k] = r.geometricNormal[k];
    }
    query.triangle = r.triangle;
    query.radius = radius;
    queries.push_back(query);
  }
  return spread(layout, estimator.estimate(queries));
}

std::vector<glm::vec3> gatherIndirectLight(const CompiledScene& compiled, TransportScene& scene,
                                           const LightMapLayout& layout, const DensitySurface& surface,
                                           const IndirectRequest& request, const Device& device,
                                           Progress& progress, IndirectReport& report) {
  Stages stages(report);
  PhotonRequest photons;
  photons.kind = PhotonKind::All;
  photons.photons = request.photons;
  photons.seed = request.seed;
  PhotonHits hits;
  report.photons = PhotonTracer(compiled, scene).trace(photons, hits, progress);
  stages.mark("photons");
  IrradianceMap map(scene.context(), layout);
  map.set(approximateIrradiance(compiled, layout, surface, hits, request.nearestPhotons, device));
  stages.mark("density");
  GatherRequest gather;
  gather.raysPerReceiver = request.rays;
  gather.seed = request.seed;
  FinalGather gatherer(compiled, scene, map, gather);
  std::vector<glm::vec3> indirect =
      spread(layout, gatherer.gather(receiversOf(compiled, layout, request.seed), progress));
  report.gatherRays = gatherer.rays();
  stages.mark("gather");
  return indirect;
}

}  // namespace prelight
