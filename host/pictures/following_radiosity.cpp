#include "pictures/following_radiosity.h"

#include <fmt/format.h>

#include <utility>

#include "scene/light_sources.h"

namespace prelight::pictures {

FollowingRadiosity::FollowingRadiosity(const ShadedScene& shaded, const BakeRequest& request,
                                       const DeviceOptions& device, const RadiosityLights& shown,
                                       std::optional<RadiosityGroups> of)
    : groups(of ? of->names() : std::vector<std::string>()),
      live(shaded.loaded.compiled, request, device),
      follower(live, shown, std::move(of)) {}

std::unique_ptr<FollowingRadiosity> followingRadiosity(DrawingSession& session, const PictureRequest& asked,
                                                       const ShadedScene& shaded) {
  if (!shaded.bake.irradiance || shaded.encoding != nullptr || shaded.loaded.compiled.triangleCount() == 0)
    return nullptr;
  BakeRequest request = asked.bake.request;
  request.radiosity.wanted = true;
  const DeviceOptions device = session.deviceOptions(asked.bake);
  const RadiosityLights shown{shaded.render.lights.value_or(shaded.loaded.scene.lights),
                              shiningSky(shaded.environment ? &*shaded.environment : nullptr),
                              shaded.render.skyRotation};
  std::optional<RadiosityGroups> groups;
  if (!shaded.bake.lightGroups) groups.emplace(shown, hasEmitters(shaded.loaded.compiled));
  try {
    return std::make_unique<FollowingRadiosity>(shaded, request, device, shown, std::move(groups));
  } catch (const Error& error) {
    session.warn(fmt::format("radiosity stays as it is when lights change: {}", error.what()));
    return nullptr;
  }
}

}  // namespace prelight::pictures
