#include "benchmarks/plot_parts.h"

namespace prelight::benchmarks {

std::pair<std::string, std::string> splitCase(const std::string& name) {
  const std::size_t slash = name.find('/');
  if (slash == std::string::npos) return {name, ""};
  return {name.substr(0, slash), name.substr(slash + 1)};
}

Curve& curveNamed(std::vector<Curve>& curves, const std::string& name, const std::string& color,
                  CurveStyle style) {
  const auto found =
      std::find_if(curves.begin(), curves.end(), [&](const Curve& c) { return c.name == name; });
  return found != curves.end() ? *found : curves.emplace_back(Curve{name, color, style, {}});
}

std::string stageColor(std::vector<LegendEntry>& legend, const std::string& stage) {
  for (const LegendEntry& entry : legend)
    if (entry.name == stage) return entry.color;
  legend.push_back({stage, palette[legend.size() % palette.size()]});
  return legend.back().color;
}

}  // namespace prelight::benchmarks
