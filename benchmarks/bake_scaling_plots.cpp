#include "benchmarks/bake_scaling_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "benchmarks/charts.h"

namespace prelight::benchmarks {

namespace {

using Results = std::vector<BenchmarkResult>;

constexpr std::array<const char*, 7> scalingPalette = {"#2f6db5", "#d97b29", "#3c9d6e", "#8b5fb0",
                                                       "#b8474d", "#4fa3b8", "#6b7178"};

/// "balls 407k/--ao --sh 3 --bounces 1/64 rays" in parts.
struct CaseParts {
  std::string scene, technique, rays;

  explicit CaseParts(const std::string& name) {
    const std::size_t first = name.find('/'), last = name.rfind('/');
    scene = name.substr(0, first);
    if (first == std::string::npos || last == first) return;
    technique = name.substr(first + 1, last - first - 1);
    rays = name.substr(last + 1);
  }

  bool growing() const { return scene.starts_with("balls ") && !rays.empty(); }
  bool carriesTransfer() const { return technique.find("SH") != std::string::npos || ofBake("--sh"); }
  bool ofBake(const char* option) const { return technique.find(option) != std::string::npos; }
  double triangles() const {
    const std::string size = scene.substr(scene.rfind(' ') + 1);
    return std::stod(size) * (size.ends_with('M') ? 1e6 : 1e3);
  }
  double rayCount() const { return std::stod(rays); }
};

Curve& curveNamed(CurveChart& chart, const std::string& name, const std::string& color, CurveStyle style) {
  const auto found = std::find_if(chart.curves.begin(), chart.curves.end(),
                                  [&](const Curve& curve) { return curve.name == name; });
  return found != chart.curves.end() ? *found : chart.curves.emplace_back(Curve{name, color, style, {}});
}

void addPoint(Curve& curve, const Point& point) {
  const auto after = std::find_if(curve.points.begin(), curve.points.end(),
                                  [&](const Point& other) { return other.x > point.x; });
  if (point.x > 0.0 && point.y > 0.0) curve.points.insert(after, point);
}

/// The number of rays that sizes are compared at: 64 a vertex, or what there is.
std::string commonRays(const Results& results) {
  std::string rays;
  for (const BenchmarkResult& result : results) {
    const CaseParts parts(result.case_);
    if (parts.growing() && (rays.empty() || parts.rays == "64 rays")) rays = parts.rays;
  }
  return rays;
}

std::size_t placeOf(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  names.push_back(name);
  return names.size() - 1;
}

/// The value of another metric of the same case.
std::optional<double> valueOf(const Results& results, const std::string& name, const std::string& metric) {
  for (const BenchmarkResult& result : results)
    if (result.case_ == name && result.metric == metric) return result.value;
  return {};
}

}  // namespace

std::string bakeStagesPlot(const Results& results, const std::string& subtitle) {
  const std::string rays = commonRays(results);
  CurveChart chart{"Seconds of a bake's stages as scenes grow, AO, SH 3 and a bounce, " + rays,
                   subtitle,
                   "triangles",
                   "seconds",
                   {}};
  constexpr std::array<const char*, 7> metrics = {"prepare to write", "prepare", "cast",      "fit",
                                                  "bounce",           "write",   "rays alone"};
  for (const BenchmarkResult& result : results) {
    const CaseParts parts(result.case_);
    const auto* const metric = std::find(metrics.begin(), metrics.end(), result.metric);
    if (metric == metrics.end() || !parts.growing() || parts.rays != rays || !parts.ofBake("--sh")) continue;
    const CurveStyle style = metric == metrics.begin()
                                 ? CurveStyle::Strong
                                 : (result.metric == "rays alone" ? CurveStyle::Dashed : CurveStyle::Thin);
    const auto color = static_cast<std::size_t>(metric - metrics.begin());
    addPoint(curveNamed(chart, result.metric, scalingPalette[color], style),
             {parts.triangles(), result.value});
  }
  return drawCurveChart(chart);
}

std::string bakeSharePlot(const Results& results, const std::string& subtitle) {
  CurveChart chart{"Seconds of whole bakes over those of their rays alone",
                   subtitle,
                   "rays a vertex",
                   "prepare to write over rays alone",
                   {}};
  std::vector<std::string> scenes;
  for (const BenchmarkResult& result : results) {
    const CaseParts parts(result.case_);
    if (result.metric != "prepare to write" || !result.ratio) continue;
    const bool transfer = parts.carriesTransfer();
    const std::size_t color = placeOf(scenes, parts.scene) % scalingPalette.size();
    addPoint(curveNamed(chart, fmt::format("{}, {}", parts.scene, transfer ? "SH" : "AO"),
                        scalingPalette[color], transfer ? CurveStyle::Strong : CurveStyle::Thin),
             {parts.rayCount(), 1.0 / *result.ratio});
  }
  return drawCurveChart(chart);
}

std::string bakeMemoryPlot(const Results& results, const std::string& subtitle) {
  const std::string rays = commonRays(results);
  CurveChart chart{"Peak memory of bakes as scenes grow, " + rays, subtitle, "triangles", "MB", {}};
  for (const BenchmarkResult& result : results) {
    const CaseParts parts(result.case_);
    if (result.metric != "peak memory" || !parts.growing() || parts.rays != rays) continue;
    const char* color = scalingPalette[parts.carriesTransfer() ? 0 : 1];
    const std::string what = parts.carriesTransfer() ? "SH" : "AO";
    addPoint(curveNamed(chart, what + ", measured", color, CurveStyle::Strong),
             {parts.triangles(), 1e-6 * result.value});
    if (result.ratio)
      addPoint(curveNamed(chart, what + ", planned", color, CurveStyle::Dashed),
               {parts.triangles(), 1e-6 * result.value * *result.ratio});
  }
  return drawCurveChart(chart);
}

std::string bakeErrorPlot(const Results& results, const std::string& subtitle) {
  CurveChart chart{"Error of SH transfer with a bounce against time",
                   subtitle,
                   "seconds",
                   "relative RMS error over the surface",
                   {}};
  std::vector<std::string> scenes;
  for (const BenchmarkResult& result : results) {
    const CaseParts parts(result.case_);
    if (result.metric != "error" || !parts.carriesTransfer()) continue;
    const std::optional<double> seconds = valueOf(results, result.case_, "bake");
    if (!seconds) continue;
    const bool own = parts.ofBake("--sh");
    const std::size_t color = placeOf(scenes, parts.scene) % scalingPalette.size();
    addPoint(curveNamed(chart, fmt::format("{}, {}", parts.scene, own ? "Prelight" : "Embree"),
                        scalingPalette[color], own ? CurveStyle::Strong : CurveStyle::Dashed),
             {*seconds, result.value});
  }
  return drawCurveChart(chart);
}

}  // namespace prelight::benchmarks
