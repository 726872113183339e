#include "benchmarks/error_plots.h"

#include <fmt/format.h>

#include <algorithm>

namespace prelight::benchmarks {

namespace {

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

/// Curves of the chart of compression: "cpca:64:8" -> "cpca:64", "half", "band8" and "rgbe" -> "half, band8,
/// rgbe".
std::string methodFamily(const std::string& method) {
  const std::size_t colon = method.find(':');
  if (colon == std::string::npos) return "half, band8, rgbe";
  const std::string family = method.substr(0, colon);
  return family == "cpca" ? method.substr(0, method.find(':', colon + 1)) : family;
}

}  // namespace

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
    const auto color = static_cast<std::size_t>(
        std::count_if(chart.curves.begin(), chart.curves.end(),
                      [&, start = scene + ","](const Curve& c) { return c.name.starts_with(start); }));
    Curve& curve = curveNamed(chart.curves, name, palette[color % palette.size()],
                              scene == scenes.front() ? CurveStyle::Strong : CurveStyle::Dashed);
    curve.points.push_back({std::stod(sweeps), result.value});
  }
  return drawCurveChart(chart);
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

namespace {

/// Of a way to gather, the same on every scene.
std::string gatherColor(const std::string& choice) {
  return choice == "all" ? palette[0] : choice == "cache" ? palette[1] : palette[2];
}

/// A panel a scene, of error against time by choices. Cases are "scene/choice/effort"; those without a time
/// are left out.
template <typename ColorOf>
std::string panelsByChoice(const Results& results, const std::string& subtitle, const std::string& title,
                           const std::string& unit, const ColorOf& colorOf) {
  std::vector<SceneResults> ways;
  for (const BenchmarkResult& result : results)
    if (const std::size_t end = result.case_.rfind('/'); end != std::string::npos)
      groupNamed(ways, result.case_.substr(0, end)).results.push_back(result);
  std::vector<CurveChart> panels;
  for (const SceneResults& way : ways) {
    const auto [scene, choice] = splitCase(way.name);
    const std::vector<Point> points = pointsOf(way.results, "error");
    if (points.empty()) continue;
    const std::string ofScene = fmt::format("{}: {}", title, scene);
    if (panels.empty() || panels.back().title != ofScene)
      panels.push_back({ofScene, subtitle, "seconds of all processors", unit, {}});
    std::vector<Curve>& curves = panels.back().curves;
    curves.push_back({choice, colorOf(choice, curves.size()), CurveStyle::Strong, points});
  }
  return drawCurvePanels(panels);
}

}  // namespace

/// Those of the long run have no time.
std::string gatherPlot(const Results& results, const std::string& subtitle) {
  return panelsByChoice(results, subtitle, "Error of indirect light against time",
                        "rms error over mean light",
                        [](const std::string& choice, std::size_t) { return gatherColor(choice); });
}

std::string materialsPlot(const Results& results, const std::string& subtitle) {
  return panelsByChoice(
      results, subtitle, "Error against time", "rms error",
      [](const std::string&, std::size_t curve) { return std::string(palette[curve % palette.size()]); });
}

std::string gatherBiasPlot(const Results& results, const std::string& subtitle) {
  BarChart chart{
      "What is left of the error with many rays, by how light is gathered",
      subtitle,
      "rms bias over mean light, %",
      {{"all", gatherColor("all")}, {"cache", gatherColor("cache")}, {"guided", gatherColor("guided")}},
      {}};
  for (const BenchmarkResult& result : results) {
    const auto [scene, rest] = splitCase(result.case_);
    const std::string choice = splitCase(rest).first;
    if (result.metric == "bias")
      groupNamed(chart.groups, scene)
          .bars.push_back({choice,
                           {{100.0 * result.value, gatherColor(choice)}},
                           0.0,
                           fmt::format("{:.2g} %", 100.0 * result.value)});
    if (result.metric == "standard error of bias")
      groupNamed(chart.groups, scene).bars.back().note += fmt::format(" ± {:.1g}", 100.0 * result.value);
  }
  return drawBarChart(chart);
}

}  // namespace prelight::benchmarks
