#include "cli/commands/export_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "cli/options/options.h"
#include "cli/options/scene_options.h"
#include "cli/options/values.h"
#include "cli/output_file.h"
#include "export/export_bake.h"
#include "prelight/error.h"
#include "prelight/picture.h"

namespace prelight::cli {
namespace {

constexpr std::string_view pageTarget = "web";

ExportTarget parseTarget(const std::string& option, const std::string& name) {
  std::array<std::string_view, exportTargetNames.size() + 1> names{};
  std::copy(exportTargetNames.begin(), exportTargetNames.end(), names.begin());
  names.back() = pageTarget;
  return exportNamed<ExportTarget>(option, name, names);
}

void checkPage(const ExportOptions& options) {
  const char* given = !options.form.empty() ? "--as" : !options.lights.empty() ? "--lights" : nullptr;
  if (given != nullptr)
    throw UsageError(given, "a page shows everything that was baked, and its lights can be switched",
                     "leave it out, or choose another --target");
}

/// Throws UsageError for options that the target would ignore.
void checkNoPage(const ExportOptions& options, const ExportRequest& request) {
  constexpr std::uint32_t fewestOfProbe = 256;
  if (request.form == ExportForm::Probes && options.rays.value_or(fewestOfProbe) < fewestOfProbe)
    throw UsageError("--rays",
                     fmt::format("got {}, expected at least {} for a probe", *options.rays, fewestOfProbe),
                     "ask for more, or leave it out");
  if (options.exposure)
    throw UsageError("--exposure", "only pages use it", "leave it out, or add --target web");
  if (options.skies.empty()) return;
  const bool ofScene = request.target == ExportTarget::Gltf && !isOfAir(request.form);
  if (request.form != ExportForm::Probes && !ofScene)
    throw UsageError("--env", "only pages, probes and scenes for --target gltf have a sky",
                     "leave it out, or choose another --target or --as probes");
  if (options.skies.size() > 1)
    throw UsageError("--env",
                     fmt::format("got {} skies, expected one, because probes and scenes hold only one",
                                 options.skies.size()),
                     "leave all but one out");
}

void addRaysOption(CLI::App& app, ExportOptions& options) {
  app.add_option("--rays", options.rays,
                 fmt::format("rays per probe, 256 to 8192 (default: {}), or per texel of --as occlusion, 16 "
                             "to 8192, rounded down to a power of two (default: {})",
                             ProbeRequest{}.rays, OcclusionMapRequest{}.rays))
      ->check(CLI::Range(16u, 8192u))
      ->type_name("N");
}

void addProbeOptions(CLI::App& app, ProbeRequest& request) {
  for (const char* name : {"probes", "probe-order"}) addOption(app, name, request);
  addSeedOption(app, request.seed);
}

void addSkyOptions(CLI::App& app, ExportOptions& options) {
  app.add_option("--env", options.skies,
                 "web: a sky of the page, given as for render; may be repeated, and the page opens with the "
                 "first one. probes: the sky that they see, which should be that of the bake. gltf: the "
                 "scene's sky (EXT_lights_image_based)")
      ->type_name("MAP")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  addRealNumber(
      app, "--exposure", {leastExposure, mostExposure}, [&](double factor) { options.exposure = factor; },
      "web: factor for radiance when the page opens (default: 1)");
}

}  // namespace

bool ExportOptions::isPage() const { return target == pageTarget; }

std::optional<ExportRequest> exportRequestOf(const ExportOptions& options, const std::string& targetOption) {
  ExportRequest request{.dryRun = options.dryRun};
  request.target = parseTarget(targetOption, options.target);
  if (options.isPage()) {
    checkPage(options);
    return std::nullopt;
  }
  if (!options.lights.empty())
    request.lights = exportNamed<BakedLights>("--lights", options.lights, bakedLightsNames);
  if (!options.form.empty()) request.form = exportNamed<ExportForm>("--as", options.form, exportFormNames);
  requireTarget(request.form, request.target);
  checkNoPage(options, request);
  return request;
}

void checkExportOutput(const std::string& option, const ExportOptions& options) {
  const std::filesystem::path& output = options.output;
  if (options.isPage()) {
    checkOutputFile(option, output, {".html"});
    return;
  }
  if (output.extension() == ".gltf")
    throw UsageError(option + " " + output.string(), "a scene of one file is written as .glb",
                     "name a .glb, or a folder for the scene and its files");
  if (output.extension() == ".glb")
    checkOutputFile(option, output, {".glb"});
  else
    checkOutputFolder(option, output);
}

void addExportOptions(CLI::App& app, ExportOptions& options) {
  app.add_option("BAKED", options.baked, "baked .glb")->required()->type_name("");
  app.add_option("-o,--output", options.output,
                 "folder to write into, or one .glb that holds everything; a page is one .html")
      ->required()
      ->type_name("DIR|FILE");
  app.add_option(
         "--target", options.target,
         "program to export for: gltf (every file there is), three (three.js), blender, godot, unity, raw "
         "(numbers with descriptions), or web (a page that relights the scene in any browser)")
      ->type_name("TARGET")
      ->capture_default_str();
  app.add_option(
         "--as", options.form,
         "lightmap (second texture coordinates and a map), occlusion (occlusionTexture), vertex-light or "
         "vertex-occlusion (COLOR_0), probes (light at points in the air), volume (their transfer) or "
         "transfer (that of the vertices, with --target three, which relights it, or raw); default: lightmap "
         "or else occlusion, whichever the bake holds; for --target three transfer where prelight.js "
         "relights "
         "some of it, and for --target raw transfer if it holds neither")
      ->type_name("FORM");
  app.add_option(
         "--lights", options.lights,
         "remove (the default), mark or keep those of the scene's lights whose light the export holds")
      ->type_name("HOW");
  app.add_flag("--allow-stale", options.allowsStale, "export even if the scene has changed since the bake");
  app.add_flag("--dry-run", options.dryRun,
               "write nothing; list the files that there would be, with their sizes");
  addRaysOption(app, options);
  addProbeOptions(app, options.probes);
  addSkyOptions(app, options);
  addSceneOptions(app, options.load);
}

}  // namespace prelight::cli
