#include <fmt/format.h>

#include <array>
#include <span>

#include "base/atomic_file.h"
#include "benchmarks/measure.h"
#include "benchmarks/skip/measured_row.h"
#include "benchmarks/skip/rows.h"
#include "benchmarks/suites.h"
#include "prelight/error.h"

namespace prelight::benchmarks {

namespace {

std::vector<skip::Row> skipRows(const std::string& named) {
  std::vector<skip::Row> chosen;
  for (const skip::Row& row : skip::rows())
    if (row.name.find(named) != std::string::npos) chosen.push_back(row);
  return chosen;
}

void addResults(const skip::MeasuredRow& measured, std::vector<BenchmarkResult>& results) {
  for (std::size_t i = 0; i < measured.outcomes.size(); ++i) {
    const skip::Outcome& outcome = measured.outcomes[i];
    const std::string name = fmt::format("{}/{}", measured.row.name, skip::presenceNames[i]);
    const auto add = [&](const char* metric, double value, const char* unit) {
      results.push_back({"skip", name, metric, value, unit, {}, {}});
    };
    add("rays", static_cast<double>(outcome.rays), "");
    add("launches", static_cast<double>(outcome.launches), "");
    add("work-items", static_cast<double>(outcome.workItems), "");
    add("device bytes", static_cast<double>(outcome.deviceBytes), "B");
    add("values", static_cast<double>(outcome.values.size() * sizeof(float)), "B");
    add("processor time", outcome.cpuSeconds, "s");
  }
  const std::string name = fmt::format("{}/unneeded", measured.row.name);
  results.push_back({"skip", name, "cost", measured.cost, "", "absent", 1.0 / measured.cost});
  results.push_back({"skip", name, "same bits", measured.unchanged() ? 1.0 : 0.0, "", {}, {}});
}

}  // namespace

bool hasSkipCase(const BenchmarkOptions& options) { return !skipRows(options.onlyCase).empty(); }

void runSkipSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run) {
  const std::vector<skip::Row> rows = skipRows(options.onlyCase);
  if (rows.empty())
    throw UsageError("--case " + options.onlyCase, "no case of `skip` has such a name",
                     "give a part of a row's name");
  StepCounter steps(run, "bench skip", rows.size());
  std::vector<BenchmarkResult>& results = run.results();
  std::vector<skip::MeasuredRow> measured;
  for (const skip::Row& row : rows) {
    measured.push_back(skip::measureRow(row, options.skipEffort, options.runs, device, run));
    addResults(measured.back(), results);
    steps.advance();
  }
  if (!options.folder.empty()) {
    const std::string table = skip::tableOf(measured);
    const std::array<std::span<const std::byte>, 1> pieces = {std::as_bytes(std::span(table))};
    writeFileAtomically(options.folder / "skip.md", pieces);
  }
}

}  // namespace prelight::benchmarks
