#include "benchmarks/transfer_plots.h"

#include <fmt/format.h>

#include <algorithm>

#include "benchmarks/charts.h"

namespace prelight::benchmarks {

namespace {

constexpr const char* blue = "#2f6db5";
constexpr const char* orange = "#d97b29";
constexpr const char* grey = "#a9b0b8";

std::string sceneOf(const std::string& name) { return name.substr(0, name.find('/')); }
std::string settingOf(const std::string& name) {
  return name.substr(std::min(name.size(), name.find('/') + 1));
}

Bar& barNamed(BarChart& chart, const std::string& group, const std::string& label) {
  auto g = std::find_if(chart.groups.begin(), chart.groups.end(),
                        [&](const BarGroup& x) { return x.name == group; });
  if (g == chart.groups.end()) g = chart.groups.insert(chart.groups.end(), BarGroup{group, {}});
  auto b = std::find_if(g->bars.begin(), g->bars.end(), [&](const Bar& x) { return x.label == label; });
  if (b == g->bars.end()) b = g->bars.insert(g->bars.end(), Bar{label, {}, 0.0, ""});
  return *b;
}

}  // namespace

std::string thesisPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle) {
  BarChart chart{"Precomputation at 10 000 rays a vertex, and a thesis of 2013", subtitle, "seconds", {}, {}};
  chart.legend = {{"visibility", blue}, {"bounce, matrices", orange}, {"thesis, both", grey}};
  for (const BenchmarkResult& result : results) {
    if (!result.metric.starts_with("pass")) continue;
    Bar& bar = barNamed(chart, sceneOf(result.case_), settingOf(result.case_));
    bar.parts.push_back({result.value, result.metric == "pass 1" ? blue : orange});
    if (result.ratio) bar.peer += result.value * *result.ratio;
    double total = 0.0;
    for (const Bar::Part& part : bar.parts) total += part.value;
    bar.note = fmt::format("{:.3g} s, {:.0f} s then", total, bar.peer);
  }
  return drawBarChart(chart);
}

std::string animationPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle) {
  BarChart chart{"Error of transfer between an animation's keys", subtitle, "relative RMS error, %", {}, {}};
  chart.legend = {{"error", blue}};
  for (const BenchmarkResult& result : results) {
    if (result.metric != "rms error") continue;
    Bar& bar = barNamed(chart, sceneOf(result.case_), settingOf(result.case_));
    bar.parts = {{100.0 * result.value, blue}};
    bar.note = fmt::format("{:.3g} %", 100.0 * result.value);
  }
  return drawBarChart(chart);
}

}  // namespace prelight::benchmarks
