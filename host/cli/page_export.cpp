#include "cli/page_export.h"

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "cli/output_file.h"
#include "cli/picture_sky.h"
#include "viewer/web/web_page.h"

namespace prelight::cli {
namespace {

/// Those that are asked for, or the one that a picture would have.
std::vector<viewer::PageSky> skiesOf(Session& session, const PageOptions& options, const LoadedScene& loaded,
                                     const Bake& bake) {
  std::vector<viewer::PageSky> skies;
  for (const std::filesystem::path& sky : options.skies)
    skies.push_back({sky.stem().string(), session.times().measure("sky", [&] { return readNamedSky(sky); })});
  if (!skies.empty()) return skies;
  const bool lightBaked = bake.irradiance || bake.lightMap || bake.lightGroups;
  PictureSky own = choosePictureSky(session, {}, false, lightBaked, loaded, std::nullopt);
  if (own.map) skies.push_back({own.studio ? "studio" : "sky", std::move(*own.map)});
  return skies;
}

}  // namespace

void exportPage(Session& session, const std::filesystem::path& baked, const std::filesystem::path& output,
                const LoadOptions& load, const PageOptions& options) {
  LoadedScene loaded = session.load(baked, load);
  const Bake bake = requireBake(session, loaded);
  checkOutputFile("-o", output, {".html"});
  const viewer::RenderInputs inputs{loaded.scene, loaded.compiled, &bake};
  const std::string page = session.times().measure("export", [&] {
    return viewer::webPage({inputs, loaded.document, baked.stem().string(),
                            skiesOf(session, options, loaded, bake), options.exposure.value_or(1.0)});
  });
  const StopSignals::Writing writing(session.signals());
  OutputFiles files;
  files.add(output, std::as_bytes(std::span(page)));
  files.commit();
  session.console().line(
      "wrote", fmt::format("{}, {:.2f} MB", output.string(), 1e-6 * static_cast<double>(page.size())));
  session.console().json({{"command", "export"},
                          {"version", PRELIGHT_VERSION},
                          {"baked", baked.string()},
                          {"output", output.string()},
                          {"target", "web"},
                          {"bytes", page.size()},
                          {"warnings", session.warnings()}});
}

}  // namespace prelight::cli
