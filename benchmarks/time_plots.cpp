#include "benchmarks/time_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace prelight::benchmarks {

namespace {

/// "shapes/sh/640x360/orbit".
struct ViewerCase {
  std::string scene, shading, size, movement;
};

ViewerCase viewerCase(const std::string& name) {
  const auto [scene, afterScene] = splitCase(name);
  const auto [shading, afterShading] = splitCase(afterScene);
  const auto [size, movement] = splitCase(afterShading);
  return {scene, shading, size, movement};
}

/// Sizes come in one order for every scene, the largest last.
std::string lastSize(const Results& results) { return viewerCase(results.back().case_).size; }

}  // namespace

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

std::string viewerPlot(const Results& results, const std::string& subtitle) {
  BarChart chart{"A frame of the window while the camera orbits", subtitle, "ms, the median of all", {}, {}};
  for (const BenchmarkResult& result : results) {
    const ViewerCase measured = viewerCase(result.case_);
    if (result.metric != "median frame" || measured.movement != "orbit") continue;
    groupNamed(chart.groups, measured.scene + ", " + measured.size)
        .bars.push_back(
            {measured.shading, {{result.value, palette[0]}}, 0.0, fmt::format("{:.3g} ms", result.value)});
  }
  return drawBarChart(chart);
}

std::string viewerPartsPlot(const Results& results, const std::string& subtitle) {
  BarChart chart{"What a frame of the window costs", subtitle, "ms of processor time, all threads", {}, {}};
  const std::string size = lastSize(results);
  for (const BenchmarkResult& result : results) {
    const ViewerCase measured = viewerCase(result.case_);
    if (!result.metric.starts_with("part: ") || result.value < 0.1 || measured.size != size) continue;
    std::vector<Bar>& bars = groupNamed(chart.groups, measured.scene + ", " + measured.shading).bars;
    if (bars.empty() || bars.back().label != measured.movement)
      bars.push_back({measured.movement, {}, 0.0, ""});
    bars.back().parts.push_back({result.value, stageColor(chart.legend, result.metric.substr(6))});
    double sum = 0.0;
    for (const Bar::Part& part : bars.back().parts) sum += part.value;
    bars.back().note = fmt::format("{:.3g} ms", sum);
  }
  return drawBarChart(chart);
}

std::string viewerLatencyPlot(const Results& results, const std::string& subtitle) {
  BarChart chart{"From an input to the finished picture", subtitle, "ms, the median of a few", {}, {}};
  const std::string size = lastSize(results);
  for (const BenchmarkResult& result : results) {
    const ViewerCase measured = viewerCase(result.case_);
    if (result.metric != "latency to the finished picture" || measured.size != size) continue;
    groupNamed(chart.groups, measured.scene + ", " + measured.shading)
        .bars.push_back(
            {measured.movement, {{result.value, palette[0]}}, 0.0, fmt::format("{:.3g} ms", result.value)});
  }
  return drawBarChart(chart);
}

}  // namespace prelight::benchmarks
