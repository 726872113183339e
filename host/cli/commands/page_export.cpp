#include "cli/commands/page_export.h"

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "cli/output_file.h"
#include "pictures/named_sky.h"
#include "pictures/picture_sky.h"
#include "viewer/web/web_page.h"

namespace prelight::cli {
namespace {

/// Returns the skies that are asked for, or the one that a picture would have.
std::vector<viewer::PageSky> skiesOf(Session& session, const ExportOptions& options,
                                     const LoadedScene& loaded, const Bake& bake) {
  std::vector<viewer::PageSky> skies;
  for (const std::filesystem::path& sky : options.skies)
    skies.push_back(
        {sky.stem().string(), session.times().measure("sky", [&] { return pictures::readNamedSky(sky); })});
  if (!skies.empty()) return skies;
  const bool lightBaked = bake.irradiance || bake.lightMap || bake.lightGroups;
  pictures::PictureSky own = pictures::choosePictureSky(session, {}, false, lightBaked, loaded, std::nullopt);
  if (own.map)
    skies.push_back({own.studio ? "studio" : own.name.empty() ? "sky" : own.name, std::move(*own.map)});
  return skies;
}

void tellWhatIsShown(const Console& console, const nlohmann::ordered_json& report) {
  std::string shown;
  for (const auto& shading : report["shadings"])
    shown += fmt::format("{}{} {:.2f} MB", shown.empty() ? "" : ", ", shading["name"].get<std::string>(),
                         1e-6 * shading["bytes"].get<double>());
  console.line("shadings", shown);
  for (const auto& part : report["leftOut"])
    console.line("left out",
                 fmt::format("{}: {}", part["what"].get<std::string>(), part["why"].get<std::string>()));
  if (!report.contains("animation")) return;
  const auto& animation = report["animation"];
  console.line("animation", fmt::format("{} {:.2f} MB", animation["name"].get<std::string>(),
                                        1e-6 * animation["bytes"].get<double>()));
  for (const auto& note : animation["notes"]) console.line("", note.get<std::string>());
}

}  // namespace

nlohmann::ordered_json exportPage(Session& session, const ExportOptions& options, const LoadedScene& loaded,
                                  const Bake& bake) {
  checkExportOutput("-o", options);
  const viewer::RenderInputs inputs{loaded.scene, loaded.compiled, &bake};
  const viewer::PageScene scene = session.times().measure("export", [&] {
    return viewer::pageScene({inputs, *loaded.document, options.baked.stem().string(),
                              skiesOf(session, options, loaded, bake), options.exposure.value_or(1.0)});
  });
  const std::string page = viewer::webPage(scene);
  if (!options.dryRun) {
    const StopSignals::SafePoints writing(session.signals());
    OutputFiles files;
    files.add(options.output, std::as_bytes(std::span(page)));
    files.commit();
  }
  session.console().line(
      options.dryRun ? "would write" : "wrote",
      fmt::format("{}, {:.2f} MB", options.output.string(), 1e-6 * static_cast<double>(page.size())));
  nlohmann::ordered_json report = {{"target", options.target}, {"bytes", page.size()}};
  report.update(viewer::pageReport(scene));
  tellWhatIsShown(session.console(), report);
  return report;
}

}  // namespace prelight::cli
