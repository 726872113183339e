#include <fmt/format.h>

#include <memory>
#include <optional>
#include <vector>

#include "cli/commands.h"
#include "cli/commands/picture_options.h"
#include "cli/options/options.h"
#include "cli/options/pose_options.h"
#include "cli/options/values.h"
#include "cli/output_file.h"
#include "cli/report.h"
#include "pictures/following_radiosity.h"
#include "scene/dropped_features.h"
#include "viewer/follow/live_follower.h"
#include "viewer/follow/playback.h"
#include "viewer/follow/virtual_light_follower.h"
#include "viewer/window/window.h"

namespace prelight::cli {
namespace {

constexpr std::uint64_t maxFrames = 1'000'000;

struct ViewCommand {
  PictureOptions picture;
  viewer::PlayOptions play;
  std::filesystem::path screenshot;
  int frames = 0;
};

/// Warns for all shadings, because the window may be switched to any of them.
void warnOfDroppedFeatures(Session& session, const pictures::ShadedScene& shaded) {
  Warnings dropped;
  const auto note = [&](const char* who) {
    noteDroppedFeatures(shaded.loaded.scene, shaded.loaded.compiled, MaterialPath::DrawnFull, who, dropped);
  };
  if (shaded.globalIllumination.has_value()) note("full shading");
  if (shaded.virtualLights != nullptr) note("instant shading");
  for (const std::string& warning : dropped) session.warn(warning);
}

/// Throws for options that do not fit the shading, before anything is computed.
void checkFollowing(const PictureOptions& picture) {
  if (picture.shading == viewer::Shading::GlobalIllumination) return;
  if (picture.thinBeyond > 0.0)
    throw UsageError("--thin-beyond", "it applies only to light that follows moving objects, in full shading",
                     "add --shading full");
}

void checkPlay(const ViewCommand& command) {
  const PictureOptions& picture = command.picture;
  if (command.play.plays && picture.shading == viewer::Shading::Instant)
    throw UsageError("--play --shading instant", "its light is computed for one moment",
                     "play another shading, or choose --at");
  if (command.play.plays && picture.causticPhotons > 0)
    throw UsageError("--play --caustics", "its photons are sent at one moment",
                     "play full shading, whose caustics follow, or choose --at");
}

viewer::PlayOptions playOptions(const ViewCommand& command, const pictures::ShadedScene& shaded) {
  viewer::PlayOptions play = command.play;
  if (!play.plays) return play;
  const Scene& scene = shaded.loaded.scene;
  if (scene.animations.empty()) throw UsageError("--play", "the scene has no animations");
  play.animation = pictures::animationMeant(command.picture.pose, scene, shaded.bake);
  return play;
}

/// Shows the scene until its window is closed. Returns the file that was dropped on the window, if any.
std::optional<std::filesystem::path> showScene(const ViewCommand& command, Context& context) {
  Session session(context);
  pictures::ShadedScene shaded = pictures::prepareScene(session, command.picture, true, [&] {
    checkPictureOutputs(command.picture, "--screenshot", command.screenshot);
  });
  session.progress().check();
  if (shaded.run) printBakeSummary(session.console(), shaded.request, *shaded.run, session.times());

  if (shaded.objects) printPasses(session.console(), std::vector{shaded.objects->plan()});
  warnOfDroppedFeatures(session, shaded);

  viewer::ViewerOptions options;
  options.render = shaded.render;
  options.title = "prelight: " + command.picture.scene.filename().string();
  options.frames = command.frames;
  options.screenshotPath = command.screenshot;
  options.exposure = command.picture.exposure.factor;
  options.pose = shaded.poseSources(command.picture.pose);
  options.play = playOptions(command, shaded);
  options.note = [&](const std::string& note) { session.console().note(note); };
  std::optional<double> exposure = options.exposure;
  options.metered = [&](double metered) {
    exposure = metered;
    noteExposure(session, metered);
  };
  std::optional<viewer::LiveFollower> follower;
  if (shaded.following)
    options.followers.push_back(&follower.emplace(*shaded.following->light, *shaded.globalIllumination));
  std::optional<viewer::VirtualLightFollower> virtualLights;
  if (shaded.virtualLights)
    options.followers.push_back(&virtualLights.emplace(*shaded.virtualLights->lights));
  const auto radiosity = pictures::followingRadiosity(session, command.picture, shaded);
  if (radiosity != nullptr) {
    options.followers.push_back(&radiosity->follower);
    options.groups = radiosity->groups;
  }
  std::optional<pictures::FollowingObjects> objects;
  if (shaded.objects && shaded.objects->firstNode() >= 0) {
    options.objects = &objects.emplace(*shaded.objects, shaded.bake);
    options.pose.dragsOnly = true;
    options.selectedNode = shaded.objects->firstNode();
  }
  const auto dropped =
      session.times().measure("view", [&] { return viewer::runViewer(shaded.inputs(), options); });
  if (dropped) return dropped;
  if (!command.screenshot.empty()) session.console().line("wrote", command.screenshot.string());
  nlohmann::ordered_json report = reportOf("view", {{"scene", command.picture.scene.string()},
                                                    {"screenshot", command.screenshot.string()},
                                                    {"stages", toJson(session.times())},
                                                    {"warnings", session.warnings()}});
  addLook(report, shaded.studio, exposure);
  session.console().json(report);
  return std::nullopt;
}

/// Returns the command for a dropped file. A sky gives the scene another light, and any other file is another
/// scene.
ViewCommand withDropped(ViewCommand command, const std::filesystem::path& dropped) {
  const bool isSky = dropped.extension() == ".hdr" || dropped.extension() == ".exr";
  (isSky ? command.picture.environment : command.picture.scene) = dropped;
  return command;
}

void runView(const ViewCommand& command, Context& context) {
  if (!command.screenshot.empty() && command.frames == 0)
    throw UsageError("--screenshot", "it is taken after the last frame, whose number --frames sets",
                     "add --frames 1");
  checkPlay(command);
  checkFollowing(command.picture);
  ViewCommand shown = command;
  std::optional<std::filesystem::path> dropped = showScene(shown, context);
  while (dropped) {
    const ViewCommand next = withDropped(shown, *dropped);
    try {
      dropped = showScene(next, context);
      shown = next;
    } catch (const Error& error) {
      if (error.code() != ExitCode::BadInput && error.code() != ExitCode::BadUsage) throw;
      printError(error.what());
      dropped = showScene(shown, context);
    }
  }
}

}  // namespace

void addViewCommand(CLI::App& program, Context& context) {
  const auto command = std::make_shared<ViewCommand>();
  CLI::App* app = program.add_subcommand("view", "Open a window on a scene");
  addPictureOptions(*app, command->picture);
  addPoseOptions(*app, command->picture.pose);
  app->add_flag_callback(
      "--play", [target = command.get()] { target->play.plays = target->picture.pose.plays = true; },
      "play the animation, from --at or its start (Space pauses)");
  addRealNumber(
      *app, "--speed", {-viewer::Playback::greatestSpeed, viewer::Playback::greatestSpeed},
      [target = command.get()](double factor) { target->play.speed = factor; },
      "speed of playing, backwards below 0 (default 1)");
  app->add_flag_callback(
      "--once", [target = command.get()] { target->play.loops = false; }, "play to the end and stop there");
  addOption<pictures::PictureRequest>(*app, "thin-beyond", command->picture);
  app->add_option("--screenshot", command->screenshot, "write the last frame (.exr or .png); needs --frames")
      ->type_name("FILE");
  addWholeNumber(
      *app, "--frames", {1, maxFrames},
      [target = command.get()](std::uint64_t n) {
        target->frames = static_cast<int>(n);
        target->picture.countedFrames = true;
      },
      "close after this many frames");
  app->footer(
      "Press H in the window for its keys. Drop another scene or a sky on the window to show that "
      "instead.\n\n"
      "Examples:\n"
      "  prelight view baked.glb --env sky.hdr\n"
      "  prelight view baked.glb --object ball.glb:0,1,0 --probes\n"
      "  prelight view occluders.glb --shading vo --shadow-formula thesis --shadow-strength 1.5 --waves 0.2 "
      "--fire 0.5\n"
      "  prelight view moving.glb --play --animation swing --speed 0.5\n"
      "  prelight view rooms.glb --shading full --thin-beyond 5\n"
      "  prelight view baked.glb --screenshot shot.png --frames 2 --size 640x360");
  app->callback([command, &context] { runView(*command, context); });
}

}  // namespace prelight::cli
