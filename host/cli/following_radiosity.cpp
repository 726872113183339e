#include "cli/following_radiosity.h"

#include <fmt/format.h>

#include "scene/light_sources.h"

namespace prelight::cli {

FollowingRadiosity::FollowingRadiosity(const ShadedScene& shaded, const BakeRequest& request,
                                       const DeviceOptions& device, RadiosityLights shown)
    : live(shaded.loaded.compiled, request, device), follower(live, std::move(shown)) {}

std::unique_ptr<FollowingRadiosity> followingRadiosity(Session& session, const PictureOptions& options,
                                                       const ShadedScene& shaded) {
  if (!shaded.bake.irradiance || shaded.encoding != nullptr || shaded.loaded.compiled.triangleCount() == 0)
    return nullptr;
  BakeRequest request = options.bake.request;
  request.radiosity.wanted = true;
  DeviceOptions device = session.deviceOptions();
  options.bake.addTo(device);
  const RadiosityLights shown{shaded.render.lights.value_or(shaded.loaded.scene.lights),
                              shiningSky(shaded.environment ? &*shaded.environment : nullptr),
                              shaded.render.skyRotation};
  try {
    return std::make_unique<FollowingRadiosity>(shaded, request, device, shown);
  } catch (const Error& error) {
    session.warn(fmt::format("radiosity stays as it is when lights change: {}", error.what()));
    return nullptr;
  }
}

}  // namespace prelight::cli
