#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/charts.h"
#include "benchmarks/suite.h"

/// What the charts of several suites are put together from.
namespace prelight::benchmarks {

using Results = std::vector<BenchmarkResult>;

inline constexpr std::array<const char*, 8> palette = {"#2f6db5", "#d97b29", "#3c9d6e", "#8b5fb0",
                                                       "#b8474d", "#1b9aaa", "#c2a83e", "#7a5c43"};

/// "shapes/random order/any hit" -> "shapes" and "random order/any hit".
std::pair<std::string, std::string> splitCase(const std::string& name);

/// The group of a name, added where it is new.
template <typename Group>
Group& groupNamed(std::vector<Group>& groups, const std::string& name) {
  const auto found =
      std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.name == name; });
  return found != groups.end() ? *found : groups.emplace_back(Group{name, {}});
}

/// The curve of a name, which is of this colour and style where it is new.
Curve& curveNamed(std::vector<Curve>& curves, const std::string& name, const std::string& color,
                  CurveStyle style);

/// Colour of a stage, which enters the legend when it is new.
std::string stageColor(std::vector<LegendEntry>& legend, const std::string& stage);

}  // namespace prelight::benchmarks
