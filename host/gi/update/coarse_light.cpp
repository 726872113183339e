#include "gi/update/coarse_light.h"

#include "charts/texel_grid.h"

namespace prelight {

glm::vec3 followed(const glm::vec3& exact, const glm::vec3& then, const glm::vec3& now) {
  glm::vec3 value;
  for (int c = 0; c < 3; ++c)
    value[c] = now[c] >= then[c] ? exact[c] + (now[c] - then[c]) : exact[c] * (now[c] / then[c]);
  return value;
}

namespace {

/// Returns look-ups of a coarse map at the texels of a fine one, as indices among the coarse map's places.
std::vector<LightMapLookUp> lookUpsOf(const LightMapLayout& coarse, const LightMapLayout& fine) {
  const TexelGrid grid(coarse);
  std::vector<LightMapLookUp> found;
  found.reserve(fine.texels.size());
  for (const LightMapTexel& texel : fine.texels) {
    LightMapLookUp at = lookUp(coarse, lightMapPlace(coarse, texel.face, texel.b1, texel.b2));
    for (std::size_t k = 0; k < at.texels.size(); ++k) {
      const std::uint32_t index = grid.indexOf(at.texels[k]);
      if (index == TexelGrid::none) at.weights[k] = 0.0;
      at.texels[k] = index == TexelGrid::none ? 0 : index;
    }
    found.push_back(at);
  }
  return found;
}

GatherRequest requestOf(std::uint32_t rays, std::uint64_t seed) {
  GatherRequest request;
  request.raysPerReceiver = rays;
  request.seed = seed;
  return request;
}

}  // namespace

CoarseLight::CoarseLight(const LiveScene& scene, TransportScene& transport, const LightMapLayout& layout,
                         const LightMapLayout& fine, const SurfaceRegions& regions,
                         const IrradianceMap& approximation, const CoarseLightOptions& options,
                         const Device& device, Progress& progress)
    : scene_(scene.compiled()),
      layout_(layout),
      options_(options),
      photons_(scene, transport, options.photons, progress),
      approximation_(scene.compiled(), transport.tracer(), layout, regions, options.nearestPhotons, device),
      coarseGather_(transport, approximation_.map(), requestOf(options.rays, options.seed)),
      fineGather_(transport, approximation, requestOf(options.fineRays, options.seed)),
      lookUps_(lookUpsOf(layout, fine)),
      light_(fine.texels.size(), glm::vec3(0.0f)) {
  const std::vector<device::Photon> all = photons_.photons();
  approximation_.photonsChanged({.removed = {}, .added = all});
  approximation_.advance(all, 0);
  now_ = gather(coarseGather_, options_.rays, progress);
  refine(progress);
}

void CoarseLight::changed(const SceneChange& change) {
  photons_.changed(change);
  if (!change.triangles.empty()) approximation_.follow(change.triangles);
  changed_ = unrefined_ = true;
}

std::vector<glm::vec3> CoarseLight::gather(FinalGather& gatherer, std::uint32_t rays, Progress& progress) {
  return gatherer.gather(gatherReceivers(scene_, layout_.texels, 1, rays, options_.seed), progress);
}

std::uint64_t CoarseLight::advance(Progress& progress) {
  if (!changed_) return 0;
  PhotonDelta delta;
  photons_.advance(delta, progress);
  if (!delta.removed.empty() || !delta.added.empty()) approximation_.photonsChanged(delta);
  approximation_.advance(photons_.photons(), 0);
  now_ = gather(coarseGather_, options_.rays, progress);
  changed_ = !photons_.settled();
  interpolate();
  return std::uint64_t{options_.rays} * layout_.texels.size();
}

std::uint64_t CoarseLight::refine(Progress& progress) {
  refined_ = gather(fineGather_, options_.fineRays, progress);
  then_ = now_;
  unrefined_ = false;
  interpolate();
  return std::uint64_t{options_.fineRays} * layout_.texels.size();
}

void CoarseLight::interpolate() {
  std::vector<glm::vec3> values(now_.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = followed(refined_[i], then_[i], now_[i]);
  for (std::size_t i = 0; i < lookUps_.size(); ++i) {
    glm::dvec3 sum(0.0);
    for (std::size_t k = 0; k < lookUps_[i].texels.size(); ++k)
      sum += lookUps_[i].weights[k] * glm::dvec3(values[lookUps_[i].texels[k]]);
    light_[i] = glm::vec3(sum);
  }
}

}  // namespace prelight
