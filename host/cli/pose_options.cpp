#include "cli/pose_options.h"

#include <fmt/format.h>

#include "bake/animated_transfer.h"
#include "cli/values.h"
#include "scene/pose.h"

namespace prelight::cli {

void addPoseOptions(CLI::App& app, PoseOptions& options) {
  constexpr double mostSeconds = 1e6;
  addRealNumber(
      app, "--at", {0.0, mostSeconds}, [&](double seconds) { options.at = seconds; },
      "show the scene at this moment of an animation, seconds (default: at rest)")
      ->type_name("SECONDS");
  app.add_option("--animation", options.animation,
                 "the animation that --at means (default: the one that was baked, else the first)")
      ->type_name("NAME|INDEX");
}

void poseScene(Session& session, const PoseOptions& options, LoadedScene& loaded, Bake& bake) {
  if (!options.at) {
    if (!options.animation.empty())
      throw UsageError("--animation", "no moment of it is given", "add --at SECONDS");
    return;
  }
  const std::size_t animation = !options.animation.empty() ? findAnimation(loaded.scene, options.animation)
                                : bake.animation           ? bake.animation->animation
                                                           : 0;
  session.times().measure("pose", [&] {
    setPose(loaded.scene, animation, *options.at);
    Bake posed;
    if (bake.animation && bake.animation->animation == animation) {
      posed.info = bake.info;
      posed.sh = transferAt(*bake.animation, loaded.scene, loaded.compiled, *options.at);
    }
    bake = std::move(posed);
    Warnings said;  // by the rest pose already
    loaded.compiled = compileScene(loaded.scene, said);
  });
}

}  // namespace prelight::cli
