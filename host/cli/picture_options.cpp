#include "cli/picture_options.h"

#include <fmt/format.h>

#include <numbers>

#include "cli/output_file.h"
#include "io/baked_file.h"
#include "viewer/camera.h"
#include "viewer/light_option.h"

namespace prelight::cli {
namespace {

constexpr int defaultHeight = 720;
constexpr std::uint64_t maxCameraIndex = 1u << 20;

void readLight(std::optional<std::vector<Light>>& lights, const std::string& text) {
  if (!lights) lights.emplace();
  if (text != "none") lights->push_back(viewer::parseLight(text));
}

/// The best shading that needs no further bake.
viewer::Shading carriedShading(const Bake& bake) {
  if (bake.sh) return viewer::Shading::Sh;
  return bake.ao.empty() ? viewer::Shading::Phong : viewer::Shading::Ao;
}

bool carries(const Bake& bake, viewer::Shading shading) {
  switch (shading) {
    case viewer::Shading::Ao:
      return !bake.ao.empty() && !bake.bentNormals.empty();
    case viewer::Shading::Sh:
      return bake.sh.has_value();
    case viewer::Shading::Phong:
      break;
  }
  return true;
}

/// The request that makes what `shading` needs and `bake` lacks.
BakeRequest missingParts(const BakeRequest& asked, const Bake& bake, viewer::Shading shading,
                         bool everyShading) {
  BakeRequest defaults = asked;
  useDefaultTechniques(defaults);
  BakeRequest request = asked;
  const bool aoMissing = !carries(bake, viewer::Shading::Ao);
  const bool shMissing = !carries(bake, viewer::Shading::Sh);
  request.ao = aoMissing && (everyShading || shading == viewer::Shading::Ao);
  const bool bakeSh = shMissing && (everyShading || shading == viewer::Shading::Sh);
  request.shOrder = !bakeSh ? 0 : asked.shOrder > 0 ? asked.shOrder : defaults.shOrder;
  request.bounces = !bakeSh ? 0 : asked.shOrder > 0 ? asked.bounces : defaults.bounces;
  return request;
}

void bakeMissing(Session& session, const PictureOptions& options, bool everyShading, ShadedScene& shaded) {
  const viewer::Shading shading = shaded.render.shading;
  if (carries(shaded.bake, shading)) {
    if (options.bake.techniqueGiven() && shading != viewer::Shading::Phong)
      session.warn(
          "--ao, --sh: the file carries what the shading needs, which is used as it is (bake it anew with "
          "prelight bake)");
    return;
  }
  requireTriangles(shaded.loaded);
  shaded.request = missingParts(options.bake.request, shaded.bake, shading, everyShading);
  session.console().note(
      fmt::format("{} carries no bake for --shading {}: baking {} now (prelight bake keeps it)",
                  options.scene.string(), viewer::shadingName(shading), techniqueText(shaded.request)));
  DeviceOptions device = session.deviceOptions();
  options.bake.addTo(device);
  shaded.run = session.bake(shaded.loaded, shaded.request, device);
  if (shaded.request.ao) {
    shaded.bake.ao = std::move(shaded.run->bake.ao);
    shaded.bake.bentNormals = std::move(shaded.run->bake.bentNormals);
  }
  if (shaded.request.shOrder > 0) shaded.bake.sh = std::move(shaded.run->bake.sh);
}

}  // namespace

void addPictureOptions(CLI::App& app, PictureOptions& options) {
  app.add_option("SCENE", options.scene, "glTF file, baked or not (.gltf or .glb)")
      ->required()
      ->type_name("");
  app.add_option_function<std::string>(
         "--shading", [&](const std::string& name) { options.shading = viewer::parseShading(name); },
         "phong (no shadows), ao (ambient occlusion) or sh (baked transfer); default: the best that the file "
         "carries")
      ->type_name("NAME");
  addWholeNumber(
      app, "--camera", {0, maxCameraIndex}, [&](std::uint64_t n) { options.camera = static_cast<int>(n); },
      "camera of the file, counted from 0 (default: the first, or one that frames the scene)");
  options.size.height = defaultHeight;
  addPictureSize(
      app, "--size", [&](PictureSize size) { options.size = size; },
      fmt::format("pixels; one number is the height (default {})", defaultHeight));
  app.add_option("--env", options.environment, "sky: equirectangular .hdr or .exr")->type_name("MAP");
  addRealNumber(
      app, "--rotate-env", {-360.0, 360.0}, [&](double degrees) { options.skyRotationDegrees = degrees; },
      "turn the sky by this many degrees, counter-clockwise seen from above")
      ->type_name("DEG");
  app.add_option_function<std::vector<std::string>>(
         "--light",
         [&](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) readLight(options.lights, text);
         },
         "replaces the file's lights, once for each light: point:x,y,z:r,g,b, directional:dx,dy,dz:r,g,b, "
         "spot:x,y,z:dx,dy,dz:inner,outer:r,g,b or none")
      ->type_name("LIGHT")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  addTechniqueOptions(app, options.bake);
  addEffortOptions(app, options.bake);
  addKernelOptions(app, options.bake);
}

viewer::RenderInputs ShadedScene::inputs() const {
  return {loaded.scene, loaded.compiled, &bake, environment ? &*environment : nullptr};
}

Bake carriedBake(Session& session, const LoadedScene& loaded) {
  return session.times()
      .measure("read bake", [&] { return readBake(loaded.document, loaded.compiled); })
      .value_or(Bake{});
}

ShadedScene prepareScene(Session& session, const PictureOptions& options, bool everyShading,
                         const std::function<void()>& checkOutputs) {
  ShadedScene shaded;
  shaded.loaded = session.load(options.scene);
  shaded.bake = carriedBake(session, shaded.loaded);
  if (!options.environment.empty())
    shaded.environment = session.times().measure("sky", [&] { return readEnvironment(options.environment); });
  checkOutputs();
  if (!options.bake.dumpKernels.empty()) checkOutputFolder("--dump-kernels", options.bake.dumpKernels);

  viewer::RenderOptions& render = shaded.render;
  render.shading = options.shading.value_or(carriedShading(shaded.bake));
  render.height = options.size.height;
  const Camera camera = viewer::chooseCamera(shaded.loaded.scene, shaded.loaded.compiled, options.camera);
  render.width = options.size.width.value_or(viewer::pictureWidth(camera, options.size.height));
  render.camera = options.camera;
  render.skyRotation = options.skyRotationDegrees * std::numbers::pi / 180.0;
  render.lights = options.lights;
  bakeMissing(session, options, everyShading, shaded);
  return shaded;
}

}  // namespace prelight::cli
