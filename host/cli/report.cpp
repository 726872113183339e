#include "cli/report.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cctype>
#include <fstream>

#include "cli/commit.h"
#include "io/plan_json.h"
#include "options/shared_bake_options.h"
#include "techniques/registry/registry.h"

namespace prelight::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string kindName(DeviceKind kind) {
  switch (kind) {
    case DeviceKind::Cpu:
      return "cpu";
    case DeviceKind::Gpu:
      return "gpu";
    case DeviceKind::Other:
      break;
  }
  return "other";
}

/// Returns the kernel's own record if there is one, because getrusage() also counts the memory of the program
/// that started this one.
std::uint64_t peakResidentBytes() {
  std::ifstream status("/proc/self/status");
  std::uint64_t kib = 0;
  for (std::string word; status >> word;)
    if (word == "VmHWM:" && status >> kib) return kib * 1024;
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

Json stagesJson(const std::vector<std::pair<std::string, double>>& stages) {
  Json json = Json::object();
  for (const auto& [stage, seconds] : stages) json[stage] = json.value(stage, 0.0) + seconds;
  return json;
}

double castSeconds(const BakeReport& report) {
  double seconds = 0.0;
  for (const auto& [stage, time] : report.stageSeconds)
    if (stage == "cast" || stage == "volume" || stage == "texels" || stage == "form factors" ||
        stage == "direct light" || stage == "light map")
      seconds += time;
  return seconds;
}

double raysPerSecond(const BakeReport& report) {
  const double seconds = castSeconds(report);
  return seconds > 0.0 ? static_cast<double>(report.rays) / seconds : 0.0;
}

std::string radiosityText(const RadiosityReport& report) {
  return fmt::format("{} elements, {} form factors, {:.3g} iterations of {}, residual {:.2g}",
                     report.elements, shortCount(static_cast<double>(report.entries)), report.solve.sweeps(),
                     radiosityMethodNames[static_cast<std::size_t>(report.method)], report.solve.residual());
}

std::string lightMapText(const LightMap& map, bool denoised, const LightMapReport& report) {
  std::string text = fmt::format("{} x {} texels, {} charts{}", map.layout.width, map.layout.height,
                                 map.layout.chartCount, denoised ? ", denoised" : "");
  if (report.places > 0)
    text += fmt::format(
        ", light off by {} (rms at {} places)",
        report.error < 1e-3 ? std::string("less than 0.1 %") : fmt::format("{:.2g} %", 100.0 * report.error),
        report.places);
  if (!report.sizes) return text;
  const TexelSizeReport& sizes = *report.sizes;
  text += fmt::format(", texels of {:.2g} to {:.2g} m, expected error between them {:.2g} %", sizes.smallest,
                      sizes.largest, 100.0 * sizes.error);
  if (sizes.limited > 0)
    text += fmt::format("; {} charts need texels smaller than {:.2g} m (--texel-size)", sizes.limited,
                        sizes.smallest);
  return text;
}

/// Returns the name of an option as reports have it: "haarError" for "haar-error".
std::string memberOf(const OptionInfo& row) {
  std::string name;
  bool begins = false;
  for (const char c : std::string_view(row.name)) {
    if (c != '-') name += begins ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    begins = c == '-';
  }
  return name;
}

/// Adds the value of an option, if it has one.
void addValue(const Option<BakeRequest>& row, const BakeRequest& request, Json& json) {
  if (row.kind == OptionKind::Own) {
    if (row.isSet(request)) json[memberOf(row)] = row.text(request);
    return;
  }
  const std::optional<double> value = row.get(request);
  if (!value) return;
  if (row.kind == OptionKind::Flag)
    json[memberOf(row)] = *value != 0.0;
  else if (row.kind == OptionKind::Choice)
    json[memberOf(row)] = row.choices[static_cast<std::size_t>(*value)].name;
  else if (row.range.kind == NumberKind::Real)
    json[memberOf(row)] = *value;
  else
    json[memberOf(row)] = static_cast<std::uint64_t>(*value);
}

void printDetails(const Console& console, const BakeRun& run, const StageTimes& times) {
  if (!console.detailsWanted()) return;
  for (const std::string& note : run.report.notes) console.line("note", note);
  for (const auto& [stage, seconds] : times.stages())
    console.line("", fmt::format("{:<12}{:8.3f} s", stage, seconds));
  printPlan(console, run.plan);
}

}  // namespace

