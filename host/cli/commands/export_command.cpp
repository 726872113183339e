#include "cli/commands/export_command.h"

#include <fmt/format.h>

#include <bit>
#include <memory>
#include <optional>
#include <string>

#include "cli/commands.h"
#include "cli/commands/air_export.h"
#include "cli/commands/export_options.h"
#include "cli/commands/page_export.h"
#include "cli/options/sky_option.h"
#include "cli/report.h"
#include "cli/session.h"
#include "export/export_bake.h"
#include "library/run_bake.h"
#include "pictures/named_sky.h"
#include "pictures/session/stale_bake.h"

namespace prelight::cli {
namespace {

std::string carrierOptions(const ExportCarrier& carrier) {
  return carrier.target.empty() ? "--as " + carrier.form
                                : fmt::format("--target {} --as {}", carrier.target, carrier.form);
}

void printContents(const Console& console, const ExportedContents& contents) {
  for (const ContentsPart& part : contents.taken) console.line("took", part.what);
  for (const ContentsPart& part : contents.leftOut) {
    std::vector<std::string> options;
    for (const ExportCarrier& carrier : part.carriers) options.push_back(carrierOptions(carrier));
    console.line("left out", options.empty()
                                 ? part.what
                                 : fmt::format("{} (for {})", part.what, fmt::join(options, ", ")));
  }
}

void printReport(const Console& console, const ExportReport& report, const ExportOptions& options) {
  console.line(options.dryRun ? "would write" : "wrote", options.output.string());
  for (const ExportedFile& file : report.files)
    console.line("file", fmt::format("{}: {}; {}", file.name, file.contents,
                                     shortBytes(static_cast<double>(file.bytes))));
  printContents(console, report.contents);
  if (report.mapWidth > 0)
    console.line("map", fmt::format("{} x {} texels", report.mapWidth, report.mapHeight));
  if (report.occlusion)
    console.line("error", fmt::format("occlusion {:.4f} rms, at {} places of the surface; {} rays",
                                      report.occlusion->error, report.occlusion->places,
                                      shortCount(static_cast<double>(report.occlusion->rays))));
  if (report.meshes.drawings == 0) return;
  console.line("meshes", fmt::format("{} written; {} vertices added along chart borders, {} backs, {} "
                                     "primitives added for maps of their own",
                                     report.meshes.drawings, report.meshes.split, report.meshes.backs,
                                     report.meshes.parts));
}

/// Returns the part of the bake that is exported, which may depend on less of the scene than the whole bake.
BakeSubject usedSubject(const std::optional<ExportRequest>& request, const ExportOptions& options,
                        const Bake& bake, const LoadedScene& loaded) {
  if (request) {
    const ExportForm form = options.form.empty() ? usualForm(bake, request->target) : request->form;
    if (form == ExportForm::Occlusion || form == ExportForm::VertexOcclusion) return {};
  }
  return subjectOf(bake, loaded.compiled.vertexCount());
}

/// Casts rays for the occlusion of the texels.
LightMap castOcclusion(Session& session, const ExportOptions& options, const LoadedScene& loaded,
                       const Bake& bake, OcclusionMapReport& report) {
  const Device device =
      session.times().measure("device", [&] { return Device::open(session.deviceOptions()); });
  const std::uint32_t rays = std::bit_floor(options.rays.value_or(OcclusionMapRequest{}.rays));
  LightMap map = session.times().measure("occlusion", [&] {
    return occlusionForExport(loaded.scene, loaded.compiled, bake, rays, device, session.progress(), report);
  });
  session.progress().clear();
  return map;
}

nlohmann::ordered_json exportModel(Session& session, const ExportOptions& options, ExportRequest request,
                                   LoadedScene loaded, const Bake& bake) {
  if (options.form.empty()) request.form = usualForm(bake, request.target);
  if (!options.lights.empty() && request.form == ExportForm::Transfer &&
      request.target == ExportTarget::Three)
    throw UsageError("--lights", "the export is relit by the scene's lights, so that it keeps them",
                     "leave it out, or add --as lightmap");
  requireForm(bake, request.form, request.target);
  checkExportOutput("-o", options);
  OcclusionMapReport occlusionReport;
  std::optional<LightMap> occlusion;
  if (request.form == ExportForm::Occlusion)
    occlusion = castOcclusion(session, options, loaded, bake, occlusionReport);
  ExportReport report = session.times().measure("export", [&] {
    if (isOfAir(request.form)) return exportAir(session, options, request, loaded, bake);
    std::optional<Environment> sky;
    if (!options.skies.empty()) sky = pictures::readNamedSky(options.skies.front());
    const StopSignals::SafePoints writing(session.signals());
    return exportBake({std::move(ownDocument(loaded)), loaded.scene, loaded.compiled, bake,
                       sky ? &*sky : nullptr, occlusion ? &*occlusion : nullptr},
                      options.output, options.baked.stem().string(), request);
  });
  if (occlusion) report.occlusion = occlusionReport;
  printReport(session.console(), report, options);
  return toJson(report, request);
}

nlohmann::ordered_json runExport(const ExportOptions& options, Session& session) {
  const std::optional<ExportRequest> request = exportRequestOf(options);
  LoadedScene loaded = session.load(options.baked, options.load);
  const Bake bake = requireBake(session, loaded);
  if (!options.allowsStale)
    pictures::refuseStaleBake(loaded, bake, usedSubject(request, options, bake, loaded),
                              "export it as it is with --allow-stale");
  for (const std::string& warning : warningsOfDarkness(loaded.scene, loaded.compiled, bake, loaded.sky.get()))
    session.warn(warning);
  nlohmann::ordered_json json =
      reportOf("export", {{"baked", options.baked.string()}, {"output", options.output.string()}});
  if (options.dryRun) json["dryRun"] = true;
  json.update(request ? exportModel(session, options, *request, std::move(loaded), bake)
                      : exportPage(session, options, loaded, bake));
  json["warnings"] = session.warnings();
  return json;
}

ExportOptions exportOptionsOf(const ExportAfterBake& wanted) {
  ExportOptions options;
  options.output = wanted.output;
  options.target = wanted.target;
  return options;
}

}  // namespace

void checkExport(const ExportAfterBake& wanted) {
  if (wanted.output.empty()) return;
  const ExportOptions options = exportOptionsOf(wanted);
  exportRequestOf(options, "--export-target");
  checkExportOutput("--export", options);
}

nlohmann::ordered_json exportBaked(const std::filesystem::path& baked, const ExportAfterBake& wanted,
                                   Session& session) {
  ExportOptions options = exportOptionsOf(wanted);
  options.baked = baked;
  return runExport(options, session);
}

void addExportCommand(CLI::App& program, Context& context) {
  const auto options = std::make_shared<ExportOptions>();
  CLI::App* app = program.add_subcommand(
      "export", "Export a bake as ordinary glTF, for engines and browsers, or as a web page");
  addExportOptions(*app, *options);
  app->footer(
      "Examples:\n"
      "  prelight export baked.glb -o out\n"
      "  prelight export baked.glb -o out --target three\n"
      "  prelight export baked.glb -o out --env day.hdr\n"
      "  prelight export baked.glb -o out --dry-run\n"
      "  prelight export baked.glb -o plain.glb --as vertex-light\n"
      "  prelight export baked.glb -o out --as probes --probes 24\n"
      "  prelight export baked.glb -o page.html --target web --env day.hdr --env night.hdr");
  app->callback([options, &context] {
    Session session(context);
    session.console().json(runExport(*options, session));
  });
}

}  // namespace prelight::cli
