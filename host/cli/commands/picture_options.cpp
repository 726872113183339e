#include "cli/commands/picture_options.h"

#include <fmt/format.h>

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "cli/options/bake_options.h"
#include "cli/options/encoding_option.h"
#include "cli/options/light_option.h"
#include "cli/options/object_option.h"
#include "cli/options/options.h"
#include "cli/options/scene_options.h"
#include "cli/options/sky_option.h"
#include "cli/options/values.h"
#include "cli/output_file.h"
#include "cli/report.h"
#include "viewer/options/group_option.h"
#include "viewer/options/part_option.h"
#include "viewer/options/shading_options.h"

namespace prelight::cli {
namespace {

constexpr int defaultHeight = 720;
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
  app.add_option_function<std::vector<std::string>>(
         "--part",
         [&](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) viewer::setPartFactor(text, options.render.layers);
         },
         "factor of a part of the light: NAME=S, of emitted, direct, indirect, caustic, reflected, baked "
         "(what a "
         "bake holds of direct and indirect light) or all; repeat it for more parts: --part all=0 --part "
         "caustic=1 "
         "shows caustics alone")
      ->type_name("PART")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  addEncodingOption(app, options.encoding);
}

}  // namespace

void addPictureOptions(CLI::App& app, PictureOptions& options) {
  app.add_option("SCENE", options.scene, "glTF file, baked or not (.gltf or .glb)")
      ->required()
      ->type_name("");
  addSceneOptions(app, options.load);
  addShadingOptions(app, options);
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
  addLightOption(app, options.render.lights);
  addObjectOption(app, options.objects.objects,
                  "put another glTF file into the scene, lit in sh, lights and phong shading");
  addOptions<pictures::PictureRequest>(app, options, {"thin-beyond"});
  addOptions<viewer::ShadingOptions>(app, options.render);
  addOptions(app, options.render);
  addOptions(app, options.full, {"spp"});
  addOptions(app, options.instant);
  addTechniqueOptions(app, options.bake);
  addRefineOptions(app, options.bake);
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
