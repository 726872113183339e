#include "cli/scene_options.h"

#include "cli/parameters.h"

namespace prelight::cli {

namespace {

MaterialBrdf parseMaterialBrdf(const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0 || at + 1 == text.size())
    throw UsageError("--brdf " + text, "expected MATERIAL=FILE");
  return {text.substr(0, at), text.substr(at + 1)};
}

}  // namespace

void addSceneOptions(CLI::App& app, LoadOptions& options) {
  app.add_option("--scene", options.scene,
                 "which of the file's scenes (default: the one that it names, else the first)")
      ->type_name("NAME|INDEX");
  app.add_option("--variant", options.variant,
                 "materials of this variant (KHR_materials_variants; default: the one that was baked, else "
                 "the file's own)")
      ->type_name("NAME");
  addParameter(app, "scale", options);
  app.add_option_function<std::vector<std::string>>(
         "--brdf",
         [&](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) options.brdfs.push_back(parseMaterialBrdf(text));
         },
         "let a material, given by name or number, reflect like the measured one in this MERL file; may be "
         "repeated")
      ->type_name("MATERIAL=FILE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

CLI::Option* addMomentOption(CLI::App& app, LoadOptions& options) {
  return addParameter<LoadOptions>(app, "at", [&options](double seconds) { options.at = seconds; })
      ->description(
          "load the scene at this moment of an animation, in seconds (default: as it was baked, else at "
          "rest)")
      ->type_name("SECONDS");
}

void addMomentOptions(CLI::App& app, LoadOptions& options) {
  addMomentOption(app, options);
  app.add_option("--animation", options.animation, "the animation that --at refers to (default: the first)")
      ->type_name("NAME|INDEX");
}

void checkMoment(const LoadOptions& options) {
  if (!options.at && !options.animation.empty())
    throw UsageError("--animation", "it needs a moment, and none is given", "add --at SECONDS");
}

}  // namespace prelight::cli
