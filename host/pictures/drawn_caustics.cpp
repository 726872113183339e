#include "pictures/drawn_caustics.h"

#include <fmt/format.h>

#include "gpu/transport_scene.h"
#include "photon/caustic_light.h"
#include "photon/photon_sources.h"
#include "photon/photon_tracer.h"
#include "scene/surface/surface_regions.h"

namespace prelight::pictures {

std::unique_ptr<DrawnCaustics> traceCaustics(DrawingSession& session, const LoadedScene& loaded,
                                             const viewer::RenderOptions& render, const Environment* sky,
                                             const DeviceOptions& device, std::uint64_t photons) {
  requireTriangles(loaded);
  const auto nothing = [&] {
    session.note(
        "DrawRequest::causticPhotons: no light of this scene reaches a surface through mirrors or glass");
    return nullptr;
  };
  if (causticCasters(loaded.compiled).empty()) return nothing();
  const auto opened = session.measure("device", [&] { return session.openDevice(device); });
  auto drawn = std::make_unique<DrawnCaustics>();
  session.measure("caustics", [&] {
    const LitScene lit{loaded.compiled, loaded.scene.images, render.lights.value_or(loaded.scene.lights), sky,
                       render.skyRotation};
    TransportScene scene(lit, *opened);
    drawn->photons =
        sendPhotons(loaded.compiled, scene, causticRequest(photons), session.progress()).hits.photons;
  });
  if (drawn->photons.empty()) return nothing();
  const DensitySurface surface =
      makeDensitySurface(loaded.compiled, makeSurfaceRegions(loaded.compiled, usualCreaseAngle));
  drawn->caustics = {drawn->photons, makeCausticMap(drawn->photons, surface).filter};
  session.note(fmt::format("caustics: {} photons; every point uses the {} nearest ones within {:.3g} m",
                           drawn->photons.size(), drawn->caustics.filter.density.nearest,
                           drawn->caustics.filter.radius));
  return drawn;
}

}  // namespace prelight::pictures
