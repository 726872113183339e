#include "benchmarks/transfer_plots.h"

#include <fmt/format.h>

#include <algorithm>

#include "benchmarks/charts.h"

namespace prelight::benchmarks {

namespace {

constexpr const char* blue = "#2f6db5";
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

std::string techniquesPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle) {
  constexpr double direct = 2.0;  // segments of a path
  BarChart chart{"Difference of pictures from path-traced ones",
                 subtitle,
                 "RMSE, W/(m2 sr)",
                 {{"direct light is claimed", grey}, {"light that surfaces send on, too", blue}},
                 {}};
  for (const BenchmarkResult& result : results) {
    if (result.metric != "claim" && result.metric != "RMSE") continue;
    Bar& bar = barNamed(chart, sceneOf(result.case_), settingOf(result.case_));
    if (bar.parts.empty()) bar.parts = {{0.0, blue}};
    if (result.metric == "claim") {
      bar.parts.front().color = result.value <= direct ? grey : blue;
      continue;
    }
    bar.parts.front().value = result.value;
    bar.note = fmt::format("{:.4f}", result.value);
  }
  return drawBarChart(chart);
}

std::string screenPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle) {
  BarChart chart{
      "Error of occlusion found in pictures, against traced accessibility", subtitle, "rms error", {}, {}};
  for (const BenchmarkResult& result : results) {
    if (result.metric != "rms error") continue;
    Bar& bar = barNamed(chart, sceneOf(result.case_), settingOf(result.case_));
    bar.parts = {{result.value, blue}};
    bar.note = fmt::format("{:.3f}", result.value);
  }
  return drawBarChart(chart);
}

std::string objectsPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle) {
  BarChart chart{"Error where objects shade a scene, against path-traced pictures",
                 subtitle,
                 "rms error, of the rms",
                 {},
                 {}};
  for (const BenchmarkResult& result : results) {
    if (result.metric != "error") continue;
    Bar& bar = barNamed(chart, sceneOf(result.case_), settingOf(result.case_));
    bar.parts = {{result.value, blue}};
    bar.note = fmt::format("{:.3f}", result.value);
  }
  return drawBarChart(chart);
}

std::string nearLampsPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle) {
  BarChart chart{"Error of lamps' light with shadows by shells, over that without shadows",
                 subtitle,
                 "rms error against shadow rays, over that without shells",
                 {},
                 {}};
  for (const BenchmarkResult& result : results) {
    if (result.metric != "with over without") continue;
    Bar& bar = barNamed(chart, sceneOf(result.case_), settingOf(result.case_));
    bar.parts = {{result.value, blue}};
    bar.note = fmt::format("{:.2f}", result.value);
  }
  return drawBarChart(chart);
}

std::string rasterisedPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle) {
  BarChart chart{"Error of SH of visibility that OpenGL draws, and of as many rays",
                 subtitle,
                 "relative RMS error, %",
                 {},
                 {}};
  for (const BenchmarkResult& result : results) {
    if (result.metric != "error of transfer") continue;
    Bar& bar = barNamed(chart, sceneOf(result.case_), settingOf(result.case_));
    bar.parts = {{100.0 * result.value, blue}};
    bar.note = fmt::format("{:.2f}", 100.0 * result.value);
  }
  return drawBarChart(chart);
}

std::string liveLightPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle) {
  BarChart chart{"Error of indirect light that follows what moves, in pictures",
                 subtitle,
                 "rms error, of the mean, %",
                 {},
                 {}};
  for (const BenchmarkResult& result : results) {
    if (result.metric != "picture error") continue;
    Bar& bar = barNamed(chart, sceneOf(result.case_), settingOf(result.case_));
    bar.parts = {{100.0 * result.value, blue}};
    bar.note = fmt::format("{:.2f}", 100.0 * result.value);
  }
  return drawBarChart(chart);
}

std::string animationPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle) {
  BarChart chart{"Error of transfer between an animation's keys", subtitle, "relative RMS error, %", {}, {}};
  for (const BenchmarkResult& result : results) {
    if (result.metric != "rms error") continue;
    std::string setting = settingOf(result.case_);
    if (const std::size_t slash = setting.find('/'); slash != std::string::npos)
      setting.replace(slash, 1, ", ");
    Bar& bar = barNamed(chart, sceneOf(result.case_), setting);
    bar.parts = {{100.0 * result.value, blue}};
    bar.note = fmt::format("{:.3g} %", 100.0 * result.value);
  }
  return drawBarChart(chart);
}

std::string basisPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle) {
  BarChart chart{"Time of evaluating spherical and cpherical harmonics",
                 subtitle,
                 "ns a direction",
                 {{"spherical", grey}, {"cpherical", blue}},
                 {}};
  for (const BenchmarkResult& result : results) {
    if (result.metric != "time") continue;
    const std::string way = settingOf(result.case_);
    Bar& bar = barNamed(chart, sceneOf(result.case_), way);
    bar.parts = {{1e9 * result.value, way.starts_with("SH") ? grey : blue}};
    bar.note = fmt::format("{:.2f}", 1e9 * result.value);
  }
  return drawBarChart(chart);
}

std::string encodingsPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle) {
  BarChart chart{"Error of encodings of incident light",
                 subtitle,
                 "RMS error of irradiance over normals up to 45 degrees from the surface's, of its RMS, %",
                 {{"spherical harmonics", grey}, {"others", blue}},
                 {}};
  for (const BenchmarkResult& result : results) {
    if (result.metric != "error") continue;
    const std::string setting = settingOf(result.case_);
    Bar& bar = barNamed(chart, sceneOf(result.case_), setting);
    bar.parts = {{100.0 * result.value, setting.starts_with("sh-") ? grey : blue}};
    bar.note = fmt::format("{:.1f} %", 100.0 * result.value);
  }
  return drawBarChart(chart);
}

std::string skipPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle) {
  BarChart chart{"Cost of features that are present but not needed",
                 subtitle,
                 "processor time over that without the feature",
                 {{"present, not needed", blue}, {"absent", grey}},
                 {}};
  const auto timeOf = [&](const std::string& name) {
    for (const BenchmarkResult& result : results)
      if (result.case_ == name && result.metric == "processor time") return result.value;
    return 0.0;
  };
  for (const BenchmarkResult& result : results) {
    if (result.metric != "cost") continue;
    const std::string feature = sceneOf(result.case_);
    Bar& bar = barNamed(chart, "", feature);
    bar.parts = {{result.value, blue}};
    bar.peer = 1.0;
    bar.note = fmt::format("{:.2f}", result.value);
    if (const double absent = timeOf(feature + "/absent"); absent > 0.0)
      bar.note += fmt::format("; needed {:.2f}", timeOf(feature + "/needed") / absent);
  }
  return drawBarChart(chart);
}

std::string voPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle) {
  BarChart chart{"Error of shadows of vector occluders",
                 subtitle,
                 "RMS error of direct light, of that without shadows; 16 lights around the scene",
                 {{"vector occluders", blue}, {"others", grey}},
                 {}};
  for (const BenchmarkResult& result : results) {
    const std::string setting = settingOf(result.case_);
    if (result.metric != "error, lights around" || setting == "no shadow") continue;
    std::string label = setting;
    const std::size_t slash = label.find('/');
    if (slash != std::string::npos) label.replace(slash, 1, ", ");
    Bar& bar = barNamed(chart, sceneOf(result.case_), label);
    bar.parts = {{result.value, slash != std::string::npos ? blue : grey}};
    bar.note = fmt::format("{:.2f}", result.value);
  }
  return drawBarChart(chart);
}

}  // namespace prelight::benchmarks
