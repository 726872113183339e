#include <fmt/format.h>

#include <memory>
#include <utility>

#include "cli/commands.h"
#include "cli/commands/global_illumination_picture.h"
#include "cli/commands/picture_options.h"
#include "cli/commands/picture_sequence.h"
#include "cli/options/options.h"
#include "cli/options/pose_options.h"
#include "cli/options/values.h"
#include "cli/output_file.h"
#include "cli/report.h"
#include "io/finite_results.h"
#include "io/plan_json.h"
#include "pictures/drawn_picture.h"
#include "prelight/picture.h"

namespace prelight::cli {
namespace {

struct RenderCommand {
  PictureOptions picture;
  bool rasterised = false;
  std::optional<double> framesASecond;  ///< none: one picture
  std::filesystem::path output;
  bool dryRun = false;
};

/// Prints what was drawn, and the report.
void tellOfDrawing(const RenderCommand& command, const pictures::DrawnPicture& drawn,
                   std::optional<double> exposure, Session& session) {
  const pictures::ShadedScene& shaded = drawn.shaded;
  const Console& console = session.console();
  for (const std::string& note : drawn.notes) console.note(note);
  printPasses(console, drawn.plan);
  if (shaded.run) printBakeSummary(console, shaded.request, *shaded.run, session.times());
  console.line("wrote", fmt::format("{}: {}x{}, {} shading, in {}", command.output.string(),
                                    drawn.layered.picture.width, drawn.layered.picture.height,
                                    viewer::shadingName(shaded.render.shading),
                                    shortSeconds(session.times().total())));
  nlohmann::ordered_json report = drawnReport(session, command.picture, command.output, shaded, drawn.notes);
  if (!drawn.plan.empty()) report["plan"] = toJson(drawn.plan);
  if (shaded.run)
    report["bake"] = bakeReport("render", shaded.loaded, {}, shaded.request, *shaded.run, session);
  addLook(report, shaded.studio, exposure);
  console.json(report);
}

bool showsDebugView(const RenderCommand& command) {
  return command.picture.render.debug.shown != viewer::DebugView::None;
}

/// Throws UsageError for options that contradict each other.
void checkRender(const RenderCommand& command, bool globalIllumination) {
  if (command.dryRun && (!globalIllumination || command.rasterised || command.framesASecond))
    throw UsageError("--dry-run", "it applies only to a single picture in full shading, which is traced",
                     "leave it out; other pictures take about as long as `prelight bake --dry-run` says");
  if (command.framesASecond && globalIllumination && command.rasterised)
    throw UsageError("--fps --rasterised", "full shading computes its light anew for every moment",
                     "leave --rasterised out: the pictures are traced");
  if (command.framesASecond && globalIllumination && showsDebugView(command))
    throw UsageError("--fps --debug", "debug views of full shading are drawn for one moment only",
                     "leave --fps out and choose --at");
  if (!command.framesASecond && command.rasterised && !globalIllumination)
    throw UsageError("--rasterised", "every shading but full is rasterised",
                     "leave it out or add --shading full");
}

/// Debug views are drawn and not traced, and displayed with an exposure that is known before.
RenderCommand prepared(RenderCommand command, bool globalIllumination) {
  if (!showsDebugView(command)) return command;
  command.rasterised |= globalIllumination;
  command.picture.exposure = {command.picture.exposure.factor.value_or(1.0)};
  command.picture.render.debug.exposure = *command.picture.exposure.factor;
  return command;
}

/// Renders sequences and traced pictures. Returns whether the command asked for one.
bool renderOtherwise(const RenderCommand& command, bool globalIllumination, Session& session) {
  if (command.dryRun) {
    planGlobalIlluminationPicture(session, command.picture, command.output);
  } else if (command.framesASecond && globalIllumination) {
    renderGlobalIlluminationSequence(session, command.picture, *command.framesASecond, command.output);
  } else if (command.framesASecond) {
    renderSequence(session, command.picture, *command.framesASecond, command.output);
  } else if (globalIllumination && !command.rasterised) {
    renderGlobalIlluminationPicture(session, command.picture, command.output);
  } else {
    return false;
  }
  return true;
}

void runRender(const RenderCommand& asked, Context& context) {
  Session session(context);
  const bool globalIllumination = asked.picture.shading == viewer::Shading::GlobalIllumination;
  checkRender(asked, globalIllumination);
  const RenderCommand command = prepared(asked, globalIllumination);
  if (renderOtherwise(command, globalIllumination, session)) return;
  pictures::ShadedScene shaded = pictures::prepareScene(
      session, command.picture, false, [&] { checkPictureOutputs(command.picture, "-o", command.output); });
  if (globalIllumination)
    shaded.render.samplesPerAxis = pictures::samplesPerAxis(command.picture.full.samples);
  const pictures::DrawnPicture drawn =
      pictures::drawPicture(session, std::move(shaded), takesLayers(command.output));
  const Picture& picture = drawn.layered.picture;
  requireFinite(command.output, picture);
  const std::optional<double> exposure =
      writeExposed(session, command.output, drawn.layered, command.picture.exposure);
  pictures::warnOfPicture(session, command.picture, drawn);
  tellOfDrawing(command, drawn, exposure, session);
}

}  // namespace

void addRenderCommand(CLI::App& program, Context& context) {
  const auto command = std::make_shared<RenderCommand>();
  CLI::App* app = program.add_subcommand("render", "Draw a picture of a scene, without a display");
  addPictureOptions(*app, command->picture);
  addOption(*app, "spp", command->picture.full);
  app->add_flag("--rasterised", command->rasterised,
                "full shading as the window draws it, with shadow maps and environment maps; otherwise "
                "direct light and mirrors are traced");
  addPoseOptions(*app, command->picture.pose);
  addRealNumber(
      *app, "--fps", {1e-3, 1e3},
      [target = command.get()](double rate) {
        target->framesASecond = rate;
        target->picture.pose.plays = true;
      },
      "draw the animation, from --at or its start to its end, with this many pictures per second, numbered "
      "in place of %d or %04d in the output's name");
  app->add_flag("--dry-run", command->dryRun,
                "full shading: write nothing; say what would be drawn, how large the file would be, and how "
                "long it would take, estimated from a small picture");
  app->add_option("-o,--output", command->output,
                  "picture to write: .exr is linear radiance, .png is for the screen")
      ->required()
      ->type_name("IMG");
  app->footer(
      "Data that a shading needs and the file does not hold are baked first.\n\n"
      "Examples:\n"
      "  prelight render baked.glb -o picture.png --env sky.hdr --rotate-env 90\n"
      "  prelight render baked.glb -o picture.png --object car.glb:2,0,-1:45 --object ball.glb:0,1,0\n"
      "  prelight render level.glb -o before.exr --shading phong --size 640x360 --light "
      "point:0,2,0:10,10,10\n"
      "  prelight render room.glb -o room.exr --shading full --spp 32 --size 512\n"
      "  prelight render room.glb -o room.exr --shading full --denoise\n"
      "  prelight render room.glb -o room.exr --shading full --size 1080 --dry-run\n"
      "  prelight render room.glb -o room.png --shading full --rasterised --spp 16\n"
      "  prelight render moving.glb -o frame.%04d.png --animation swing --fps 24\n"
      "  prelight render room.glb -o charts.png --shading lightmap --debug charts\n"
      "  prelight render occluders.glb -o glass.png --shading vo --caustic-strength 1.5 --specular-exponent "
      "200\n"
      "  prelight render occluders.glb -o sea.png --shading vo --waves 0.4 --effect-time 2.5");
  app->callback([command, &context] { runRender(*command, context); });
}

}  // namespace prelight::cli
