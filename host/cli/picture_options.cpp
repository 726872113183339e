#include "cli/picture_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <numbers>
#include <utility>

#include "cli/drawn_global_illumination.h"
#include "cli/encoding_option.h"
#include "cli/global_illumination_picture.h"
#include "cli/light_options.h"
#include "cli/occluder_options.h"
#include "cli/output_file.h"
#include "cli/recorded_sky.h"
#include "cli/report.h"
#include "cli/scene_options.h"
#include "cli/screen_occlusion_options.h"
#include "cli/stale_bake.h"
#include "compress/compressed_parts.h"
#include "compress/compression_error.h"
#include "io/baked_file.h"
#include "io/baked_sky.h"
#include "scene/vertex_surface.h"
#include "viewer/camera.h"

namespace prelight::cli {
namespace {

constexpr int defaultHeight = 720;
constexpr std::uint64_t maxCameraIndex = 1u << 20;
constexpr std::uint64_t maxHaarTerms = 6 * 128 * 128;
constexpr std::uint64_t maxCausticPhotons = 100'000'000;
constexpr int shadingBounces = 1;

/// What must be baked for `shading`: with `everyShading` also what ao and sh need and what else is asked for.
std::vector<viewer::Shading> missingShadings(const BakeRequest& asked, const Bake& bake,
                                             viewer::Shading shading, bool everyShading) {
  std::vector<viewer::Shading> missing;
  for (const viewer::ShadingInfo& info : viewer::shadings()) {
    const bool usual = info.shading == viewer::Shading::Ao || info.shading == viewer::Shading::Sh;
    const bool wanted = info.shading == shading || (everyShading && (usual || info.askedBy(asked)));
    if (wanted && !info.carriedBy(bake)) missing.push_back(info.shading);
  }
  return missing;
}

/// The request that makes what shadings need: as asked where they are asked for, by default where not.
BakeRequest requestFor(const std::vector<viewer::Shading>& missing, const BakeRequest& asked) {
  BakeRequest request = asked.withoutTechniques();
  bool light = false;
  bool lightAsked = false;
  for (const viewer::Shading shading : missing) {
    const viewer::ShadingInfo& info = viewer::infoOf(shading);
    info.addTo(request, asked);
    const bool bounces = shading != viewer::Shading::Ao && shading != viewer::Shading::Cones &&
                         shading != viewer::Shading::Horizons && shading != viewer::Shading::Vo &&
                         shading != viewer::Shading::Radiosity && shading != viewer::Shading::LightMap;
    light = light || bounces;
    lightAsked = lightAsked || (bounces && info.askedBy(asked));
  }
  if (request.sh.order > 0) request.chartTransfer.size = asked.chartTransfer.size;
  if (request.sh.order > 0 || request.ch.order > 0) request.nearLamps = asked.nearLamps;
  if (!light) {
    request.bounces = 0;
  } else if (!lightAsked && request.bounces == 0) {
    request.bounces = shadingBounces;
  }
  return request;
}

/// Whether a bake holds light that its scene had then, whatever gives light now.
bool carriesStaticLight(const Bake& bake) {
  return bake.irradiance || bake.lightMap || bake.lightGroups || !bake.encodedLight.empty();
}

/// Moves what a bake has into another.
void mergeBake(Bake& into, Bake&& from) {
  if (!from.ao.empty()) {
    into.ao = std::move(from.ao);
    into.bentNormals = std::move(from.bentNormals);
    into.apertures = std::move(from.apertures);
  }
  const auto take = [](auto& to, auto& part) {
    if (part) to = std::move(part);
  };
  take(into.horizons, from.horizons);
  take(into.sh, from.sh);
  take(into.ch, from.ch);
  take(into.nearLamps, from.nearLamps);
  take(into.haar, from.haar);
  take(into.glossy, from.glossy);
  take(into.lightGroups, from.lightGroups);
  take(into.chartTransfer, from.chartTransfer);
  take(into.occluders, from.occluders);
  take(into.irradiance, from.irradiance);
  take(into.lightMap, from.lightMap);
  if (!from.encodedLight.empty()) into.encodedLight = std::move(from.encodedLight);
  if (!from.through) return;
  if (!into.through) into.through.emplace();
  if (!from.through->ao.empty()) into.through->ao = std::move(from.through->ao);
  take(into.through->sh, from.through->sh);
  take(into.through->ch, from.through->ch);
  take(into.through->haar, from.through->haar);
}

/// Radiosity and light maps are baked under the light of the picture.
BakeRun bakeUnderLights(Session& session, const PictureOptions& options, const DeviceOptions& device,
                        ShadedScene& shaded) {
  if (!shaded.request.radiosity && !shaded.request.lightMap)
    return session.bake(shaded.loaded, shaded.request, device);
  RadiosityRequest& shape = shaded.request.radiosity;
  if (shaded.environment) shape.environment = std::make_shared<const Environment>(*shaded.environment);
  shape.skyRotation = shaded.render.skyRotation;
  if (!options.lights) return session.bake(shaded.loaded, shaded.request, device);
  std::vector<Light>& lights = shaded.loaded.compiled.lights;
  const std::vector<Light> own = std::exchange(lights, *options.lights);
  BakeRun run = session.bake(shaded.loaded, shaded.request, device);
  lights = own;
  return run;
}

void bakeMissing(Session& session, const PictureOptions& options, bool everyShading, ShadedScene& shaded) {
  const viewer::Shading shading = shaded.render.shading;
  const BakeRequest& asked = options.bake.request;
  if (viewer::showsAllLight(shading)) return;
  if (viewer::infoOf(shading).carriedBy(shaded.bake)) {
    if (options.bake.techniqueGiven() && !viewer::infoOf(shading).bakeOption.empty())
      session.warn(fmt::format(
          "{}: the file carries what the shading needs, which is used as it is (bake it anew with "
          "prelight bake)",
          techniqueText(asked)));
    return;
  }
  requireTriangles(shaded.loaded);
  shaded.request = requestFor(missingShadings(asked, shaded.bake, shading, everyShading), asked);
  if (shaded.encoding != nullptr) askForEncoding(*shaded.encoding, shaded.request);
  session.console().note(
      fmt::format("{} carries no bake for --shading {}: baking {} now (prelight bake keeps it)",
                  options.scene.string(), viewer::shadingName(shading), techniqueText(shaded.request)));
  DeviceOptions device = session.deviceOptions();
  options.bake.addTo(device);
  shaded.run = bakeUnderLights(session, options, device, shaded);
  for (const std::string& warning : shaded.run->report.warnings) session.warn(warning);
  mergeBake(shaded.bake, std::move(shaded.run->bake));
  if (options.bake.compression && shaded.request.sh.order > 0) {
    session.times().measure("compress", [&] {
      const std::vector<double> surface = surfaceOfVertices(shaded.loaded.compiled);
      shaded.bake.compressedSh = compress(*shaded.bake.sh, *options.bake.compression, surface);
      compressParts(*options.bake.compression, surface, shaded.bake);
    });
    shaded.bake.sh.reset();
  }
}

/// What is followed or baked under the lights of a picture knows neither area lights nor cookies.
void checkAreaLights(const PictureOptions& options, viewer::Shading shading, bool everyShading,
                     const Bake& bake) {
  if (!anyDrawnOnly(options.lights)) return;
  const bool baked = (shading == viewer::Shading::Radiosity || shading == viewer::Shading::LightMap) &&
                     !viewer::infoOf(shading).carriedBy(bake);
  const bool followed =
      everyShading && (viewer::showsAllLight(shading) || shading == viewer::Shading::Radiosity);
  if (baked || followed)
    throw UsageError(fmt::format("--shading {}", viewer::shadingName(shading)),
                     fmt::format("{} takes no area lights and cookies",
                                 followed ? "a window in this shading" : "its bake"),
                     "give an emissive surface to the scene, or choose another shading");
  if (options.causticPhotons > 0)
    throw UsageError("--caustics", "photons of pictures leave neither area lights nor cookies",
                     "give an emissive surface to the scene, or leave one of the two out");
}

/// The shading of objects among a bake: its own lights where the volume, if it lights them, holds them.
viewer::Shading shadingAmong(const VolumeObjectOptions& objects, const Bake& bake) {
  const bool byVolume = objects.lighting != ObjectLighting::Cube && bake.volume;
  const bool lights = bake.lightGroups && (byVolume ? bake.volume->groups() > 0 : !objects.probes);
  return lights ? viewer::Shading::Lights : viewer::Shading::Sh;
}

void placeInVolume(Session& session, const PictureOptions& options, ShadedScene& shaded) {
  if (!options.inVolume.any()) return;
  const viewer::Shading shading = shaded.render.shading;
  if (shading != viewer::Shading::Sh && shading != viewer::Shading::Lights &&
      shading != viewer::Shading::Phong)
    throw UsageError(fmt::format("--shading {}", viewer::shadingName(shading)),
                     "objects and probes are lit in sh, lights and phong shading alone",
                     "leave --object and --probes out, or add --shading sh");
  if (shading == viewer::Shading::Lights && options.inVolume.lighting != ObjectLighting::Cube &&
      shaded.bake.volume && shaded.bake.volume->groups() == 0)
    throw InputError(options.scene.string(), "its volume holds no light of light groups",
                     "bake it with --light-groups --bounces 4 --volume 32, or add --shading sh or "
                     "--object-light cube");
  DeviceOptions device = session.deviceOptions();
  options.bake.addTo(device);
  VolumeObjectOptions inVolume = options.inVolume;
  const bool fromBake = shading != viewer::Shading::Phong || inVolume.probes;
  if (inVolume.lighting == ObjectLighting::Auto && !fromBake) inVolume.lighting = ObjectLighting::Cube;
  shaded.objects = std::make_unique<VolumeObjects>(session, inVolume, options.bake.request.lightGroups.named,
                                                   device, shaded.loaded, shaded.bake);
}

/// Wavelets and matrices are relit on the device; where there is none, or none that works, the host does it.
/// Fields of occlusion are cast on it.
void openRelightingDevice(Session& session, const PictureOptions& options, bool everyShading,
                          ShadedScene& shaded) {
  const viewer::Shading shading = shaded.render.shading;
  const bool now = shading == viewer::Shading::Haar || shading == viewer::Shading::Glossy;
  const bool later = everyShading && (shaded.bake.haar || shaded.bake.glossy);
  const bool casts = shading == viewer::Shading::Screen &&
                     shaded.render.screenOcclusion.method == viewer::OcclusionMethod::Fields;
  if (!now && !later && !casts) return;
  DeviceOptions device = session.deviceOptions();
  options.bake.addTo(device);
  try {
    shaded.device = session.times().measure("device", [&] { return Device::open(device); });
  } catch (const Error& error) {
    if (device.selector || casts) throw;
    session.console().note(fmt::format("relighting on the host: {}", error.what()));
  }
}

void checkShadingOptions(Session& session, const PictureOptions& options, bool window,
                         const ShadedScene& shaded) {
  const viewer::Shading shading = shaded.render.shading;
  const auto unused = [&](bool given, const char* option, std::initializer_list<viewer::Shading> needed) {
    if (!given || std::count(needed.begin(), needed.end(), shading) > 0) return;
    std::vector<std::string_view> names;
    for (const viewer::Shading one : needed) names.push_back(viewer::shadingName(one));
    session.warn(fmt::format("{} has a meaning in {} shading only, and this is {}", option,
                             fmt::join(names, " and "), viewer::shadingName(shading)));
  };
  const bool dims = window && shading == viewer::Shading::Radiosity && !shaded.bake.lightGroups;
  unused(!options.groups.empty() && !dims, "--group", {viewer::Shading::Lights});
  unused(options.haarTerms > 0, "--haar-terms", {viewer::Shading::Haar});
  unused(options.aoCorrection != viewer::AoCorrection::None, "--ao-correction",
         {viewer::Shading::Ao, viewer::Shading::Screen});
  unused(options.aoFilter != viewer::AoFilter::Cone, "--ao-filter",
         {viewer::Shading::Ao, viewer::Shading::Screen});
  unused(options.horizonSoftness != viewer::defaultHorizonSoftness, "--horizon-softness",
         {viewer::Shading::Horizons});
  unused(options.screenOcclusion != viewer::ScreenOcclusionOptions{}, "an option of screen-space occlusion",
         {viewer::Shading::Screen});
  unused(options.virtualLights != VirtualLightOptions{}, "an option of instant radiosity",
         {viewer::Shading::Instant});
  unused(options.occluders != viewer::OccluderOptions{}, "an option of vector occluders",
         {viewer::Shading::Vo});
  unused(options.lobe != viewer::Lobe::Ggx, "--lobe", {viewer::Shading::Glossy, viewer::Shading::Phong});
  // warnOfOtherSky() compares --env with the sky that a file records.
  const bool sky = !options.environment.empty() && !readBakedSky(shaded.loaded.document);
  if (viewer::showsBakedLight(shading) && !shaded.run && (options.lights || sky))
    session.warn(
        "--light, --env: the irradiance that the file carries is of the lights that it was baked with");
  if (shading == viewer::Shading::Lights && options.lights)
    session.warn(
        "--light: in lights shading only metals reflect such lights; use --group for the scene's own");
  if (shaded.bake.lightGroups)
    viewer::groupFactors(viewer::namesOf(*shaded.bake.lightGroups), options.groups);
}

void addOcclusionOptions(CLI::App& app, PictureOptions& options) {
  app.add_option_function<std::string>(
         "--ao-correction",
         [&](const std::string& name) {
           options.aoCorrection = chooseNamed<viewer::AoCorrection, 3>(
               "--ao-correction", name,
               {{{"none", viewer::AoCorrection::None},
                 {"interreflection", viewer::AoCorrection::Interreflection},
                 {"cubic", viewer::AoCorrection::Cubic}}});
         },
         "ao and screen shading: none, interreflection, the light that creases reflect into themselves, or "
         "cubic, a fit of it to traced scenes")
      ->type_name("NAME");
  app.add_option_function<std::string>(
         "--ao-filter",
         [&](const std::string& name) {
           options.aoFilter = chooseNamed<viewer::AoFilter, 2>(
               "--ao-filter", name,
               {{{"cone", viewer::AoFilter::Cone}, {"cosine", viewer::AoFilter::Cosine}}});
         },
         "ao and screen shading: the sky is averaged over the cone about the bent normal that lets through "
         "the accessibility (cone, the default) or over all of the cosine (cosine)")
      ->type_name("NAME");
}

void addShadingOptions(CLI::App& app, PictureOptions& options) {
  std::string shadings;
  for (const viewer::ShadingInfo& info : viewer::shadings())
    shadings += fmt::format("{} ({}), ", info.name, info.summary);
  app.add_option_function<std::string>(
         "--shading", [&options](const std::string& name) { options.shading = viewer::parseShading(name); },
         shadings + "default: the best that the file carries")
      ->type_name("NAME");
  app.add_option_function<std::vector<std::string>>(
         "--group",
         [&](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) options.groups.push_back(viewer::parseGroupFactor(text));
         },
         "lights shading, and radiosity in a window: a factor of a light group's colour, NAME=S or "
         "NAME=R,G,B; repeat it for more")
      ->type_name("GROUP")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  addWholeNumber(
      app, "--haar-terms", {1, maxHaarTerms},
      [&](std::uint64_t n) { options.haarTerms = static_cast<std::size_t>(n); },
      "haar shading: coefficients that the light keeps, the most important ones, their values fitted to make "
      "up for the others (default: all)");
  addOcclusionOptions(app, options);
  addRealNumber(
      app, "--horizon-softness", {0.0, 45.0},
      [&](double degrees) { options.horizonSoftness = degrees * std::numbers::pi / 180.0; },
      fmt::format("horizons shading: half the angle that lamps without a size have for shadows, degrees "
                  "(default {:.0f}; 0: hard shadows)",
                  viewer::defaultHorizonSoftness * 180.0 / std::numbers::pi))
      ->type_name("DEG");
  app.add_option_function<std::string>(
         "--lobe",
         [&](const std::string& name) {
           options.lobe = chooseNamed<viewer::Lobe, 2>(
               "--lobe", name, {{{"ggx", viewer::Lobe::Ggx}, {"phong", viewer::Lobe::Phong}}});
         },
         "glossy and phong shading: ggx (default) or phong, a power of the cosine")
      ->type_name("NAME");
  addEncodingOption(app, options.encoding);
}

}  // namespace

