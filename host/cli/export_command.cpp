#include "cli/export_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <string>

#include "cli/air_export.h"
#include "cli/commands.h"
#include "cli/output_file.h"
#include "cli/scene_options.h"
#include "cli/session.h"
#include "export/export_bake.h"

namespace prelight::cli {
namespace {

struct ExportCommand {
  std::filesystem::path baked;
  std::filesystem::path output;
  LoadOptions load;
  std::string target = "gltf", form, lights = "remove";
  ProbeOptions probes;
};

/// The value that `name` stands for among the names of an enumeration, in its order.
template <class Enumeration, std::size_t count>
Enumeration named(const std::string& option, const std::string& name,
                  const std::array<std::string_view, count>& names) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw UsageError(option + " " + name, "unknown name",
                     fmt::format("expected one of {}", fmt::join(names, ", ")));
  return static_cast<Enumeration>(found - names.begin());
}

/// What is there to be handed on, where nobody says.
ExportForm usualForm(const Bake& bake) {
  return bake.lightMap || bake.ao.empty() ? ExportForm::LightMap : ExportForm::Occlusion;
}

void checkOutput(const std::string& option, const std::filesystem::path& output) {
  if (output.extension() == ".gltf")
    throw UsageError(option + " " + output.string(), "a scene of one file is written as .glb",
                     "name a .glb, or a folder for the scene and what belongs to it");
  if (output.extension() == ".glb")
    checkOutputFile(option, output, {".glb"});
  else
    checkOutputFolder(option, output);
}

void printReport(const Console& console, const ExportReport& report, const std::filesystem::path& output) {
  console.line("wrote", output.string());
  for (const ExportedFile& file : report.files) console.line("file", file.name + ": " + file.contents);
  if (report.mapWidth > 0)
    console.line("map", fmt::format("{} x {} texels", report.mapWidth, report.mapHeight));
  if (report.meshes.drawings == 0) return;
  console.line("meshes", fmt::format("{} of their own; {} vertices more where charts part, {} backs",
                                     report.meshes.drawings, report.meshes.split, report.meshes.backs));
}

nlohmann::ordered_json runExport(const ExportCommand& command, Session& session) {
  ExportRequest request;
  request.target = named<ExportTarget>("--target", command.target, exportTargetNames);
  request.lights = named<BakedLights>("--lights", command.lights, bakedLightsNames);
  if (!command.form.empty()) request.form = named<ExportForm>("--as", command.form, exportFormNames);
  LoadedScene loaded = session.load(command.baked, command.load);
  const Bake bake = requireBake(session, loaded);
  if (command.form.empty()) request.form = usualForm(bake);
  requireForm(bake, request.form);
  checkOutput("-o", command.output);
  const std::string name = command.baked.stem().string();
  const ExportReport report = session.times().measure("export", [&] {
    if (isOfAir(request.form))
      return exportAir(session, loaded, bake, command.output, name, request, command.probes);
    const StopSignals::Writing writing(session.signals());
    return exportBake({std::move(loaded.document), loaded.scene, loaded.compiled, bake}, command.output, name,
                      request);
  });
  printReport(session.console(), report, command.output);
  nlohmann::ordered_json json = {{"command", "export"},
                                 {"version", PRELIGHT_VERSION},
                                 {"baked", command.baked.string()},
                                 {"output", command.output.string()}};
  json.update(toJson(report, request));
  json["warnings"] = session.warnings();
  return json;
}

}  // namespace

void checkExport(const ExportAfterBake& wanted) {
  if (wanted.output.empty()) return;
  named<ExportTarget>("--export-target", wanted.target, exportTargetNames);
  checkOutput("--export", wanted.output);
}

nlohmann::ordered_json exportBaked(const std::filesystem::path& baked, const ExportAfterBake& wanted,
                                   Session& session) {
  ExportCommand command;
  command.baked = baked;
  command.output = wanted.output;
  command.target = wanted.target;
  return runExport(command, session);
}

void addExportCommand(CLI::App& program, Context& context) {
  const auto command = std::make_shared<ExportCommand>();
  CLI::App* app =
      program.add_subcommand("export", "Write what was baked as ordinary glTF, for engines and browsers");
  app->add_option("BAKED", command->baked, "baked .glb")->required()->type_name("");
  app->add_option("-o,--output", command->output, "folder to write into, or one .glb that holds everything")
      ->required()
      ->type_name("DIR|FILE.glb");
  app->add_option("--target", command->target,
                  "who it is for: gltf (every file there is), three (three.js), blender, godot, unity or raw "
                  "(numbers with descriptions)")
      ->type_name("TARGET")
      ->capture_default_str();
  app->add_option(
         "--as", command->form,
         "lightmap (second texture coordinates and a map), occlusion (occlusionTexture), vertex-light "
         "or vertex-occlusion (COLOR_0), probes (light at points in the air) or volume (their transfer); "
         "without it the first of these two that the bake holds")
      ->type_name("FORM");
  app->add_option("--lights", command->lights,
                  "remove, mark or keep the scene's lights where what is exported holds their light")
      ->type_name("HOW")
      ->capture_default_str();
  addProbeOptions(*app, command->probes);
  addSceneOptions(*app, command->load);
  app->footer(
      "Examples:\n"
      "  prelight export baked.glb -o out\n"
      "  prelight export baked.glb -o out --target three\n"
      "  prelight export baked.glb -o plain.glb --as vertex-light\n"
      "  prelight export baked.glb -o out --as probes --probes 24");
  app->callback([command, &context] {
    Session session(context);
    session.console().json(runExport(*command, session));
  });
}

}  // namespace prelight::cli
