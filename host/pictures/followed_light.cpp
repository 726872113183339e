#include "pictures/followed_light.h"

#include <algorithm>

#include "base/clocks.h"
#include "pictures/shaded_scene.h"
#include "viewer/core/camera.h"

namespace prelight::pictures {

namespace {

/// Fewer than elsewhere, because a few frames may have to send all of them again.
constexpr std::uint64_t followedPhotons = 50'000, followedCausticPhotons = 20'000;

/// Returns the request for a picture of the size of `shaded`.
GlobalIlluminationPictureRequest sizedRequest(const PictureRequest& asked, const ShadedScene& shaded) {
  GlobalIlluminationPictureRequest request = asked.full;
  request.width = shaded.render.width;
  request.height = shaded.render.height;
  return request;
}

/// Lights and sky of a picture with all light: an even sky where nothing else gives light.
struct PictureLights {
  std::vector<Light> lights;
  std::optional<Environment> sky;
};

PictureLights pictureLights(const ShadedScene& shaded) {
  PictureLights found{shaded.render.lights.value_or(shaded.loaded.scene.lights), shaded.environment};
  if (!found.sky && makeLightTables(shaded.loaded.compiled, found.lights, nullptr, true).groupCount == 0)
    found.sky = constantEnvironment(glm::vec3(1.0f));
  return found;
}

std::shared_ptr<const Device> openDevice(DrawingSession& session, const PictureRequest& asked) {
  const DeviceOptions options = session.deviceOptions(asked.bake);
  return session.measure("device", [&] { return session.openDevice(options); });
}

/// Opens the device of a followed scene and stores the picture's sky in it. Returns the scene under the
/// picture's lights.
CompiledScene followUnderLights(DrawingSession& session, const PictureRequest& asked,
                                const ShadedScene& shaded, FollowedScene& followed) {
  requireTriangles(shaded.loaded);
  followed.device = openDevice(session, asked);
  PictureLights lights = pictureLights(shaded);
  followed.sky = std::move(lights.sky);
  CompiledScene compiled = shaded.loaded.compiled;
  compiled.lights = std::move(lights.lights);
  return compiled;
}

}  // namespace

GlobalIllumination drawnGlobalIllumination(DrawingSession& session, const PictureRequest& asked,
                                           const ShadedScene& shaded) {
  requireTriangles(shaded.loaded);
  const std::shared_ptr<const Device> device = openDevice(session, asked);
  const PictureLights lights = pictureLights(shaded);
  const LitScene lit{shaded.loaded.compiled, shaded.loaded.scene.images, lights.lights,
                     lights.sky ? &*lights.sky : nullptr, shaded.render.skyRotation};
  const GlobalIlluminationPictureRequest sized = sizedRequest(asked, shaded);
  GlobalIlluminationRequest request;
  const std::uint32_t triangles = lit.scene.triangleCount();
  request.indirect.photons = sized.photonsOfIndirectLight(triangles);
  request.indirect.rays = asked.full.indirect.rays;
  request.indirect.seed = asked.bake.request.seed;
  request.indirect.directByPhotons = true;  // as in the frames that follow, see LiveLight
  request.indirect.spreadsExcess = false;
  request.causticPhotons = sized.photonsOfCaustics();
  GlobalIllumination light = session.measure("light", [&] {
    return computeGlobalIllumination(shaded.loaded.scene, lit, request, sized.mapTexels(triangles), *device,
                                     session.progress());
  });
  return light;
}

std::unique_ptr<FollowingLight> followingLight(DrawingSession& session, const PictureRequest& asked,
                                               const ShadedScene& shaded) {
  auto following = std::make_unique<FollowingLight>();
  CompiledScene compiled = followUnderLights(session, asked, shaded, *following);
  const GlobalIlluminationPictureRequest sized = sizedRequest(asked, shaded);
  LiveLightOptions live = optionsOfWindows();
  live.photons = asked.full.indirect.photons.value_or(followedPhotons);
  live.texels = sized.mapTexels(shaded.loaded.compiled.triangleCount());
  live.gather.rays = asked.full.indirect.rays;
  if (!asked.countedFrames) live.clock = steadySeconds;
  live.causticPhotons = std::min(sized.photonsOfCaustics(), followedCausticPhotons);
  live.seed = asked.bake.request.seed;
  live.thinBeyond = asked.thinBeyond;
  live.eye = glm::dvec3(
      viewer::chooseCamera(shaded.loaded.scene, shaded.loaded.compiled, shaded.render.camera).world[3]);
  session.measure("light", [&] {
    following->light.emplace(shaded.loaded.scene, std::move(compiled),
                             following->sky ? &*following->sky : nullptr, shaded.render.skyRotation, live,
                             std::span<const int>(), *following->device, session.progress());
  });
  return following;
}

std::unique_ptr<FollowingVirtualLights> followingVirtualLights(DrawingSession& session,
                                                               const PictureRequest& asked,
                                                               const ShadedScene& shaded) {
  auto following = std::make_unique<FollowingVirtualLights>();
  CompiledScene compiled = followUnderLights(session, asked, shaded, *following);
  InstantOptions request = asked.instant;
  request.seed = asked.bake.request.seed;
  session.measure("light", [&] {
    following->lights.emplace(shaded.loaded.scene, std::move(compiled),
                              following->sky ? &*following->sky : nullptr, shaded.render.skyRotation, request,
                              *following->device, session.progress());
  });
  return following;
}

}  // namespace prelight::pictures
