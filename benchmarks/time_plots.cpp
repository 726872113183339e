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

/// A row of `viewer` that tells of a movement, and not of the suite or of OpenGL.
bool isOfMovement(const ViewerCase& measured) { return !measured.movement.empty(); }

std::string viewerSize(const std::string& size) {
  const std::size_t by = size.find('x');
  return size.substr(0, by) + " x " + size.substr(by + 1) + " pixels";
}

/// A dot a scene, in rows of shadings and groups of sizes; `what` follows the latter's names.
void addViewerDots(const Results& results, const std::string& metric, const std::string& movement,
                   const std::string& what, DotChart& chart) {
  for (const BenchmarkResult& result : results) {
    const ViewerCase measured = viewerCase(result.case_);
    if (result.metric != metric || measured.movement != movement || !(result.value > 0.0)) continue;
    std::vector<DotRow>& rows = groupNamed(chart.groups, viewerSize(measured.size) + what).rows;
    auto row = std::find_if(rows.begin(), rows.end(),
                            [&](const DotRow& some) { return some.label == measured.shading; });
    if (row == rows.end()) row = rows.insert(rows.end(), {measured.shading, {}});
    row->dots.push_back({result.value, stageColor(chart.legend, measured.scene)});
  }
}

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
  DotChart chart{"A frame of the window while the camera orbits",
                 subtitle,
                 "ms by the clock, the median of all",
                 {},
                 {}};
  addViewerDots(results, "median frame", "orbit", "", chart);
  return drawDotChart(chart);
}

std::string viewerPartsPlot(const Results& results, const std::string& subtitle) {
  BarChart chart{
      "What a frame costs while a light is dragged", subtitle, "ms of processor time, all threads", {}, {}};
  std::string size;  // the first: of others not all parts may have been measured
  for (const BenchmarkResult& result : results) {
    const ViewerCase measured = viewerCase(result.case_);
    if (!isOfMovement(measured)) continue;
    if (size.empty()) size = measured.size;
    if (!result.metric.starts_with("part: ") || measured.size != size || measured.movement != "moving light")
      continue;
    std::vector<Bar>& bars = groupNamed(chart.groups, measured.scene).bars;
    if (bars.empty() || bars.back().label != measured.shading)
      bars.push_back({measured.shading, {}, 0.0, ""});
    bars.back().parts.push_back({result.value, stageColor(chart.legend, result.metric.substr(6))});
    double sum = 0.0;
    for (const Bar::Part& part : bars.back().parts) sum += part.value;
    bars.back().note = fmt::format("{:.3g} ms", sum);
  }
  if (!size.empty()) chart.axis += ", " + viewerSize(size);
  return drawBarChart(chart);
}

std::string viewerLatencyPlot(const Results& results, const std::string& subtitle) {
  DotChart chart{
      "From a dragged light to the picture", subtitle, "ms by the clock, the median of a few", {}, {}};
  for (const char* which : {"next", "finished"})
    addViewerDots(results, fmt::format("latency to the {} picture", which), "moving light",
                  fmt::format(": to the {} picture", which), chart);
  return drawDotChart(chart);
}

}  // namespace prelight::benchmarks
