#include "pictures/traced_picture.h"

#include <utility>

#include "pictures/picture_lights.h"
#include "viewer/core/camera.h"

namespace prelight::pictures {
namespace {

/// Returns the punctual lights of a picture; its other lamps become surfaces of the scene. A neutral sky is
/// added where nothing else gives light, which is said.
std::vector<Light> placeLamps(DrawingSession& session, const PictureRequest& asked, LoadedScene& loaded,
                              PictureSky& sky) {
  std::optional<std::vector<Light>> given = asked.render.lights;
  makeSurfaces(given, loaded);
  requireTriangles(loaded);
  std::vector<Light> lights = given.value_or(loaded.scene.lights);
  if (!sky.map && makeLightTables(loaded.compiled, lights, nullptr, true).groupCount == 0) {
    sky.map = constantEnvironment(glm::vec3(1.0f));
    session.note("the scene has no light, nothing emissive and no sky: lit by a neutral sky of radiance 1");
  }
  return lights;
}

/// Multiplies the parts of a picture by their factors, and adds to the picture what that changes.
void weighParts(const viewer::LayerFactors& factors, std::span<PartPicture> parts, Picture& picture) {
  for (PartPicture& part : parts) {
    const float factor = viewer::factorOf(factors, part.part);
    if (factor == 1.0f) continue;
    for (std::size_t i = 0; i < part.pixels.size(); ++i) {
      picture.pixels[i] = glm::max(picture.pixels[i] + (factor - 1.0f) * part.pixels[i], 0.0f);
      part.pixels[i] *= factor;
    }
  }
}

}  // namespace

FullRequest fullRequest(const FullOptions& options) {
  FullRequest request;
  request.samples = options.samples;
  request.texels = options.texels;
  request.photonsBy = options.photonsBy;
  request.causticPhotons = options.causticPhotons;
  request.indirect.photons = options.photons;
  request.indirect.gather = options.gather;
  request.gatherRays = options.gatherRays;
  if (options.gatherRays) request.indirect.rays = *options.gatherRays;
  return request;
}

FullOptions fullOptions(const FullRequest& request) {
  return {.samples = request.samples,
          .photons = request.indirect.photons,
          .photonsBy = request.photonsBy,
          .causticPhotons = request.causticPhotons,
          .texels = request.texels,
          .gather = request.indirect.gather,
          .gatherRays = request.gatherRays};
}

std::shared_future<std::shared_ptr<const Device>> openAside(DrawingSession& session,
                                                            const PictureRequest& asked) {
  const DeviceOptions options = session.deviceOptions(asked.bake);
  return std::async(std::launch::async, [&session, options] { return session.openDevice(options); }).share();
}

LoadedScene loadForPicture(DrawingSession& session, const PictureRequest& asked) {
  LoadedScene loaded = session.load(asked.scene, asked.load);
  poseForPicture(session, asked.pose, loaded);
  return loaded;
}

void poseForPicture(DrawingSession& session, const PoseOptions& pose, LoadedScene& loaded) {
  Bake none;
  poseScene(session, pose, loaded, none);
}

PictureSetUp setUpPicture(DrawingSession& session, const PictureRequest& asked, LoadedScene& loaded) {
  PictureSky sky = skyOfPicture(session, asked, false, loaded);
  if (!asked.render.camera) frameScene(session, sky.studio, asked.width, asked.height, loaded);
  return {std::move(sky)};
}

TracedPlan planTracedPicture(DrawingSession& session, const PictureRequest& asked, LoadedScene& loaded,
                             PictureSetUp& setUp) {
  std::vector<Light> lights = placeLamps(session, asked, loaded, setUp.sky);
  TracedPlan plan{asked.full,
                  viewer::chooseCamera(loaded.scene, loaded.compiled, asked.render.camera),
                  {loaded.compiled, loaded.scene.images, std::move(lights),
                   setUp.sky.map ? &*setUp.sky.map : nullptr, asked.render.skyRotation + setUp.sky.rotation}};
  plan.request.height = asked.height;
  plan.request.width = asked.width.value_or(pictureWidth(plan.camera, asked.height));
  plan.request.seed = plan.request.indirect.seed = asked.bake.request.seed;
  return plan;
}

TracedPicture tracePicture(DrawingSession& session, const PictureRequest& asked, LoadedScene& loaded,
                           PictureSetUp& setUp, PictureDenoising& denoising,
                           const std::shared_future<std::shared_ptr<const Device>>& opening) {
  const TracedPlan plan = planTracedPicture(session, asked, loaded, setUp);
  TracedPicture made;
  made.camera = plan.camera;
  made.lights = plan.lit.lights;
  GlobalIlluminationPictureRequest& request = made.request = plan.request;
  request.guides = denoising.wanted();
  std::future<LitSurface> surface = std::async(std::launch::async, [&] {
    return layOutSurface(loaded.scene, loaded.compiled, request.mapTexels(loaded.compiled.triangleCount()));
  });
  session.measure("device", [&] { opening.wait(); });
  const Device& device = *opening.get();
  denoising.require();
  made.layered.picture = session.measure("render", [&] {
    return renderGlobalIllumination(plan.lit, plan.camera, request, std::move(surface), device,
                                    session.progress(), made.report);
  });
  denoising.apply(session, made.report.guides, DenoiseEffort::Quick, made.layered.picture);
  weighParts(asked.render.layers, made.report.parts, made.layered.picture);
  addLayers(made.report.parts, made.layered.layers);
  return made;
}

}  // namespace prelight::pictures
