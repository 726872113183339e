#include "cli/commands/air_export.h"

#include <fmt/format.h>

#include "export/export_volume.h"
#include "export/exported_contents.h"
#include "pictures/named_sky.h"
#include "pictures/recorded_sky.h"
#include "scene/light_sources.h"
#include "techniques/light_map/light_map_file.h"

namespace prelight::cli {
namespace {

IrradianceVolume gatherFor(Session& session, const ExportOptions& options, const LoadedScene& loaded,
                           const Bake& bake) {
  pictures::PictureSky baked;
  if (!options.skies.empty())
    baked.map = pictures::readNamedSky(options.skies.front());
  else if (std::optional<pictures::PictureSky> recorded = pictures::bakedSkyOf(session, loaded))
    baked = *std::move(recorded);
  const LitScene lit{loaded.compiled, loaded.scene.images, loaded.compiled.lights,
                     shiningSky(baked.map ? &*baked.map : loaded.sky.get()), baked.rotation};
  const Device device =
      session.times().measure("device", [&] { return Device::open(session.deviceOptions()); });
  ProbeReport report;
  ProbeRequest request = options.probes;
  request.rays = options.rays.value_or(request.rays);
  const std::vector<glm::vec3> irradiance = irradianceOf(*bake.lightMap).pixels;
  IrradianceVolume volume = session.times().measure("probes", [&] {
    return gatherProbes(lit, bake.lightMap->layout, irradiance, request, device, session.progress(), report);
  });
  session.progress().clear();
  const glm::ivec3 size = volume.grid.size;
  session.console().line(
      "probes",
      fmt::format("{} x {} x {}, {:.3g} m apart; {} moved out of objects, {} left in them", size.x, size.y,
                  size.z, volume.grid.cell(), report.placement.moved, report.placement.inside));
  return volume;
}

ExportReport withContents(ExportReport report, const LoadedScene& loaded, const Bake& bake,
                          const ExportRequest& request) {
  report.contents = exportedContents(bake, loaded.compiled.vertexCount(), request);
  return report;
}

}  // namespace

ExportReport exportAir(Session& session, const ExportOptions& options, const ExportRequest& request,
                       const LoadedScene& loaded, const Bake& bake) {
  if (options.output.extension() == ".glb")
    throw UsageError("-o " + options.output.string(), "a .glb cannot hold values for points in the air",
                     "name a folder");
  const std::string name = options.baked.stem().string();
  if (request.form == ExportForm::Volume) {
    const StopSignals::SafePoints writing(session.signals());
    return withContents(exportTransferVolume(*bake.volume, options.output, name, request), loaded, bake,
                        request);
  }
  const IrradianceVolume volume = gatherFor(session, options, loaded, bake);
  const StopSignals::SafePoints writing(session.signals());
  return withContents(exportProbes(volume, options.output, name, request), loaded, bake, request);
}

}  // namespace prelight::cli
