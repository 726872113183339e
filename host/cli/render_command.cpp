#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "cli/full_picture.h"
#include "cli/output_file.h"
#include "cli/picture_options.h"
#include "cli/report.h"
#include "io/picture.h"

namespace prelight::cli {
namespace {

struct RenderCommand {
  PictureOptions picture;
  FullRequest full;
  std::filesystem::path output;
};

nlohmann::ordered_json renderReport(const RenderCommand& command, const ShadedScene& shaded, Session& session,
                                    const Warnings& notes) {
  nlohmann::ordered_json report = {{"command", "render"},
                                   {"version", PRELIGHT_VERSION},
                                   {"scene", command.picture.scene.string()},
                                   {"output", command.output.string()},
                                   {"shading", viewer::shadingName(shaded.render.shading)},
                                   {"width", shaded.render.width},
                                   {"height", shaded.render.height},
                                   {"seconds", session.times().total()},
                                   {"stages", toJson(session.times())},
                                   {"notes", notes},
                                   {"warnings", session.warnings()}};
  if (shaded.run)
    report["bake"] = bakeReport("render", shaded.loaded, {}, shaded.request, *shaded.run, session);
  return report;
}

void runRender(const RenderCommand& command, Context& context) {
  Session session(context);
  if (command.picture.full) {
    renderFullPicture(session, command.picture, command.full, command.output);
    return;
  }
  const ShadedScene shaded = prepareScene(session, command.picture, false, [&] {
    checkOutputFile("-o", command.output, {".exr", ".png"});
  });
  session.progress().check();
  Warnings notes;
  const Picture picture = session.times().measure(
      "render", [&] { return viewer::renderPicture(shaded.inputs(), shaded.render, notes); });
  session.progress().check();
  session.times().measure("write", [&] { writePicture(command.output, picture); });

  for (const std::string& note : notes) session.console().note(note);
  const Console& console = session.console();
  if (shaded.run) printBakeSummary(console, shaded.request, *shaded.run, session.times());
  console.line("wrote", fmt::format("{}: {}x{}, {} shading, in {}", command.output.string(), picture.width,
                                    picture.height, viewer::shadingName(shaded.render.shading),
                                    shortSeconds(session.times().total())));
  console.json(renderReport(command, shaded, session, notes));
}

}  // namespace

void addRenderCommand(CLI::App& program, Context& context) {
  const auto command = std::make_shared<RenderCommand>();
  CLI::App* app = program.add_subcommand("render", "Draw a picture of a scene, without a display");
  addPictureOptions(*app, command->picture, true);
  addFullOptions(*app, command->full);
  addPoseOptions(*app, command->picture.pose);
  app->add_option("-o,--output", command->output,
                  "picture to write: .exr is linear radiance, .png is for the screen")
      ->required()
      ->type_name("IMG");
  app->footer(
      "What a shading needs and the file does not carry is baked first.\n\n"
      "Examples:\n"
      "  prelight render baked.glb -o picture.png --env sky.hdr --rotate-env 90\n"
      "  prelight render level.glb -o before.exr --shading phong --size 640x360 --light "
      "point:0,2,0:10,10,10\n"
      "  prelight render room.glb -o room.exr --shading full --spp 32 --size 512\n"
      "  prelight render occluders.glb -o glass.png --shading vo --caustic-strength 1.5 --specular-exponent "
      "200\n"
      "  prelight render occluders.glb -o sea.png --shading vo --waves 0.4 --effect-time 2.5");
  app->callback([command, &context] { runRender(*command, context); });
}

}  // namespace prelight::cli
