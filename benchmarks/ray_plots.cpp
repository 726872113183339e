#include "benchmarks/ray_plots.h"

#include <fmt/format.h>

#include <algorithm>

namespace prelight::benchmarks {

namespace {

/// "bake-order 250k" -> "bake-order" and "250k".
std::pair<std::string, std::string> splitSize(const std::string& name) {
  const std::size_t space = name.rfind(' ');
  return {name.substr(0, space), space == std::string::npos ? "" : name.substr(space + 1)};
}

/// "250k" -> 250000.
double triangleCount(const std::string& size) { return std::stod(size) * (size.ends_with('M') ? 1e6 : 1e3); }

/// Curves over the number of triangles of the results of one metric, two for each kind of case: Prelight's
/// and the peer's, whose values follow from the ratios (`more`: the more of it the better).
std::vector<Curve> curvesOverSize(const Results& results, const std::string& metric, double unit, bool more) {
  std::vector<Curve> curves;
  for (const BenchmarkResult& result : results) {
    if (result.metric != metric) continue;
    const auto [kind, size] = splitSize(result.case_);
    const auto add = [&, triangles = triangleCount(size)](const std::string& name, CurveStyle style,
                                                          double value) {
      auto curve = std::find_if(curves.begin(), curves.end(), [&](const Curve& c) { return c.name == name; });
      if (curve == curves.end())
        curve = curves.insert(curves.end(), {name, palette[curves.size() / 2 % palette.size()], style, {}});
      curve->points.push_back({triangles, value * unit});
    };
    add(kind + ", Prelight", CurveStyle::Strong, result.value);
    if (result.ratio)
      add(kind + ", Embree", CurveStyle::Dashed,
          more ? result.value / *result.ratio : result.value * *result.ratio);
  }
  return curves;
}

}  // namespace

std::string castPlot(const Results& results, const std::string& subtitle) {
  BarChart chart{"Rays a second through each tree", subtitle, "million rays a second", {}, {}};
  for (const BenchmarkResult& result : results) {
    const auto [scene, setting] = splitCase(result.case_);
    const auto [order, query] = splitCase(setting);
    const double millions = result.value * 1e-6;
    Bar bar{
        fmt::format("{}, {}", order, query), {{millions, palette[0]}}, 0.0, fmt::format("{:.3g}", millions)};
    if (result.ratio) {
      bar.peer = millions / *result.ratio;
      bar.note += fmt::format(", {:.2f} x", *result.ratio);
      chart.legend = {{"the device's tree", palette[0]}, {result.peer, "#a9b0b8"}};
    }
    groupNamed(chart.groups, scene).bars.push_back(std::move(bar));
  }
  return drawBarChart(chart);
}

std::string raysPlot(const Results& results, const std::string& subtitle) {
  BarChart chart{"Rays a second through detailed rooms", subtitle, "million rays a second", {}, {}};
  chart.legend = {{"Prelight", palette[0]}};
  for (const BenchmarkResult& result : results) {
    if (result.metric != "throughput") continue;
    const auto [kind, size] = splitSize(result.case_);
    const double millions = result.value * 1e-6;
    Bar bar{kind, {{millions, palette[0]}}, 0.0, fmt::format("{:.3g}", millions)};
    if (result.ratio) {
      bar.peer = millions / *result.ratio;
      bar.note += fmt::format(", {:.2f} x", *result.ratio);
      chart.legend = {{"Prelight", palette[0]}, {"Embree, ray by ray", "#a9b0b8"}};
    }
    groupNamed(chart.groups, size).bars.push_back(std::move(bar));
  }
  return drawBarChart(chart);
}

std::string buildPlot(const Results& results, const std::string& subtitle) {
  BarChart chart{"Seconds to build the tree over detailed rooms", subtitle, "seconds", {}, {}};
  chart.legend = {{"Prelight", palette[0]}};
  for (const BenchmarkResult& result : results) {
    if (result.metric != "build") continue;
    const auto [quality, size] = splitSize(result.case_);
    Bar bar{quality, {{result.value, palette[0]}}, 0.0, fmt::format("{:.3g} s", result.value)};
    if (result.ratio) {
      bar.peer = result.value * *result.ratio;
      bar.note += fmt::format(", {:.2f} x", *result.ratio);
      chart.legend = {{"Prelight", palette[0]}, {"Embree at about the same effort", "#a9b0b8"}};
    }
    groupNamed(chart.groups, size).bars.push_back(std::move(bar));
  }
  return drawBarChart(chart);
}

std::string treesPlot(const Results& results, const std::string& subtitle) {
  BarChart chart{"Steps of a ray through the tree", subtitle, "steps a ray", {}, {}};
  chart.legend = {{"nodes", palette[0]}, {"blocks of triangles", palette[1]}};
  for (const BenchmarkResult& result : results) {
    const auto [scene, quality] = splitCase(result.case_);
    std::vector<Bar>& bars = groupNamed(chart.groups, scene).bars;
    if (bars.empty() || bars.back().label != quality) bars.push_back({quality, {}, 0.0, {}});
    if (result.metric == "build") bars.back().note = fmt::format("built in {:.3g} s", result.value);
    if (result.metric == "nodes") bars.back().parts.push_back({result.value, palette[0]});
    if (result.metric == "blocks") bars.back().parts.push_back({result.value, palette[1]});
  }
  return drawBarChart(chart);
}

std::string scalingPlot(const Results& results, const std::string& subtitle) {
  return drawCurveChart({"Rays a second as scenes grow", subtitle, "triangles", "million rays a second",
                         curvesOverSize(results, "best throughput", 1e-6, true)});
}

std::string scalingBuildPlot(const Results& results, const std::string& subtitle) {
  return drawCurveChart({"Seconds to build the tree as scenes grow", subtitle, "triangles", "seconds",
                         curvesOverSize(results, "build", 1.0, false)});
}

}  // namespace prelight::benchmarks
