#include "cli/picture_options.h"

#include <fmt/format.h>

#include <glm/glm.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "cli/bake_options.h"
#include "cli/encoding_option.h"
#include "cli/global_illumination_picture.h"
#include "cli/light_option.h"
#include "cli/object_option.h"
#include "cli/occluder_options.h"
#include "cli/output_file.h"
#include "cli/report.h"
#include "cli/scene_options.h"
#include "cli/screen_occlusion_options.h"
#include "cli/sky_option.h"
#include "cli/values.h"
#include "cli/virtual_light_options.h"
#include "viewer/options/group_option.h"

namespace prelight::cli {
namespace {

using pictures::ObjectLighting;
using pictures::ObjectShadows;

constexpr int defaultHeight = 720;
constexpr std::uint64_t maxCameraIndex = 1u << 20;
constexpr std::uint64_t maxHaarTerms = 6 * 128 * 128;
constexpr std::uint64_t maxCausticPhotons = 100'000'000;

void addOcclusionOptions(CLI::App& app, PictureOptions& options) {
  app.add_option_function<std::string>(
         "--ao-correction",
         [&](const std::string& name) {
           options.render.aoCorrection = chooseNamed<viewer::AoCorrection, 3>(
               "--ao-correction", name,
               {{{"none", viewer::AoCorrection::None},
                 {"interreflection", viewer::AoCorrection::Interreflection},
                 {"cubic", viewer::AoCorrection::Cubic}}});
         },
         "ao and screen shading: none, interreflection, the light that creases reflect into themselves, or "
         "cubic, an estimate of it fitted to traced scenes")
      ->type_name("NAME");
  app.add_option_function<std::string>(
         "--ao-filter",
         [&](const std::string& name) {
           options.render.aoFilter = chooseNamed<viewer::AoFilter, 2>(
               "--ao-filter", name,
               {{{"cone", viewer::AoFilter::Cone}, {"cosine", viewer::AoFilter::Cosine}}});
         },
         "ao and screen shading: average the sky over the cone about the bent normal that has this "
         "accessibility (cone, the default) or over the whole cosine lobe (cosine)")
      ->type_name("NAME");
}

void addShadingOptions(CLI::App& app, PictureOptions& options) {
  std::string shadings;
  for (const viewer::ShadingInfo& info : viewer::shadings())
    shadings += fmt::format("{} ({}), ", info.name(), info.summary);
  app.add_option_function<std::string>(
         "--shading", [&options](const std::string& name) { options.shading = viewer::parseShading(name); },
         shadings + "default: the best one for which the file holds data")
      ->type_name("NAME");
  app.add_option_function<std::vector<std::string>>(
         "--group",
         [&](const std::vector<std::string>& texts) {
           for (const std::string& text : texts)
             options.render.groups.push_back(viewer::parseGroupFactor(text));
         },
         "lights shading, and radiosity in a window: a factor for a light group's colour, NAME=S or "
         "NAME=R,G,B; repeat it for more groups")
      ->type_name("GROUP")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  addWholeNumber(
      app, "--haar-terms", {1, maxHaarTerms},
      [&](std::uint64_t n) { options.render.haarTerms = static_cast<std::size_t>(n); },
      "haar shading: number of light coefficients to keep, the most important ones, with values that make up "
      "for the others (default: all)");
  addOcclusionOptions(app, options);
  addRealNumber(
      app, "--horizon-softness", {0.0, 45.0},
      [&](double degrees) { options.render.horizonSoftness = degrees * std::numbers::pi / 180.0; },
      fmt::format("horizons shading: half the angle that the shadows of lamps without a size assume, in "
                  "degrees (default {:.0f}; 0: hard shadows)",
                  viewer::defaultHorizonSoftness * 180.0 / std::numbers::pi))
      ->type_name("DEG");
  app.add_option_function<std::string>(
         "--lobe",
         [&](const std::string& name) {
           options.render.lobe = chooseNamed<viewer::Lobe, 2>(
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
      app, "--camera", {0, maxCameraIndex},
      [&](std::uint64_t n) { options.render.camera = static_cast<int>(n); },
      "camera of the file, counted from 0 (default: the first, or one that frames the scene)");
  options.height = defaultHeight;
  addPictureSize(
      app, "--size",
      [&](PictureSize size) {
        options.width = size.width;
        options.height = size.height;
      },
      fmt::format("pixels; one number is the height (default {})", defaultHeight));
  addSkyOption(app, options.environment, "sky");
  addExposureOption(app, options.exposure);
  addRealNumber(
      app, "--rotate-env", {-360.0, 360.0},
      [&](double degrees) { options.render.skyRotation = glm::radians(degrees); },
      "turn the sky by this many degrees, counter-clockwise seen from above")
      ->type_name("DEG");
  addLightOption(app, options.render.lights);
  addWholeNumber(
      app, "--caustics", {1, maxCausticPhotons}, [&](std::uint64_t n) { options.causticPhotons = n; },
      "add the light that mirrors and glass focus, from this many photons sent towards them");
  addObjectOption(app, options.inVolume.objects,
                  "put another glTF file into the scene, lit in sh, lights and phong shading");
  addNamed<ObjectLighting, 3>(
      app, "--object-light",
      {{{"auto", ObjectLighting::Auto}, {"volume", ObjectLighting::Volume}, {"cube", ObjectLighting::Cube}}},
      [&](ObjectLighting lighting) { options.inVolume.lighting = lighting; },
      "source of light for objects: volume, the one in the file; cube, cube maps of the lit scene, drawn at "
      "the objects' places; auto (default), the volume if there is one, else cube maps");
  addNamed<ObjectShadows, 3>(
      app, "--object-shadow",
      {{{"rays", ObjectShadows::Rays},
        {"vo", ObjectShadows::Occluders},
        {"neighbourhood", ObjectShadows::Neighbourhood}}},
      [&](ObjectShadows shadows) { options.inVolume.shadows = shadows; },
      "how objects cast shadows on the scene: rays (default); vo, as vector occluders, blurred but in a "
      "fraction of the time; neighbourhood, by matrices around them that hold how they hide and reflect the "
      "sky, with shadows of lamps as for vo");
  app.add_flag(
      "--probes", options.inVolume.probes,
      "draw a ball in every cell of the volume that is not inside an object, with the light of that cell");
  addGlobalIlluminationOptions(app, options.globalIllumination);
  addOccluderOptions(app, options.render.occluders);
  addScreenOcclusionOptions(app, options.render.screenOcclusion);
  addVirtualLightOptions(app, options.virtualLights);
  addTechniqueOptions(app, options.bake);
  addEffortOptions(app, options.bake);
  addKernelOptions(app, options.bake);
}

void checkPictureOutputs(const PictureOptions& options, const char* option,
                         const std::filesystem::path& output) {
  if (!output.empty()) checkOutputFile(option, output, {".exr", ".png"});
  if (!options.bake.dumpKernels.empty()) checkOutputFolder("--dump-kernels", options.bake.dumpKernels);
}

nlohmann::ordered_json drawnReport(Session& session, const PictureOptions& options,
                                   const std::filesystem::path& output, const pictures::ShadedScene& shaded,
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

}  // namespace prelight::cli