Json toJson(const DeviceInfo& device) {
  return {{"index", device.index},
          {"name", device.name},
          {"kind", kindName(device.kind)},
          {"vendor", device.vendor},
          {"platform", device.platform},
          {"platformVersion", device.platformVersion},
          {"driverVersion", device.driverVersion},
          {"openclVersion", device.openclVersion},
          {"computeUnits", device.computeUnits},
          {"globalMemory", device.globalMemory},
          {"maxAllocation", device.maxAllocation}};
}

Json toJson(const TexelSizeReport& sizes) {
  return {{"smallest", sizes.smallest},
          {"largest", sizes.largest},
          {"expectedError", sizes.error},
          {"specks", sizes.specks},
          {"limited", sizes.limited}};
}

Json toJson(const LightMap& map, const LightMapReport& report) {
  Json json = {{"width", map.layout.width},       {"height", map.layout.height},
               {"charts", map.layout.chartCount}, {"texels", map.layout.texels.size()},
               {"hiddenTexels", report.hidden},   {"rays", report.rays},
               {"seamJump", report.jumpAfter},    {"seamJumpBefore", report.jumpBefore}};
  if (report.places > 0) json["error"] = {{"rms", report.error}, {"places", report.places}};
  if (report.sizes) json["texelSizes"] = toJson(*report.sizes);
  return json;
}

Json toJson(const RadiosityReport& report) {
  Json residuals = Json::array();
  for (const ResidualPoint& point : report.solve.curve)
    residuals.push_back({{"sweeps", point.sweeps}, {"seconds", point.seconds}, {"residual", point.residual}});
  return {{"elements", report.elements},
          {"patchSize", report.patchSize},
          {"formFactors", report.entries},
          {"formFactorRays", report.castRays},
          {"shadowRays", report.directRays},
          {"solver", radiosityMethodNames[static_cast<std::size_t>(report.method)]},
          {"converged", report.solve.converged},
          {"residual", report.solve.residual()},
          {"residuals", std::move(residuals)}};
}

Json toJson(const BakeRequest& request) {
  Json json = {{"bounces", request.bounces}};
  for (const Technique& technique : techniques()) {
    const auto rows = technique.options.rows;
    if (std::ranges::any_of(rows, [&](const auto& row) { return row.isSet(request); }))
      for (const Option<BakeRequest>& row : rows) addValue(row, request, json);
  }
  if (request.radiosity || request.lightMap) json["sky"] = request.radiosity.environment != nullptr;
  for (const Option<BakeRequest>& row : lightOptions())
    if (row.isSet(request)) addValue(row, request, json);
  for (const ShadowSetRequest& set : request.shadowSets)
    json["shadowSets"].push_back(
        fmt::format("{}:{}", fmt::join(set.receivers, ","), fmt::join(set.occluders, ",")));
  if (request.limits.nearest > 0.0) json["near"] = request.limits.nearest;
  if (request.limits.farthest > 0.0) json["far"] = request.limits.farthest;
  if (request.limits.obscurance > 0.0) json["obscurance"] = request.limits.obscurance;
  if (request.effort.error) json["error"] = *request.effort.error;
  if (request.effort.seconds) json["time"] = *request.effort.seconds;
  if (!request.effort.error && !request.effort.seconds) json["rays"] = request.effort.rays;
  json["maxMemory"] = request.memory();
  return json;
}

Json reportOf(const std::string& command, Json::initializer_list_t contents) {
  Json report = {{"command", command}, {"version", PRELIGHT_VERSION}, {"commit", commit()}};
  report.update(Json(contents));
  return report;
}

Json toJson(const StageTimes& times) { return stagesJson(times.stages()); }

