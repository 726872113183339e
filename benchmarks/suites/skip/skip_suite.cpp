#include "benchmarks/suites/skip/skip_suite.h"

#include <fmt/format.h>

#include <array>
#include <span>

#include "base/atomic_file.h"
#include "benchmarks/run/measure.h"
#include "benchmarks/suites/skip/carry_out.h"
#include "benchmarks/suites/skip/rows.h"
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
      results.push_back({name, metric, value, unit, {}, {}});
    };
    add("rays", static_cast<double>(outcome.rays), "");
    add("launches", static_cast<double>(outcome.launches), "");
    add("work-items", static_cast<double>(outcome.workItems), "");
    add("device bytes", static_cast<double>(outcome.deviceBytes), "B");
    add("values", static_cast<double>(outcome.values.size() * sizeof(float)), "B");
    add("processor time", outcome.cpuSeconds, "s");
  }
  const std::string name = fmt::format("{}/unneeded", measured.row.name);
  results.push_back({name, "cost", measured.cost, "", "absent", 1.0 / measured.cost});
  results.push_back({name, "same bits", measured.unchanged() ? 1.0 : 0.0, "", {}, {}});
}

}  // namespace

bool hasSkipCase(const SkipOptions& options) { return !skipRows(options.onlyCase).empty(); }

void runSkip(const Device& device, const SkipOptions& options, SuiteRun& run) {
  const std::vector<skip::Row> rows = skipRows(options.onlyCase);
  if (rows.empty())
    throw UsageError("--case " + options.onlyCase, "no case of `skip` has such a name",
                     "give a part of a row's name");
  StepCounter steps(run, "bench skip", rows.size());
  std::vector<BenchmarkResult>& results = run.results();
  std::vector<skip::MeasuredRow> measured;
  for (const skip::Row& row : rows) {
    measured.push_back(skip::measureRow(row, options, options.runs, device, run));
    addResults(measured.back(), results);
    steps.advance();
  }
  if (!options.folder.empty()) {
    const std::string table = skip::tableOf(measured);
    const std::array<std::span<const std::byte>, 1> pieces = {std::as_bytes(std::span(table))};
    writeFileAtomically(options.folder / "skip.md", pieces);
  }
}

const OptionTable<SkipOptions>& SkipOptions::table() {
  static const OptionTable<SkipOptions> table =
      OptionTable<SkipOptions>()
          .add("rays", &SkipOptions::rays, 256, 4, "rays per vertex, texel or element")
          .add("photons", &SkipOptions::photons, 100000, 200, "photons of pictures and light maps")
          .add("texelSize", &SkipOptions::texelSize, 0.06, 0.5, "size of the texels of light maps, m", {.least = 0.001})
          .add("patchSize", &SkipOptions::patchSize, 0.0, 1.0,
               "size of the patches of radiosity, m; 0: chosen by the program", {.least = 0})
          .add("side", &SkipOptions::side, 192, 8, "pixels per side of pictures", {.most = 4096})
          .add("samples", &SkipOptions::samples, 16, 1, "samples per pixel");
  return table;
}

std::unique_ptr<Suite> skipSuite() {
  SuiteOf<SkipOptions>::Runners parts = {
      {"skip", "rays, launches, bytes and seconds of features that are absent, present in vain, and needed",
       runSkip, hasSkipCase},
  };
  return std::make_unique<SuiteOf<SkipOptions>>(
      "skip", "cost of features that are absent, present in vain, and needed", std::move(parts));
}

}  // namespace prelight::benchmarks
