#include "benchmarks/stability/stability_plots.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <span>

#include "benchmarks/charts.h"

namespace prelight::benchmarks {

namespace {

constexpr std::array<const char*, 10> colors = {"#2f6db5", "#d97b29", "#3c9d6e", "#8b5fb0", "#b8474d",
                                                "#4aa7b5", "#a68a2c", "#c0699f", "#5b6770", "#7aa63c"};

/// Below this an error is none: double precision's are not drawn.
constexpr double leastDrawn = 1e-9;

/// "subject/stress/order 8" -> 8, if it is one of the parameters.
bool readGrowth(const std::string& name, std::span<const char* const> parameters, double* at) {
  const std::string last = name.substr(name.rfind('/') + 1);
  for (const std::string parameter : parameters)
    if (last.starts_with(parameter + " ")) {
      const std::string number = last.substr(parameter.size() + 1);
      char* end = nullptr;
      *at = std::strtod(number.c_str(), &end);
      return end != number.c_str() && *end == '\0' && *at > 0.0;
    }
  return false;
}

std::string growthPlot(const std::vector<BenchmarkResult>& results, CurveChart chart,
                       std::span<const char* const> parameters) {
  std::vector<std::string> order;
  std::map<std::string, std::map<double, double>> worst;
  for (const BenchmarkResult& result : results) {
    double at = 0.0;
    if (result.metric != "relative error" || !readGrowth(result.case_, parameters, &at)) continue;
    const std::string subject = result.case_.substr(0, result.case_.find('/'));
    if (worst.find(subject) == worst.end()) order.push_back(subject);
    double& value = worst[subject][at];
    value = std::max(value, result.value);
  }
  for (const std::string& subject : order) {
    Curve curve{subject, colors[chart.curves.size() % colors.size()], CurveStyle::Strong, {}};
    if (chart.curves.size() >= colors.size()) curve.style = CurveStyle::Dashed;
    for (const auto& [at, value] : worst[subject])
      if (value > leastDrawn) curve.points.push_back({at, value});
    if (curve.points.size() > 1) chart.curves.push_back(std::move(curve));
  }
  return drawCurveChart(chart);
}

}  // namespace

std::string stabilityOrderPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle) {
  constexpr std::array<const char*, 1> parameters = {"order"};
  return growthPlot(results, {"Worst relative error by order", subtitle, "order", "relative error", {}},
                    parameters);
}

std::string stabilityCountPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle) {
  constexpr std::array<const char*, 9> parameters = {
      "rays",   "photons",        "lights", "elements", "components", "samples", "segments of a path",
      "passes", "rays a receiver"};
  return growthPlot(results,
                    {"Worst relative error by count", subtitle, "what is added up", "relative error", {}},
                    parameters);
}

std::string stabilitySizePlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle) {
  constexpr std::array<const char*, 4> parameters = {"texels a side", "rows of the sky", "1 / alpha",
                                                     "distance over size"};
  return growthPlot(
      results,
      {"Worst relative error by size", subtitle, "texels, rows, 1 / alpha, distance", "relative error", {}},
      parameters);
}

}  // namespace prelight::benchmarks
