#include "benchmarks/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>

#include "benchmarks/bake_scaling_plots.h"
#include "benchmarks/charts.h"
#include "benchmarks/stability/stability_plots.h"
#include "benchmarks/transfer_plots.h"

namespace prelight::benchmarks {

namespace {

using Results = std::vector<BenchmarkResult>;

constexpr std::array<const char*, 5> palette = {"#2f6db5", "#d97b29", "#3c9d6e", "#8b5fb0", "#b8474d"};

/// "shapes/random order/any hit" -> "shapes" and "random order/any hit".
std::pair<std::string, std::string> splitCase(const std::string& name) {
  const std::size_t slash = name.find('/');
  if (slash == std::string::npos) return {name, ""};
  return {name.substr(0, slash), name.substr(slash + 1)};
}

template <typename Group>
Group& groupNamed(std::vector<Group>& groups, const std::string& name) {
  const auto found =
      std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.name == name; });
  return found != groups.end() ? *found : groups.emplace_back(Group{name, {}});
}

/// The curve of a name, which is of this colour and style where it is new.
Curve& curveNamed(std::vector<Curve>& curves, const std::string& name, const std::string& color,
                  CurveStyle style) {
  const auto found =
      std::find_if(curves.begin(), curves.end(), [&](const Curve& c) { return c.name == name; });
  return found != curves.end() ? *found : curves.emplace_back(Curve{name, color, style, {}});
}

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