void addPictureOptions(CLI::App& app, PictureOptions& options) {
  app.add_option("SCENE", options.scene, "glTF file, baked or not (.gltf or .glb)")
      ->required()
      ->type_name("");
  addSceneOptions(app, options.load);
  addShadingOptions(app, options);
  addWholeNumber(
      app, "--camera", {0, maxCameraIndex}, [&](std::uint64_t n) { options.camera = static_cast<int>(n); },
      "camera of the file, counted from 0 (default: the first, or one that frames the scene)");
  options.size.height = defaultHeight;
  addPictureSize(
      app, "--size", [&](PictureSize size) { options.size = size; },
      fmt::format("pixels; one number is the height (default {})", defaultHeight));
  addSkyOption(app, options.environment, "sky");
  addExposureOption(app, options.exposure);
  addRealNumber(
      app, "--rotate-env", {-360.0, 360.0}, [&](double degrees) { options.skyRotationDegrees = degrees; },
      "turn the sky by this many degrees, counter-clockwise seen from above")
      ->type_name("DEG");
  addLightOption(app, options.lights);
  addWholeNumber(
      app, "--caustics", {1, maxCausticPhotons}, [&](std::uint64_t n) { options.causticPhotons = n; },
      "add the light that mirrors and glass focus, by this many photons towards them");
  addObjectOption(app, options.inVolume.objects,
                  "put another glTF file into the scene, lit in sh, lights and phong shading");
  addNamed<ObjectLighting, 3>(
      app, "--object-light",
      {{{"auto", ObjectLighting::Auto}, {"volume", ObjectLighting::Volume}, {"cube", ObjectLighting::Cube}}},
      [&](ObjectLighting lighting) { options.inVolume.lighting = lighting; },
      "what lights objects: volume, the file's; cube, cube maps of the lit scene, drawn where they stand; "
      "auto "
      "(default): the volume where there is one, else cube maps");
  addNamed<ObjectShadows, 3>(
      app, "--object-shadow",
      {{{"rays", ObjectShadows::Rays},
        {"vo", ObjectShadows::Occluders},
        {"neighbourhood", ObjectShadows::Neighbourhood}}},
      [&](ObjectShadows shadows) { options.inVolume.shadows = shadows; },
      "how objects shade the scene: rays (default); vo, as vector occluders: blurred, in a fraction of the "
      "time; neighbourhood, by matrices around them that hold what they hide and send of the sky, lamps as "
      "vo");
  app.add_flag(
      "--probes", options.inVolume.probes,
      "draw a ball in every cell of the volume that is not inside an object, lit by what the cell holds");
  addGlobalIlluminationOptions(app, options.globalIllumination);
  addOccluderOptions(app, options.occluders);
  addScreenOcclusionOptions(app, options.screenOcclusion);
  addVirtualLightOptions(app, options.virtualLights);
  addTechniqueOptions(app, options.bake);
  addEffortOptions(app, options.bake);
  addKernelOptions(app, options.bake);
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
          objects ? objects->cubeOpenness() : std::span<const glm::vec3>()};
}

