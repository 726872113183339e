#include "benchmarks/run/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace prelight::benchmarks {

nlohmann::ordered_json toJson(const std::string& suite, const BenchmarkResult& result) {
  nlohmann::ordered_json json = {{"suite", suite},        {"case", result.case_}, {"metric", result.metric},
                                 {"value", result.value}, {"unit", result.unit},  {"peer", nullptr},
                                 {"ratio", nullptr}};
  if (!result.peer.empty()) json["peer"] = result.peer;
  if (result.ratio) json["ratio"] = *result.ratio;
  return json;
}

SuiteRun::SuiteRun(Progress& outer, Keep keep) : outer_(outer), keep_(std::move(keep)) {}

SuiteRun::~SuiteRun() = default;

void SuiteRun::report(std::string_view stage, double fraction) {
  finish();
  const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (fraction <= 0.0 || fraction >= 1.0) return outer_.report(stage, fraction);
  outer_.report(fmt::format("{}, {:>7} left", stage, clockText(spent * (1.0 - fraction) / fraction)),
                fraction);
}

void SuiteRun::finish() {
  if (kept_ == results_.size()) return;
  const std::span<const BenchmarkResult> fresh = std::span(results_).subspan(kept_);
  kept_ = results_.size();
  keep_(fresh);
}

std::string clockText(double seconds) {
  const auto whole = static_cast<long long>(std::lround(std::clamp(seconds, 0.0, 1e9)));
  const long long hours = whole / 3600, minutes = whole / 60 % 60;
  if (hours > 0) return fmt::format("{}:{:02}:{:02}", hours, minutes, whole % 60);
  return fmt::format("{}:{:02}", minutes, whole % 60);
}

}  // namespace prelight::benchmarks
