#include "prelight/export.h"

#include <fmt/format.h>

#include <bit>
#include <optional>

#include "export/export_bake.h"
#include "export/export_volume.h"
#include "library/library_call.h"
#include "prelight/error.h"
#include "prelight/load.h"

namespace prelight {

namespace {

ExportRequest requestOf(const ExportOptions& options, const Bake& bake) {
  ExportRequest request{.dryRun = options.dryRun};
  request.target = exportNamed<ExportTarget>("ExportOptions::target", options.target, exportTargetNames);
  request.lights = exportNamed<BakedLights>("ExportOptions::lights", options.lights, bakedLightsNames);
  request.form = options.form.empty()
                     ? usualForm(bake, request.target)
                     : exportNamed<ExportForm>("ExportOptions::form", options.form, exportFormNames);
  requireTarget(request.form, request.target);
  requireForm(bake, request.form, request.target);
  if (request.form == ExportForm::Probes)
    throw UsageError("ExportOptions::form probes", "light of probes is gathered, not baked",
                     "use the command prelight export");
  return request;
}

LightMap castOcclusion(const LoadedScene& scene, const Bake& bake, const ExportOptions& options) {
  constexpr std::uint32_t fewest = 16, most = 8192;
  if (options.rays < fewest || options.rays > most)
    throw UsageError("ExportOptions::rays", fmt::format("got {}", options.rays),
                     fmt::format("expected {} to {}", fewest, most));
  LibraryCall call(options.device);
  OcclusionMapReport report;
  return occlusionForExport(scene.scene, scene.compiled, bake, std::bit_floor(options.rays), call.device(),
                            call.progress(), report);
}

void requireOutput(const std::filesystem::path& output, const ExportRequest& request) {
  if (output.extension() == ".gltf")
    throw UsageError(output.string(), "a scene of one file is written as .glb",
                     "name a .glb, or a folder for the scene and its files");
  if (request.form == ExportForm::Volume && output.extension() == ".glb")
    throw UsageError(output.string(), "a .glb cannot hold values for points in the air", "name a folder");
}

}  // namespace

ExportResult exportScene(const std::filesystem::path& output, const LoadedScene& scene, const Bake& bake,
                         const ExportOptions& options) {
  const ExportRequest request = requestOf(options, bake);
  requireOutput(output, request);
  const std::string name = options.name.empty() ? scene.path.stem().string() : options.name;
  std::optional<LightMap> occlusion;
  if (request.form == ExportForm::Occlusion) occlusion = castOcclusion(scene, bake, options);
  const ExportReport report = request.form == ExportForm::Volume
                                  ? exportTransferVolume(*bake.volume, output, name, request)
                                  : exportBake({*scene.document, scene.scene, scene.compiled, bake, nullptr,
                                                occlusion ? &*occlusion : nullptr},
                                               output, name, request);
  ExportResult result{.mapWidth = report.mapWidth, .mapHeight = report.mapHeight};
  for (const ExportedFile& file : report.files)
    result.files.push_back({file.name, file.contents, file.bytes});
  return result;
}

}  // namespace prelight