viewer::PoseSources ShadedScene::poseSources(const PoseOptions& pose) const {
  viewer::PoseSources sources;
  if (motion.keys) sources.keys = &*motion.keys;
  sources.occluders = motion.occluders.get();
  if (!pose.moves.empty()) sources.moves = [&pose](Scene& scene) { moveNodes(scene, pose.moves); };
  return sources;
}

nlohmann::ordered_json drawnReport(Session& session, const PictureOptions& options,
                                   const std::filesystem::path& output, const ShadedScene& shaded,
                                   const Warnings& notes) {
  return reportOf("render", {{"scene", options.scene.string()},
                             {"output", output.string()},
                             {"shading", viewer::shadingName(shaded.render.shading)},
                             {"width", shaded.render.width},
                             {"height", shaded.render.height},
                             {"seconds", session.times().total()},
                             {"stages", toJson(session.times())},
                             {"notes", notes},
                             {"warnings", session.warnings()}});
}

Bake carriedBake(Session& session, const LoadedScene& loaded) {
  std::optional<Bake> bake =
      session.times().measure("read bake", [&] { return readBake(loaded.document, loaded.compiled); });
  if (bake) warnOfStaleBake(session, loaded, *bake);
  return std::move(bake).value_or(Bake{});
}

ShadedScene prepareScene(Session& session, const PictureOptions& options, bool everyShading,
                         const std::function<void()>& checkOutputs) {
  ShadedScene shaded;
  shaded.loaded = session.load(options.scene, options.load);
  shaded.bake = carriedBake(session, shaded.loaded);
  shaded.motion = poseScene(session, options.pose, shaded.loaded, shaded.bake);
  PictureSky sky = choosePictureSky(session, options.environment, options.lights.has_value(),
                                    carriesStaticLight(shaded.bake), shaded.loaded, options.camera);
  shaded.environment = std::move(sky.map);
  shaded.studio = sky.studio;
  if (sky.studio && !options.camera)
    setUpStudio(session, shaded.loaded, options.size.width, options.size.height);
  checkOutputs();
  if (!options.bake.dumpKernels.empty()) checkOutputFolder("--dump-kernels", options.bake.dumpKernels);

  viewer::RenderOptions& render = shaded.render;
  render.shading =
      options.shading.value_or(options.inVolume.any()        ? shadingAmong(options.inVolume, shaded.bake)
                               : options.encoding != nullptr ? viewer::Shading::LightMap
                                                             : viewer::carriedShading(shaded.bake));
  checkAreaLights(options, render.shading, everyShading, shaded.bake);
  shaded.encoding = options.encoding;
  checkEncoding(options.scene, shaded.bake, render.shading, shaded.encoding);
  render.height = options.size.height;
  const Camera camera = viewer::chooseCamera(shaded.loaded.scene, shaded.loaded.compiled, options.camera);
  render.width = options.size.width.value_or(pictureWidth(camera, options.size.height));
  render.camera = options.camera;
  render.skyRotation = options.skyRotationDegrees * std::numbers::pi / 180.0 + sky.rotation;
  if (shaded.environment && viewer::showsBakedLight(render.shading))
    warnOfOtherSky(session, shaded.loaded, *shaded.environment, render.skyRotation);
  render.lights = options.lights;
  if (viewer::showsAllLight(render.shading) && makeSurfaces(render.lights, shaded.loaded))
    shaded.bake = {};  // of the scene without them
  render.groups = options.groups;
  render.haarTerms = options.haarTerms;
  render.occluders = options.occluders;
  render.aoCorrection = options.aoCorrection;
  render.aoFilter = options.aoFilter;
  render.horizonSoftness = options.horizonSoftness;
  render.screenOcclusion = options.screenOcclusion;
  render.lobe = options.lobe;
  bakeMissing(session, options, everyShading, shaded);
  checkShadingOptions(session, options, everyShading, shaded);
  placeInVolume(session, options, shaded);
  openRelightingDevice(session, options, everyShading, shaded);
  if (render.shading == viewer::Shading::GlobalIllumination && everyShading) {
    shaded.following = followingLight(session, options, shaded);
    shaded.globalIllumination = illuminationOf(*shaded.following->light);
  } else if (render.shading == viewer::Shading::GlobalIllumination) {
    shaded.globalIllumination = drawnGlobalIllumination(session, options, shaded);
  } else if (render.shading == viewer::Shading::Instant) {
    shaded.virtualLights = virtualLights(session, options, shaded);
  }
  if (options.causticPhotons > 0) {
    DeviceOptions device = session.deviceOptions();
    options.bake.addTo(device);
    shaded.caustics =
        traceCaustics(session, shaded.loaded, render, shaded.environment ? &*shaded.environment : nullptr,
                      device, options.causticPhotons);
  }
  return shaded;
}

}  // namespace prelight::cli