/// "bake-order 250k" -> "bake-order" and "250k".
std::pair<std::string, std::string> splitSize(const std::string& name) {
  const std::size_t space = name.rfind(' ');
  return {name.substr(0, space), space == std::string::npos ? "" : name.substr(space + 1)};
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

/// "250k" -> 250000.
double triangleCount(const std::string& size) { return std::stod(size) * (size.ends_with('M') ? 1e6 : 1e3); }

/// Curves over the number of triangles of the results of one metric, two for each kind of case: Prelight's
/// and the peer's, whose values follow from the ratios (`more`: the more of it the better).
std::vector<Curve> curvesOverSize(const Results& results, const std::string& metric, double unit, bool more) {
  std::vector<Curve> curves;
  for (const BenchmarkResult& result : results) {
    if (result.metric != metric) continue;
    const auto [kind, size] = splitSize(result.case_);
    const auto add = [&](const std::string& name, CurveStyle style, double value) {
      auto curve = std::find_if(curves.begin(), curves.end(), [&](const Curve& c) { return c.name == name; });
      if (curve == curves.end())
        curve = curves.insert(curves.end(), {name, palette[curves.size() / 2 % palette.size()], style, {}});
      curve->points.push_back({triangleCount(size), value * unit});
    };
    add(kind + ", Prelight", CurveStyle::Strong, result.value);
    if (result.ratio)
      add(kind + ", Embree", CurveStyle::Dashed,
          more ? result.value / *result.ratio : result.value * *result.ratio);
  }
  return curves;
}

std::string scalingPlot(const Results& results, const std::string& subtitle) {
  return drawCurveChart({"Rays a second as scenes grow", subtitle, "triangles", "million rays a second",
                         curvesOverSize(results, "best throughput", 1e-6, true)});
}

std::string scalingBuildPlot(const Results& results, const std::string& subtitle) {
  return drawCurveChart({"Seconds to build the tree as scenes grow", subtitle, "triangles", "seconds",
                         curvesOverSize(results, "build", 1.0, false)});
}

/// Colour of a stage, which enters the legend when it is new.
std::string stageColor(std::vector<LegendEntry>& legend, const std::string& stage) {
  for (const LegendEntry& entry : legend)
    if (entry.name == stage) return entry.color;
  legend.push_back({stage, palette[legend.size() % palette.size()]});
  return legend.back().color;
}

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

struct SceneResults {
  std::string name;
  Results results;
};

/// Time against `metric`, of the cases that have both.
std::vector<Point> pointsOf(const Results& results, const std::string& metric) {
  std::vector<Point> points;
  for (const BenchmarkResult& time : results)
    for (const BenchmarkResult& error : results)
      if (time.metric == "time" && error.metric == metric && time.case_ == error.case_ && time.value > 0.0 &&
          error.value > 0.0)
        points.push_back({time.value, error.value});
  return points;
}

std::string errorPlot(const Results& results, const std::string& subtitle) {
  std::vector<SceneResults> scenes;
  for (const BenchmarkResult& result : results)
    if (const auto [scene, label] = splitCase(result.case_); !label.starts_with("reference"))
      groupNamed(scenes, scene).results.push_back(result);
  CurveChart chart{"Error of ambient occlusion against time", subtitle, "seconds", "RMS error of AO", {}};
  std::size_t color = 0;
  for (const SceneResults& scene : scenes) {
    const std::string paint = palette[color++ % palette.size()];
    const auto add = [&](const char* name, const char* metric, CurveStyle style) {
      chart.curves.push_back(
          {fmt::format("{}, {}", scene.name, name), paint, style, pointsOf(scene.results, metric)});
    };
    add("at vertices", "vertex error", CurveStyle::Strong);
    add("over the surface", "surface error", CurveStyle::Thin);
    add("reported", "reported error", CurveStyle::Dashed);
  }
  return drawCurveChart(chart);
}

/// A curve a scene of relative squared error against time.
std::string timeErrorPlot(const Results& results, const std::string& title, const std::string& subtitle,
                          const std::string& metric) {
  std::vector<SceneResults> scenes;
  for (const BenchmarkResult& result : results)
    if (const auto [scene, label] = splitCase(result.case_); !label.starts_with("long run"))
      groupNamed(scenes, scene).results.push_back(result);
  CurveChart chart{title, subtitle, "seconds", "relative MSE", {}};
  for (const SceneResults& scene : scenes)
    chart.curves.push_back({scene.name, palette[chart.curves.size() % palette.size()], CurveStyle::Strong,
                            pointsOf(scene.results, metric)});
  return drawCurveChart(chart);
}

std::string referencePlot(const Results& results, const std::string& subtitle) {
  return timeErrorPlot(results, "Error of the reference renderer against time", subtitle, "relMSE");
}

std::string globalIlluminationPlot(const Results& results, const std::string& subtitle) {
  return timeErrorPlot(results, "Error of pictures with all light against time", subtitle, "relMSE of 99 %");
}

/// Cases of selection are "select/light/count/how".
std::string waveletsPlot(const Results& results, const std::string& subtitle) {
  CurveChart chart{"Error of lighting by Haar wavelets",
                   subtitle,
                   "coefficients of the light",
                   "relative RMS error, %",
                   {}};
  std::vector<std::string> lights;
  for (const BenchmarkResult& result : results) {
    const auto [kind, rest] = splitCase(result.case_);
    if (kind != "select" || result.metric != "error" || result.value <= 0.0) continue;
    const auto [light, setting] = splitCase(rest);
    const auto [count, how] = splitCase(setting);
    if (!how.starts_with("transfer")) continue;
    if (std::find(lights.begin(), lights.end(), light) == lights.end()) {
      const std::string color = palette[lights.size() % palette.size()];
      lights.push_back(light);
      chart.curves.push_back({light + ", fitted", color, CurveStyle::Strong, {}});
      chart.curves.push_back({light + ", as they are", color, CurveStyle::Thin, {}});
    }
    const auto place =
        static_cast<std::size_t>(std::find(lights.begin(), lights.end(), light) - lights.begin());
    Curve& curve = chart.curves[2 * place + (how == "transfer" ? 1 : 0)];
    curve.points.push_back({std::stod(count), result.value});
  }
  return drawCurveChart(chart);
}

/// Curves of the chart of compression: "cpca:64:8" -> "cpca:64", "half" and "band8" -> "half, band8".
std::string methodFamily(const std::string& method) {
  const std::size_t colon = method.find(':');
  if (colon == std::string::npos) return "half, band8";
  const std::string family = method.substr(0, colon);
  return family == "cpca" ? method.substr(0, method.find(':', colon + 1)) : family;
}

/// A family has one colour; the second scene is dashed.
std::string compressPlot(const Results& results, const std::string& subtitle) {
  CurveChart chart{"Error of compressed transfer against its size",
                   subtitle,
                   "bytes a vertex, everything counted",
                   "relative RMS error of vectors",
                   {}};
  std::vector<std::string> scenes, families;
  const auto placeOf = [](std::vector<std::string>& names, const std::string& name) {
    const auto found = std::find(names.begin(), names.end(), name);
    const auto place = static_cast<std::size_t>(found - names.begin());
    if (found == names.end()) names.push_back(name);
    return place;
  };
  for (const BenchmarkResult& size : results)
    for (const BenchmarkResult& error : results) {
      if (size.metric != "bytes a vertex" || error.metric != "vector error" || size.case_ != error.case_ ||
          !(error.value > 0.0) || size.case_.ends_with(":byte"))
        continue;
      const auto [scene, method] = splitCase(size.case_);
      const std::string family = methodFamily(method), name = fmt::format("{}, {}", scene, family);
      const CurveStyle style = placeOf(scenes, scene) == 0 ? CurveStyle::Strong : CurveStyle::Dashed;
      const std::size_t color = placeOf(families, family);
      std::vector<Point>& points =
          curveNamed(chart.curves, name, color == 0 ? "#6b7178" : palette[(color - 1) % palette.size()],
                     style)
              .points;
      const auto place =
          std::find_if(points.begin(), points.end(), [&](const Point& p) { return p.x > size.value; });
      points.insert(place, {size.value, error.value});
    }
  return drawCurveChart(chart);
}

/// Cases of residuals are "scene/method/N sweeps"; the second scene is dashed.
std::string radiosityPlot(const Results& results, const std::string& subtitle) {
  CurveChart chart{"Residual of the radiosity equation",
                   subtitle,
                   "row operations over rows",
                   "residual over the direct light",
                   {}};
  std::vector<std::string> scenes;
  for (const BenchmarkResult& result : results) {
    if (result.metric != "residual" || result.value <= 0.0) continue;
    const auto [scene, rest] = splitCase(result.case_);
    const auto [method, sweeps] = splitCase(rest);
    if (std::find(scenes.begin(), scenes.end(), scene) == scenes.end()) scenes.push_back(scene);
    const std::string name = fmt::format("{}, {}", scene, method);
    const auto color =
        static_cast<std::size_t>(std::count_if(chart.curves.begin(), chart.curves.end(), [&](const Curve& c) {
          return c.name.starts_with(scene + ",");
        }));
    Curve& curve = curveNamed(chart.curves, name, palette[color % palette.size()],
                              scene == scenes.front() ? CurveStyle::Strong : CurveStyle::Dashed);
    curve.points.push_back({std::stod(sweeps), result.value});
  }
  return drawCurveChart(chart);
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

/// Cases of errors are "fixed radius/64000 photons".
std::string photonsPlot(const Results& results, const std::string& subtitle) {
  CurveChart chart{
      "Error of irradiance from photons against their number", subtitle, "photons", "relative MSE", {}};
  for (const BenchmarkResult& result : results) {
    if (result.metric != "relative MSE") continue;
    const auto [kind, count] = splitCase(result.case_);
    Curve& curve =
        curveNamed(chart.curves, kind, palette[chart.curves.size() % palette.size()], CurveStyle::Strong);
    curve.points.push_back({std::stod(count), result.value});
  }
  return drawCurveChart(chart);
}

/// Cases are "scene/by error/0.02"; texels of one size are dashed.
std::string lightMapsPlot(const Results& results, const std::string& subtitle) {
  CurveChart chart{
      "Error of light maps against their texels", subtitle, "texels", "error over mean light", {}};
  std::vector<std::string> scenes;
  double texels = 0.0;
  for (const BenchmarkResult& result : results) {
    if (result.metric == "texels") texels = result.value;
    if (result.metric != "error") continue;
    const auto [scene, rest] = splitCase(result.case_);
    const auto [kind, value] = splitCase(rest);
    if (std::find(scenes.begin(), scenes.end(), scene) == scenes.end()) scenes.push_back(scene);
    const std::string name = fmt::format("{}, {}", scene, kind);
    Curve& curve = curveNamed(chart.curves, name, palette[(scenes.size() - 1) % palette.size()],
                              kind == "by error" ? CurveStyle::Strong : CurveStyle::Dashed);
    curve.points.push_back({texels, result.value});
  }
  return drawCurveChart(chart);
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

}  // namespace

std::string windowPlot(const Results& results, const std::string& subtitle) {
  BarChart chart{"A frame of the window", subtitle, "ms, the median of all", {}, {}};
  for (const BenchmarkResult& result : results) {
    if (result.metric != "median frame") continue;
    const auto [scene, movement] = splitCase(result.case_);
    groupNamed(chart.groups, scene)
        .bars.push_back({movement, {{result.value, palette[0]}}, 0.0, fmt::format("{:.3g} ms", result.value)});
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

std::vector<Plot> makePlots(const Results& results, const std::string& subtitle) {
  struct Kind {
    const char* suite;
    const char* plot;
    std::string (*draw)(const Results&, const std::string&);
  };
  constexpr std::array<Kind, 31> kinds = {{{"cast", "cast", castPlot},
                                           {"window", "window", windowPlot},
                                           {"window", "window-parts", windowPartsPlot},
                                           {"rays", "rays", raysPlot},
                                           {"trees", "trees", treesPlot},
                                           {"build", "build", buildPlot},
                                           {"scaling", "scaling", scalingPlot},
                                           {"scaling", "scaling-build", scalingBuildPlot},
                                           {"bake", "bake", bakePlot},
                                           {"bake-scaling", "bake-scaling", bakeStagesPlot},
                                           {"bake-scaling", "bake-scaling-share", bakeSharePlot},
                                           {"bake-scaling", "bake-scaling-memory", bakeMemoryPlot},
                                           {"bake-scaling", "bake-scaling-error", bakeErrorPlot},
                                           {"error", "error", errorPlot},
                                           {"reference", "reference", referencePlot},
                                           {"full", "full", globalIlluminationPlot},
                                           {"wavelets", "wavelets", waveletsPlot},
                                           {"relight", "relight", relightPlot},
                                           {"compress", "compress", compressPlot},
                                           {"animation", "animation", animationPlot},
                                           {"vo", "vo", voPlot},
                                           {"radiosity", "radiosity", radiosityPlot},
                                           {"photons", "photons", photonsPlot},
                                           {"lightmaps", "lightmaps", lightMapsPlot},
                                           {"encodings", "encodings", encodingsPlot},
                                           {"update", "update", updatePlot},
                                           {"skip", "skip", skipPlot},
                                           {"stability", "stability", stabilityOrderPlot},
                                           {"stability", "stability-count", stabilityCountPlot},
                                           {"stability", "stability-size", stabilitySizePlot},
                                           {"techniques", "techniques", techniquesPlot}}};
  std::vector<Plot> plots;
  for (const Kind& kind : kinds) {
    Results own;
    std::copy_if(results.begin(), results.end(), std::back_inserter(own),
                 [&](const BenchmarkResult& result) { return result.suite == kind.suite; });
    if (!own.empty()) plots.push_back({kind.plot, kind.draw(own, subtitle)});
  }
  return plots;
}

}  // namespace prelight::benchmarks
