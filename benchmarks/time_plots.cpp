#include "benchmarks/time_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace prelight::benchmarks {

std::string bakePlot(const Results& results, const std::string& subtitle) {
  BarChart chart{"Seconds of a bake, by stage", subtitle, "seconds", {}, {}};
  for (const BenchmarkResult& result : results) {
    const auto [scene, label] = splitCase(result.case_);
    std::vector<Bar>& bars = groupNamed(chart.groups, scene).bars;
    if (bars.empty() || bars.back().label != label) bars.push_back({label, {}, 0.0, {}});
    if (result.metric == "total")
      bars.back().note = fmt::format("{:.2f} s", result.value);
    else
      bars.back().parts.push_back({result.value, stageColor(chart.legend, result.metric)});
  }
  return drawBarChart(chart);
}

std::string relightPlot(const Results& results, const std::string& subtitle) {
  BarChart chart{"Bytes a second of processor time, against copying", subtitle, "GB/s a core", {}, {}};
  chart.legend = {{"kernel", palette[0]}, {"copy", "#a9b0b8"}};
  for (const BenchmarkResult& result : results) {
    if (result.metric != "bandwidth a core" || !result.ratio) continue;
    const double gigabytes = result.value * 1e-9;
    groupNamed(chart.groups, "")
        .bars.push_back({result.case_,
                         {{gigabytes, palette[0]}},
                         gigabytes / *result.ratio,
                         fmt::format("{:.3g} GB/s, {:.2g} x", gigabytes, *result.ratio)});
  }
  return drawBarChart(chart);
}

/// Stages of frames, as far as the suite has frames.
std::string updatePlot(const Results& results, const std::string& subtitle) {
  BarChart chart{
      "A frame in which light follows what moves, without drawing", subtitle, "milliseconds", {}, {}};
  const std::array<const char*, 5> stages = {"scene", "photons", "density", "gather", "caustics"};
  for (std::size_t i = 0; i < stages.size(); ++i) chart.legend.push_back({stages[i], palette[i]});
  for (const BenchmarkResult& result : results) {
    const auto [scene, detection] = splitCase(result.case_);
    if (result.metric == "frame") {
      chart.legend.resize(stages.size());
      chart.legend.push_back({result.peer + ", with drawing", "#a9b0b8"});
      groupNamed(chart.groups, scene)
          .bars.push_back({detection,
                           {},
                           1e3 * result.value * *result.ratio,
                           fmt::format("{:.3g} ms", 1e3 * result.value)});
    }
    const auto stage = std::find(stages.begin(), stages.end(), result.metric);
    std::vector<Bar>& bars = groupNamed(chart.groups, scene).bars;
    if (stage == stages.end() || bars.empty() || bars.back().label != detection) continue;
    const std::string color = palette[static_cast<std::size_t>(stage - stages.begin())];
    bars.back().parts.push_back({1e3 * result.value, color});
  }
  std::erase_if(chart.groups, [](const BarGroup& group) { return group.bars.empty(); });
  return drawBarChart(chart);
}

std::string windowPlot(const Results& results, const std::string& subtitle) {
  BarChart chart{"A frame of the window", subtitle, "ms, the median of all", {}, {}};
  for (const BenchmarkResult& result : results) {
    if (result.metric != "median frame") continue;
    const auto [scene, movement] = splitCase(result.case_);
    groupNamed(chart.groups, scene)
        .bars.push_back(
            {movement, {{result.value, palette[0]}}, 0.0, fmt::format("{:.3g} ms", result.value)});
  }
  return drawBarChart(chart);
}

std::string windowPartsPlot(const Results& results, const std::string& subtitle) {
  BarChart chart{"What a frame of the window costs", subtitle, "ms of processor time, all threads", {}, {}};
  for (const BenchmarkResult& result : results) {
    if (!result.metric.starts_with("part: ") || result.value < 0.1) continue;
    const auto [scene, setting] = splitCase(result.case_);
    const auto [shading, movement] = splitCase(setting);
    std::vector<Bar>& bars = groupNamed(chart.groups, scene + ", " + shading).bars;
    if (bars.empty() || bars.back().label != movement) bars.push_back({movement, {}, 0.0, ""});
    bars.back().parts.push_back({result.value, stageColor(chart.legend, result.metric.substr(6))});
    double sum = 0.0;
    for (const Bar::Part& part : bars.back().parts) sum += part.value;
    bars.back().note = fmt::format("{:.3g} ms", sum);
  }
  return drawBarChart(chart);
}

}  // namespace prelight::benchmarks
