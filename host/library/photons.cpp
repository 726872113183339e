#include "prelight/photons.h"

#include "base/octahedral.h"
#include "library/library_call.h"
#include "library/open_scene.h"
#include "photon/photon_tracer.h"
#include "prelight/parameters.h"

namespace prelight {

namespace {

LandedPhoton landed(const device::Photon& photon, std::uint32_t path, const CompiledScene& scene) {
  return {.position = scene.origin + glm::dvec3(photon.position[0], photon.position[1], photon.position[2]),
          .power = {photon.power[0], photon.power[1], photon.power[2]},
          .direction = glm::vec3(unpackDirection(photon.direction)),
          .triangle = photon.triangle,
          .path = path};
}

}  // namespace

PhotonResult photons(const LoadedScene& scene, const PhotonOptions& options) {
  requireTriangles(scene.path, scene.compiled, "for photons to land on");
  requireRanges(options);
  LibraryCall call(options.device, options.progress);
  TransportScene transport(litScene(scene, options.lights, options.sky, options.skyRotation), call.device());
  PhotonHits hits;
  const PhotonReport report =
      PhotonTracer(scene.compiled, transport)
          .trace({.kind = options.kind, .photons = options.photons, .seed = options.seed}, hits,
                 call.progress());
  PhotonResult result;
  result.photons.reserve(hits.photons.size());
  for (std::size_t i = 0; i < hits.photons.size(); ++i)
    result.photons.push_back(landed(hits.photons[i], hits.paths[i], scene.compiled));
  result.sent = report.emitted;
  result.rays = report.rays;
  result.emitted = report.power.watts(report.power.emitted);
  result.absorbed = report.power.watts(report.power.absorbed);
  result.escaped = report.power.watts(report.power.escaped);
  return result;
}

}  // namespace prelight
