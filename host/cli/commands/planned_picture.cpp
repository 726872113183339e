#include "cli/commands/planned_picture.h"

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "cli/report.h"
#include "images/add_picture.h"
#include "io/plan_json.h"

namespace prelight::cli {

using Json = nlohmann::ordered_json;

std::uint64_t encodedBytes(const std::filesystem::path& path, const Picture& picture,
                           const std::vector<PictureChannel>& channels) {
  OutputFiles counted({}, FileWork::Count);
  addPicture(counted, path, picture, channels);
  return counted.bytesOf(path);
}

void printPlannedPicture(const Console& console, const PlannedPicture& planned) {
  console.line("would draw", fmt::format("{}x{}, {}", planned.width, planned.height, planned.how));
  printPasses(console, planned.plan);
  console.line("would write", fmt::format("{}: about {}", planned.output.string(),
                                          shortBytes(static_cast<double>(planned.bytes))));
  console.line("time", planned.estimate
                           ? fmt::format("{}; {}", textOf(*planned.estimate, planned.device), planned.time)
                           : planned.time);
}

void addPlannedPicture(const PlannedPicture& planned, Json& report) {
  const std::optional<WorkEstimate>& estimate = planned.estimate;
  report.update({{"dryRun", true},
                 {"output", planned.output.string()},
                 {"width", planned.width},
                 {"height", planned.height},
                 {"outputBytes", planned.bytes},
                 {"device", toJson(planned.device)},
                 {"estimatedSeconds", estimate ? Json(estimate->seconds) : Json(nullptr)},
                 {"estimatedProcessorSeconds",
                  estimate && estimate->processorSeconds ? Json(*estimate->processorSeconds) : Json(nullptr)},
                 {"plan", toJson(planned.plan)}});
}

}  // namespace prelight::cli
