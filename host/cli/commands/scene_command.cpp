#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/commands.h"
#include "cli/output_file.h"
#include "cli/report.h"
#include "cli/session.h"
#include "scene/builtin/builtin.h"

namespace prelight::cli {
namespace {

struct SceneCommand {
  std::string name;
  std::filesystem::path output;
  bool list = false;
};

void listScenes(const Console& console) {
  nlohmann::ordered_json scenes = nlohmann::ordered_json::array();
  std::size_t width = 0;
  for (const BuiltinScene& scene : builtinScenes())
    width = std::max(width, std::string_view(scene.name).size());
  for (const BuiltinScene& scene : builtinScenes()) {
    console.line(fmt::format("{:<{}}", scene.name, width), scene.description);
    scenes.push_back({{"name", scene.name}, {"description", scene.description}});
  }
  console.json(reportOf("scene", {{"scenes", scenes}}));
}

void runScene(const SceneCommand& command, Context& context) {
  Session session(context);
  if (command.list) {
    listScenes(session.console());
    return;
  }
  if (command.name.empty())
    throw UsageError("NAME", "a name is required", "prelight scene --list shows the names");
  if (command.output.empty()) throw UsageError("-o", "an output file is required", "add -o FILE.glb");
  const GltfDocument document =
      session.times().measure("make", [&] { return makeBuiltinScene(command.name); });
  checkOutputFile("-o", command.output, {".glb"});
  const StopSignals::SafePoints writing(context.signals);
  session.times().measure("write", [&] { writeGlb(command.output, document); });
  session.console().line("wrote", command.output.string());
  session.console().json(reportOf("scene", {{"name", command.name}, {"output", command.output.string()}}));
}

}  // namespace

void addSceneCommand(CLI::App& program, Context& context) {
  const auto command = std::make_shared<SceneCommand>();
  CLI::App* app = program.add_subcommand("scene", "Write a built-in scene");
  app->add_option("NAME", command->name, "name of the scene")->type_name("");
  CLI::Option* output =
      app->add_option("-o,--output", command->output, "file to write (.glb)")->type_name("FILE.glb");
  app->add_flag("--list", command->list, "list the built-in scenes")->excludes(output);
  app->footer(
      "Examples:\n"
      "  prelight scene --list\n"
      "  prelight scene cornell -o cornell.glb");
  app->callback([command, &context] { runScene(*command, context); });
}

}  // namespace prelight::cli
