#include "pictures/shaded_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/baked_file.h"
#include "pictures/drawn_encoding.h"
#include "pictures/missing_bake.h"
#include "pictures/picture_lights.h"
#include "pictures/picture_shading.h"
#include "pictures/picture_sky.h"
#include "pictures/recorded_sky.h"
#include "pictures/session/stale_bake.h"
#include "viewer/core/camera.h"

namespace prelight::pictures {
namespace {

/// Returns whether a bake holds light as it was then, which does not depend on the lights of now.
bool carriesStaticLight(const Bake& bake) {
  return bake.irradiance || bake.lightMap || bake.lightGroups || !bake.encodedLight.empty();
}

/// Returns the shading of objects among a bake: lights if the volume lights the objects and holds light
/// groups.
viewer::Shading shadingAmong(const ObjectOptions& objects, const Bake& bake) {
  const bool byVolume = objects.lighting != ObjectLighting::Cube && bake.volume;
  const bool lights = bake.lightGroups && (byVolume ? bake.volume->groups() > 0 : !objects.probes);
  return lights ? viewer::Shading::Lights : viewer::Shading::Sh;
}

void placeInVolume(DrawingSession& session, const PictureRequest& asked, ShadedScene& shaded) {
  if (!asked.objects.any()) return;
  const viewer::Shading shading = shaded.render.shading;
  if (!viewer::infoOf(shading).traits.objectsInCubes)
    throw UsageError(
        fmt::format("DrawRequest::shading {}", viewer::shadingName(shading)),
        "only sh, lights and phong shading light objects and probes",
        "leave ObjectOptions::objects and ObjectOptions::probes out, or add DrawRequest::shading sh");
  if (shading == viewer::Shading::Lights && asked.objects.lighting != ObjectLighting::Cube &&
      shaded.bake.volume && shaded.bake.volume->groups() == 0)
    throw InputError(asked.scene.string(), "its volume holds no light groups",
                     "bake it with BakeRequest::lightGroups BakeRequest::bounces 4 VolumeRequest::size 32, "
                     "or add DrawRequest::shading sh or ObjectOptions::lighting cube");
  const DeviceOptions device = session.deviceOptions(asked.bake);
  ObjectOptions objects = asked.objects;
  const bool fromBake = !viewer::infoOf(shading).bakeOption.empty() || objects.probes;
  if (objects.lighting == ObjectLighting::Auto && !fromBake) objects.lighting = ObjectLighting::Cube;
  shaded.objects = std::make_unique<VolumeObjects>(session, objects, asked.bake.request.lightGroups.named,
                                                   device, shaded.loaded, shaded.bake);
}

/// Opens the device that relights wavelets and matrices, which the host does if there is no working device.
/// Fields of occlusion are cast on it.
void openRelightingDevice(DrawingSession& session, const PictureRequest& asked, bool everyShading,
                          ShadedScene& shaded) {
  const viewer::Shading shading = shaded.render.shading;
  const bool now = viewer::infoOf(shading).traits.relitOnDevice;
  const auto relitLater = [&](const viewer::ShadingInfo& info) {
    return info.traits.relitOnDevice && info.carriedBy(shaded.bake);
  };
  const bool later = everyShading && std::ranges::any_of(viewer::shadings(), relitLater);
  const bool casts = viewer::infoOf(shading).rules.ambient == Ambient::Screen &&
                     shaded.render.screenOcclusion.method == viewer::OcclusionMethod::Fields;
  if (!now && !later && !casts) return;
  const DeviceOptions device = session.deviceOptions(asked.bake);
  try {
    shaded.device = session.measure("device", [&] { return session.openDevice(device); });
  } catch (const Error& error) {
    if (device.selector || casts) throw;
    session.note(fmt::format("relighting on the host: {}", error.what()));
  }
}

}  // namespace

std::vector<PlannedPass> ShadedScene::plan() const {
  return globalIllumination ? globalIllumination->plan : std::vector<PlannedPass>();
}

viewer::RenderInputs ShadedScene::inputs() const {
  return {loaded.scene,
          loaded.compiled,
          &bake,
          environment ? &*environment : nullptr,
          device ? &*device : nullptr,
          caustics ? &caustics->caustics : nullptr,
          globalIllumination ? &*globalIllumination : nullptr,
          true,
          encoding,
          nullptr,
          objects ? objects->probes() : std::nullopt,
          virtualLights ? &virtualLights->lights->lights() : nullptr,
          objects ? objects->cubeLit() : std::span<const VertexRange>(),
          objects ? objects->cubeOpenness() : std::span<const glm::vec3>(),
          following ? &*following->light : nullptr};
}

viewer::PoseSources ShadedScene::poseSources(const PoseOptions& pose) const {
  viewer::PoseSources sources;
  if (motion.keys) sources.keys = &*motion.keys;
  sources.occluders = motion.occluders.get();
  sources.bent = motion.bent.get();
  if (!pose.moves.empty()) sources.moves = [&pose](Scene& scene) { moveNodes(scene, pose.moves); };
  return sources;
}

Bake carriedBake(DrawingSession& session, const LoadedScene& loaded) {
  std::optional<Bake> bake =
      session.measure("read bake", [&] { return readBake(*loaded.document, loaded.compiled); });
  if (bake) warnOfStaleBake(session, loaded, *bake);
  return std::move(bake).value_or(Bake{});
}

ShadedScene prepareScene(DrawingSession& session, const PictureRequest& asked, bool everyShading,
                         const std::function<void()>& checkOutputs) {
  LoadedScene loaded = session.load(asked.scene, asked.load);
  Bake bake = carriedBake(session, loaded);
  refineAsAsked(session, asked, bake, loaded);
  return prepareScene(session, asked, std::move(loaded), std::move(bake), everyShading, checkOutputs);
}

ShadedScene prepareScene(DrawingSession& session, const PictureRequest& asked, LoadedScene loaded, Bake bake,
                         bool everyShading, const std::function<void()>& checkOutputs) {
  ShadedScene shaded;
  shaded.loaded = std::move(loaded);
  shaded.bake = std::move(bake);
  shaded.motion = poseScene(session, asked.pose, shaded.loaded, shaded.bake);
  PictureSky sky = skyOfPicture(session, asked, carriesStaticLight(shaded.bake), shaded.loaded);
  shaded.environment = std::move(sky.map);
  shaded.studio = sky.studio;
  if (!asked.render.camera) frameScene(session, sky.studio, asked.width, asked.height, shaded.loaded);
  checkOutputs();

  viewer::RenderOptions& render = shaded.render = asked.render;
  const viewer::LightOfPicture light =
      lightOfPicture(asked, shaded.loaded, shaded.environment ? &*shaded.environment : nullptr,
                     asked.render.skyRotation + sky.rotation);
  render.shading = asked.shading               ? *asked.shading
                   : asked.objects.any()       ? shadingAmong(asked.objects, shaded.bake)
                   : asked.encoding != nullptr ? viewer::Shading::LightMap
                   : !asked.render.groups.empty() && shaded.bake.lightGroups
                       ? viewer::Shading::Lights
                       : chooseShading(session, asked, everyShading, shaded.loaded, shaded.bake, light);
  checkAreaLights(asked, render.shading, everyShading, shaded.bake);
  shaded.encoding = asked.encoding;
  checkEncoding(asked.scene, shaded.bake, render.shading, shaded.encoding);
  render.height = asked.height;
  const Camera camera =
      viewer::chooseCamera(shaded.loaded.scene, shaded.loaded.compiled, asked.render.camera);
  render.width = asked.width.value_or(pictureWidth(camera, asked.height));
  render.skyRotation += sky.rotation;
  if (shaded.environment && viewer::showsBakedLight(render.shading))
    warnOfOtherSky(session, shaded.loaded, *shaded.environment, render.skyRotation);
  if (viewer::showsAllLight(render.shading) && makeSurfaces(render.lights, shaded.loaded))
    shaded.bake = {};  // it belongs to the scene without those surfaces
  bakeMissing(session, asked, everyShading, shaded);
  warnOfCoarseTriangles(session, asked, shaded);
  checkShadingOptions(session, asked, everyShading, shaded);
  placeInVolume(session, asked, shaded);
  openRelightingDevice(session, asked, everyShading, shaded);
  const bool follows = everyShading || render.debug.shown != viewer::DebugView::None;
  if (render.shading == viewer::Shading::GlobalIllumination && follows) {
    shaded.following = followingLight(session, asked, shaded);
    shaded.globalIllumination = illuminationOf(*shaded.following->light);
  } else if (render.shading == viewer::Shading::GlobalIllumination) {
    shaded.globalIllumination = drawnGlobalIllumination(session, asked, shaded);
  } else if (render.shading == viewer::Shading::Instant) {
    shaded.virtualLights = followingVirtualLights(session, asked, shaded);
  }
  if (asked.causticPhotons > 0)
    shaded.caustics =
        traceCaustics(session, shaded.loaded, render, shaded.environment ? &*shaded.environment : nullptr,
                      session.deviceOptions(asked.bake), asked.causticPhotons);
  return shaded;
}

}  // namespace prelight::pictures