Json bakeReport(const std::string& command, const LoadedScene& loaded, const std::filesystem::path& output,
                const BakeRequest& request, const BakeRun& run, Session& session) {
  const BakeReport& report = run.report;
  Json json =
      reportOf(command, {{"scene", loaded.path.string()},
                         {"output", output.string()},
                         {"options", toJson(request)},
                         {"seed", request.seed},
                         {"device", toJson(run.device)},
                         {"triangles", loaded.compiled.triangleCount()},
                         {"vertices", loaded.compiled.vertexCount()},
                         {"receivers", report.receivers},
                         {"rays", report.rays},
                         {"raysPerSecond", raysPerSecond(report)},
                         {"skippedRayFraction", report.skippedRayFraction},
                         {"estimatedError", {{"aoRms", report.aoErrorRms}, {"aoMax", report.aoErrorMax}}},
                         {"seconds", session.times().total()},
                         {"stages", toJson(session.times())},
                         {"processorSeconds", stagesJson(session.times().processor())},
                         {"memory",
                          {{"hostEstimate", run.plan.hostBytes},
                           {"deviceEstimate", run.plan.deviceBytes},
                           {"transport", run.plan.transportBytes},
                           {"bvh", report.bytesBvh},
                           {"peakResident", peakResidentBytes()}}},
                         {"plan", toJson(run.plan)},
                         {"notes", report.notes},
                         {"warnings", session.warnings()}});
  if (report.radiosity) json["radiosity"] = toJson(*report.radiosity);
  if (report.lightMap && run.bake.lightMap) json["lightMap"] = toJson(*run.bake.lightMap, *report.lightMap);
  return json;
}

void printBakeSummary(const Console& console, const BakeRequest& request, const BakeRun& run,
                      const StageTimes& times) {
  const BakeReport& report = run.report;
  console.line("device", run.device.name);
  console.line("baked", fmt::format("{}, seed {}", techniqueText(request), request.seed));
  if (!run.bake.info.visibility.empty())
    console.line("drawn", fmt::format("{} views by {}", shortCount(static_cast<double>(report.receivers)),
                                      run.bake.info.visibility));
  std::string rays = shortCount(static_cast<double>(report.rays));
  if (const double speed = raysPerSecond(report); speed > 0.0)
    rays += fmt::format(", {} per second", shortCount(speed));
  if (report.skippedRayFraction > 0.005)
    rays += fmt::format(", {:.0f} % of those allowed were not needed", 100.0 * report.skippedRayFraction);
  console.line("rays", rays);
  if (report.radiosity) console.line("radiosity", radiosityText(*report.radiosity));
  if (run.bake.lightMap) {
    console.line("light map", lightMapText(*run.bake.lightMap, request.lightMap.denoise, *report.lightMap));
    if (!report.lightMap->replaced.empty() && !console.detailsWanted())
      console.line("note", report.lightMap->replaced);
  }
  if (!request.castsReceivers()) return printDetails(console, run, times);
  console.line("error", fmt::format("AO {:.4f} rms, {:.4f} at the worst vertex (estimated standard error)",
                                    report.aoErrorRms, report.aoErrorMax));
  printDetails(console, run, times);
}

std::string sceneText(const LoadedScene& loaded) {
  const Scene& scene = loaded.scene;
  const auto count = [](std::size_t n, const char* one, const char* many) {
    return fmt::format("{} {}", n, n == 1 ? one : many);
  };
  return fmt::format("{}, {}, {}, {}, {}", count(scene.meshNodes.size(), "mesh node", "mesh nodes"),
                     count(loaded.compiled.triangleCount(), "triangle", "triangles"),
                     count(loaded.compiled.vertexCount(), "vertex", "vertices"),
                     count(scene.lights.size(), "light", "lights"),
                     count(scene.cameras.size(), "camera", "cameras"));
}

void printPasses(const Console& console, std::span<const PlannedPass> passes) {
  for (const PlannedPass& pass : passes)
    if (!pass.runs || console.detailsWanted())
      console.line(pass.runs ? "runs" : "skipped", fmt::format("{}: {}", pass.name, pass.reason));
}

void printPlan(const Console& console, const Plan& plan) {
  for (const PlannedPass& pass : plan.passes)
    console.line(pass.runs ? "runs" : "skipped", fmt::format("{}: {}", pass.name, pass.reason));
  console.line(
      "memory",
      fmt::format("{} on the host, {} on the device{}", shortBytes(static_cast<double>(plan.hostBytes)),
                  shortBytes(static_cast<double>(plan.deviceBytes)),
                  plan.transportBytes == 0
                      ? ""
                      : fmt::format(", of which {} stored transport",
                                    shortBytes(static_cast<double>(plan.transportBytes)))));
}

}  // namespace prelight::cli
