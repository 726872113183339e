#include "cli/scene_options.h"

#include "cli/values.h"

namespace prelight::cli {

void addSceneOptions(CLI::App& app, LoadOptions& options) {
  app.add_option("--scene", options.scene,
                 "which of the file's scenes (default: the one that it names, else the first)")
      ->type_name("NAME|INDEX");
  app.add_option("--variant", options.variant,
                 "materials of this variant (KHR_materials_variants; default: the one that was baked, else "
                 "the file's own)")
      ->type_name("NAME");
  addRealNumber(
      app, "--scale", {1e-9, 1e9}, [&](double scale) { options.scale = scale; },
      "makes the scene so many times as large, as 0.001 where it is in millimetres")
      ->type_name("X");
}

CLI::Option* addMomentOption(CLI::App& app, LoadOptions& options) {
  constexpr double mostSeconds = 1e6;
  return addRealNumber(
             app, "--at", {0.0, mostSeconds}, [&](double seconds) { options.at = seconds; },
             "the scene at this moment of an animation, seconds (default: as it was baked, else at rest)")
      ->type_name("SECONDS");
}

void addMomentOptions(CLI::App& app, LoadOptions& options) {
  addMomentOption(app, options);
  app.add_option("--animation", options.animation, "the animation that --at means (default: the first)")
      ->type_name("NAME|INDEX");
}

void checkMoment(const LoadOptions& options) {
  if (!options.at && !options.animation.empty())
    throw UsageError("--animation", "no moment of it is given", "add --at SECONDS");
}

}  // namespace prelight::cli
