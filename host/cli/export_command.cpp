#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <string>

#include "cli/commands.h"
#include "cli/commit.h"
#include "cli/output_file.h"
#include "cli/page_export.h"
#include "cli/scene_options.h"
#include "cli/session.h"
#include "cli/stale_bake.h"
#include "export/export_bake.h"

namespace prelight::cli {
namespace {

struct ExportCommand {
  std::filesystem::path baked;
  std::filesystem::path output;
  LoadOptions load;
  bool allowsStale = false;
  std::string target = "gltf", form, lights;
  PageOptions page;
};

constexpr std::string_view pageTarget = "web";

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

ExportTarget parseTarget(const std::string& name) {
  std::array<std::string_view, exportTargetNames.size() + 1> names{};
  std::copy(exportTargetNames.begin(), exportTargetNames.end(), names.begin());
  names.back() = pageTarget;  // which has no ExportTarget: the viewer makes it
  return named<ExportTarget>("--target", name, names);
}

/// Options that the others would pass over.
void checkOptions(const ExportCommand& command) {
  if (command.target == pageTarget) {
    const char* given = !command.form.empty() ? "--as" : !command.lights.empty() ? "--lights" : nullptr;
    if (given != nullptr)
      throw UsageError(given, "a page shows all that was baked, and its lights can be switched",
                       "leave it out, or choose another --target");
  } else if (command.page.given()) {
    throw UsageError(command.page.skies.empty() ? "--exposure" : "--env", "a page alone has that",
                     "leave it out, or add --target web");
  }
}

void checkOutput(const std::filesystem::path& output) {
  if (output.extension() == ".gltf")
    throw UsageError("-o " + output.string(), "a scene of one file is written as .glb",
                     "name a .glb, or a folder for the scene and what belongs to it");
  if (output.extension() == ".glb")
    checkOutputFile("-o", output, {".glb"});
  else
    checkOutputFolder("-o", output);
}

void printReport(const Console& console, const ExportReport& report, const std::filesystem::path& output) {
  console.line("wrote", output.string());
  for (const ExportedFile& file : report.files) console.line("file", file.name + ": " + file.contents);
  if (report.mapWidth > 0)
    console.line("map", fmt::format("{} x {} texels", report.mapWidth, report.mapHeight));
  console.line("meshes", fmt::format("{} of their own; {} vertices more where charts part, {} backs",
                                     report.meshes.drawings, report.meshes.split, report.meshes.backs));
}

void runExport(const ExportCommand& command, Context& context) {
  Session session(context);
  checkOptions(command);
  if (command.target == pageTarget) {
    exportPage(session, command.baked, command.output, command.load, command.page);
    return;
  }
  ExportRequest request;
  request.target = parseTarget(command.target);
  if (!command.lights.empty())
    request.lights = named<BakedLights>("--lights", command.lights, bakedLightsNames);
  if (!command.form.empty()) request.form = named<ExportForm>("--as", command.form, exportFormNames);
  LoadedScene loaded = session.load(command.baked, command.load);
  const Bake bake = requireBake(session, loaded);
  if (!command.allowsStale) refuseStaleBake(loaded, "export it as it is with --allow-stale");
  checkOutput(command.output);
  if (command.form.empty()) request.form = usualForm(bake);
  const StopSignals::Writing writing(context.signals);
  const ExportReport report = session.times().measure("export", [&] {
    return exportBake({std::move(loaded.document), loaded.scene, loaded.compiled, bake}, command.output,
                      command.baked.stem().string(), request);
  });
  printReport(session.console(), report, command.output);
  nlohmann::ordered_json json = {{"command", "export"},
                                 {"version", PRELIGHT_VERSION},
                                 {"commit", commit()},
                                 {"baked", command.baked.string()},
                                 {"output", command.output.string()}};
  json.update(toJson(report, request));
  json["warnings"] = session.warnings();
  session.console().json(json);
}

}  // namespace

void addExportCommand(CLI::App& program, Context& context) {
  const auto command = std::make_shared<ExportCommand>();
  CLI::App* app = program.add_subcommand(
      "export", "Write what was baked as ordinary glTF, for engines and browsers, or as a page");
  app->add_option("BAKED", command->baked, "baked .glb")->required()->type_name("");
  app->add_option("-o,--output", command->output,
                  "folder to write into, or one .glb that holds everything; a page is one .html")
      ->required()
      ->type_name("DIR|FILE");
  app->add_option(
         "--target", command->target,
         "who it is for: gltf (every file there is), three (three.js), blender, or web (a page that relights "
         "the scene in any browser)")
      ->type_name("TARGET")
      ->capture_default_str();
  app->add_option(
         "--as", command->form,
         "lightmap (second texture coordinates and a map), occlusion (occlusionTexture), vertex-light "
         "or vertex-occlusion (COLOR_0); without it the first of these two that the bake holds")
      ->type_name("FORM");
  app->add_option(
         "--lights", command->lights,
         "remove (the default), mark or keep the scene's lights where what is exported holds their light")
      ->type_name("HOW");
  app->add_flag("--allow-stale", command->allowsStale,
                "export also what was baked before the scene's geometry or materials changed");
  addPageOptions(*app, command->page);
  addSceneOptions(*app, command->load);
  app->footer(
      "Examples:\n"
      "  prelight export baked.glb -o out\n"
      "  prelight export baked.glb -o out --target three\n"
      "  prelight export baked.glb -o plain.glb --as vertex-light\n"
      "  prelight export baked.glb -o page.html --target web --env day.hdr --env night.hdr");
  app->callback([command, &context] { runExport(*command, context); });
}

}  // namespace prelight::cli
