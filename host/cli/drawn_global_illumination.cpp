#include "cli/drawn_global_illumination.h"

#include <algorithm>

#include "cli/picture_options.h"
#include "viewer/camera.h"

namespace prelight::cli {

namespace {

/// A frame's share of the work in a window: a few hundredths of a second on two cores.
constexpr std::uint32_t followedTexels = 100, followedPhotons = 4000;
/// All may have to be sent again within a few frames.
constexpr std::uint64_t followedCausticPhotons = 20000;

/// What was asked for, or what the size of the picture tells.
GlobalIlluminationPictureRequest sizedRequest(const PictureOptions& options, const ShadedScene& shaded) {
  GlobalIlluminationPictureRequest request = options.globalIllumination;
  request.width = shaded.render.width;
  request.height = shaded.render.height;
  return request;
}

/// What lights a picture with all light: an even sky where nothing else gives light.
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

Device openDevice(Session& session, const PictureOptions& options) {
  DeviceOptions deviceOptions = session.deviceOptions();
  options.bake.addTo(deviceOptions);
  return session.times().measure("device", [&] { return Device::open(deviceOptions); });
}

}  // namespace

GlobalIllumination drawnGlobalIllumination(Session& session, const PictureOptions& options,
                                           const ShadedScene& shaded) {
  requireTriangles(shaded.loaded);
  const Device device = openDevice(session, options);
  const PictureLights lights = pictureLights(shaded);
  const LitScene lit{shaded.loaded.compiled, shaded.loaded.scene.images, lights.lights,
                     lights.sky ? &*lights.sky : nullptr, shaded.render.skyRotation};
  const GlobalIlluminationPictureRequest sized = sizedRequest(options, shaded);
  GlobalIlluminationRequest request;
  request.indirect.photons = options.globalIllumination.indirect.photons;
  request.indirect.rays = options.globalIllumination.indirect.rays;
  request.indirect.seed = options.bake.request.seed;
  request.indirect.directByPhotons = true;  // as frames that go on from here, see LiveLight
  request.causticPhotons = sized.photonsOfCaustics();
  GlobalIllumination light = session.times().measure("light", [&] {
    return computeGlobalIllumination(shaded.loaded.scene, lit, request, sized.mapTexels(), device,
                                     session.progress());
  });
  session.progress().clear();
  return light;
}

CompiledScene followUnderLights(Session& session, const PictureOptions& options, const ShadedScene& shaded,
                                FollowedScene& followed) {
  requireTriangles(shaded.loaded);
  followed.device.emplace(openDevice(session, options));
  PictureLights lights = pictureLights(shaded);
  followed.sky = std::move(lights.sky);
  CompiledScene compiled = shaded.loaded.compiled;
  compiled.lights = std::move(lights.lights);
  return compiled;
}

std::unique_ptr<FollowingLight> followingLight(Session& session, const PictureOptions& options,
                                               const ShadedScene& shaded) {
  auto following = std::make_unique<FollowingLight>();
  CompiledScene compiled = followUnderLights(session, options, shaded, *following);
  const GlobalIlluminationPictureRequest sized = sizedRequest(options, shaded);
  LiveLightOptions live;
  live.photons = options.globalIllumination.indirect.photons;
  live.texels = sized.mapTexels();
  live.gather.rays = options.globalIllumination.indirect.rays;
  live.gather.texelsPerFrame = followedTexels;
  live.photonsPerFrame = followedPhotons;
  live.causticPhotons = std::min(sized.photonsOfCaustics(), followedCausticPhotons);
  live.seed = options.bake.request.seed;
  live.thinBeyond = options.thinBeyond;
  live.eye = glm::dvec3(
      viewer::chooseCamera(shaded.loaded.scene, shaded.loaded.compiled, shaded.render.camera).world[3]);
  session.times().measure("light", [&] {
    following->light.emplace(shaded.loaded.scene, std::move(compiled),
                             following->sky ? &*following->sky : nullptr, shaded.render.skyRotation, live,
                             std::span<const int>(), *following->device, session.progress());
  });
  session.progress().clear();
  return following;
}

}  // namespace prelight::cli
