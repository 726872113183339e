#include "cli/options/scene_options.h"

#include "cli/options/options.h"

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
  const auto own = [&](const char* name, const char* value, std::string& text) {
    addOwnOption(app, optionNamed<LoadOptions>(name), value,
                 [&text](const std::string& given) { text = given; });
  };
  own("scene", "NAME|INDEX", options.scene);
  own("variant", "NAME", options.variant);
  addOption(app, "scale", options);
  addRepeatedOption(
      app, optionNamed<LoadOptions>("brdf"), "MATERIAL=FILE",
      [&options](const std::string& text) { options.brdfs.push_back(parseMaterialBrdf(text)); });
}

CLI::Option* addMomentOption(CLI::App& app, LoadOptions& options) { return addOption(app, "at", options); }

void addMomentOptions(CLI::App& app, LoadOptions& options) {
  addMomentOption(app, options);
  addOwnOption(app, optionNamed<LoadOptions>("animation"), "NAME|INDEX",
               [&options](const std::string& text) { options.animation = text; });
}

void checkMoment(const LoadOptions& options) {
  if (!options.at && !options.animation.empty())
    throw UsageError("--animation", "it needs a moment, and none is given", "add --at SECONDS");
}

}  // namespace prelight::cli
