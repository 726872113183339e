#include "cli/air_export.h"

#include <fmt/format.h>

#include "cli/picture_sky.h"
#include "export/export_volume.h"
#include "projectors/light_map/light_map_file.h"
#include "scene/light_sources.h"

namespace prelight::cli {
namespace {

IrradianceVolume gatherFor(Session& session, const LoadedScene& loaded, const Bake& bake,
                           const ProbeOptions& options) {
  std::optional<Environment> asked;
  if (!options.environment.empty()) asked = readNamedSky(options.environment);
  const LitScene lit{loaded.compiled, loaded.scene.images, loaded.compiled.lights,
                     shiningSky(asked ? &*asked : loaded.sky.get())};
  const Device device =
      session.times().measure("device", [&] { return Device::open(session.deviceOptions()); });
  ProbeReport report;
  const std::vector<glm::vec3> irradiance = irradianceOf(*bake.lightMap).pixels;
  IrradianceVolume volume = session.times().measure("probes", [&] {
    return gatherProbes(lit, bake.lightMap->layout, irradiance, options.request, device, session.progress(),
                        report);
  });
  session.progress().clear();
  const glm::ivec3 size = volume.grid.size;
  session.console().line(
      "probes",
      fmt::format("{} x {} x {}, {:.3g} m apart; {} moved out of objects, {} left in them", size.x, size.y,
                  size.z, volume.grid.cell(), report.placement.moved, report.placement.inside));
  return volume;
}

}  // namespace

void addProbeOptions(CLI::App& app, ProbeOptions& options) {
  ProbeRequest& request = options.request;
  app.add_option("--probes", request.size, "probes along the scene's longest side, 2 to 256; of --as probes")
      ->check(CLI::Range(2, ProbeRequest::mostSize))
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--probe-order", request.order, "bands of their spherical harmonics, 1 to 3")
      ->check(CLI::Range(1, ProbeRequest::mostOrder))
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--rays", request.rays, "of a probe, 256 to 8192")
      ->check(CLI::Range(256u, 8192u))
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--seed", request.seed, "of the probes' random numbers")
      ->type_name("N")
      ->capture_default_str();
  addSkyOption(app, options.environment, "sky that probes see; give the one that was baked with");
}

ExportReport exportAir(Session& session, const LoadedScene& loaded, const Bake& bake,
                       const std::filesystem::path& output, const std::string& name,
                       const ExportRequest& request, const ProbeOptions& options) {
  if (output.extension() == ".glb")
    throw UsageError("-o " + output.string(), "numbers of points in the air do not go into a .glb",
                     "name a folder");
  requireForm(bake, request.form);
  if (request.form == ExportForm::Volume) {
    const StopSignals::Writing writing(session.signals());
    return exportTransferVolume(*bake.volume, output, name, request);
  }
  const IrradianceVolume volume = gatherFor(session, loaded, bake, options);
  const StopSignals::Writing writing(session.signals());
  return exportProbes(volume, output, name, request);
}

}  // namespace prelight::cli
