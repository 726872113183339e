#include "cli/commands/planned_bake.h"

#include <fmt/format.h>

#include "cli/report.h"
#include "cli/work_estimate.h"
#include "io/plan_json.h"
#include "techniques/light_map/light_map_file.h"

namespace prelight::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Returns a text such as "about 12 s with the machine to itself, 23 s of processor time, on DEVICE; ...".
std::string timeText(const PlannedBake& planned, const BakeEstimate& estimate) {
  if (planned.animated)
    return "not estimated: the number of different keys becomes known only as they are baked";
  if (!estimate.seconds)
    return "not estimated: the number of rays for this error becomes known only as they are cast";
  if (planned.request.effort.seconds)
    return fmt::format("{} on {}, as asked for", shortSeconds(*estimate.seconds),
                       estimate.sample.device.name);
  return fmt::format("{}; from {} of {} rays per vertex, which took {}",
                     textOf({*estimate.seconds, estimate.processorSeconds}, estimate.sample.device),
                     estimate.rays, planned.request.effort.rays, shortSeconds(estimate.spent));
}

}  // namespace

void printPlannedBake(const Console& console, const PlannedBake& planned, const BakeEstimate& estimate) {
  const BakeRun& sample = estimate.sample;
  console.line("would bake", techniqueText(planned.request));
  printPlan(console, sample.plan);
  console.line("would write", fmt::format("{}: about {}", planned.output.string(),
                                          shortBytes(static_cast<double>(planned.bytes))));
  if (sample.bake.lightMap)
    console.line("", fmt::format("{}: {} x {} texels", lightMapPath(planned.output).string(),
                                 sample.bake.lightMap->layout.width, sample.bake.lightMap->layout.height));
  console.line("time", timeText(planned, estimate));
}

Json plannedBakeReport(const PlannedBake& planned, const BakeEstimate& estimate, const LoadedScene& loaded,
                       Session& session) {
  return reportOf("bake", {{"dryRun", true},
                           {"scene", loaded.path.string()},
                           {"output", planned.output.string()},
                           {"options", toJson(planned.request)},
                           {"device", toJson(estimate.sample.device)},
                           {"outputBytes", planned.bytes},
                           {"estimatedSeconds", estimate.seconds ? Json(*estimate.seconds) : Json(nullptr)},
                           {"estimatedProcessorSeconds",
                            estimate.processorSeconds ? Json(*estimate.processorSeconds) : Json(nullptr)},
                           {"sample", {{"rays", estimate.rays}, {"seconds", estimate.spent}}},
                           {"plan", toJson(estimate.sample.plan)},
                           {"warnings", session.warnings()}});
}

}  // namespace prelight::cli
