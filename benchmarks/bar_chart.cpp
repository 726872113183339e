#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "benchmarks/charts.h"

namespace prelight::benchmarks {

namespace {

constexpr double width = 760.0;
constexpr double left = 230.0;   // of the bars; labels lie before it
constexpr double right = 640.0;  // of the axis; notes lie behind the bars
constexpr double top = 96.0;
constexpr double rowHeight = 22.0;
constexpr double barHeight = 12.0;
constexpr double peerHeight = 4.0;
constexpr double groupGap = 14.0;
constexpr std::string_view gridColor = "#e4e6e9";
constexpr std::string_view peerColor = "#a9b0b8";
constexpr std::string_view quietColor = "#6b7178";

double lengthOf(const Bar& bar) {
  double sum = 0.0;
  for (const Bar::Part& part : bar.parts) sum += part.value;
  return sum;
}

double largest(const BarChart& chart) {
  double most = 0.0;
  for (const BarGroup& group : chart.groups)
    for (const Bar& bar : group.bars) most = std::max({most, lengthOf(bar), bar.peer});
  return most > 0.0 ? most : 1.0;
}

/// 1, 2 or 5 times a power of ten, so that about five steps reach `range`.
double tickStep(double range) {
  const double power = std::pow(10.0, std::floor(std::log10(range / 5.0)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power * 5.0 >= range) return factor * power;
  return 10.0 * power;
}

double bottomOf(const BarChart& chart) {
  double y = top;
  for (const BarGroup& group : chart.groups)
    y += static_cast<double>(group.bars.size()) * rowHeight + groupGap;
  return y;
}

void drawAxis(Svg& svg, const BarChart& chart, double scale, double bottom) {
  const double most = largest(chart), step = tickStep(most);
  for (double tick = 0.0; tick <= most * 1.0001; tick += step) {
    const double x = left + tick * scale;
    svg.line({{x, top - 6}, {x, bottom}}, {gridColor});
    svg.text({x, bottom + 16}, fmt::format("{:.6g}", tick), {11, quietColor, Anchor::Middle});
  }
  svg.text({0.5 * (left + right), bottom + 36}, chart.axis, {12, quietColor, Anchor::Middle});
}

void drawLegend(Svg& svg, const BarChart& chart) {
  double x = left;
  for (const LegendEntry& entry : chart.legend) {
    svg.rectangle({x, 64}, 10, 10, entry.color);
    svg.text({x + 15, 73}, entry.name);
    x += 40 + 6.2 * static_cast<double>(entry.name.size());
  }
}

void drawBar(Svg& svg, const Bar& bar, double y, double scale) {
  double x = left;
  for (const Bar::Part& part : bar.parts) {
    svg.rectangle({x, y}, part.value * scale, barHeight, part.color);
    x += part.value * scale;
  }
  svg.rectangle({left, y + barHeight}, bar.peer * scale, peerHeight, peerColor);
  svg.text({left - 10, y + barHeight}, bar.label, {12, "#3c4043", Anchor::End});
  svg.text({std::max(x, left + bar.peer * scale) + 6, y + barHeight - 1}, bar.note, {11, quietColor});
}

}  // namespace

void drawTitle(Svg& svg, double x, const std::string& title, const std::string& subtitle) {
  svg.text({x, 28}, title, {16, "#202124", Anchor::Start, true});
  svg.text({x, 47}, subtitle, {11, quietColor});
}

std::string drawBarChart(const BarChart& chart) {
  const double bottom = bottomOf(chart);
  const double scale = (right - left) / largest(chart);
  Svg svg(width, bottom + 52);
  drawTitle(svg, 20, chart.title, chart.subtitle);
  drawLegend(svg, chart);
  drawAxis(svg, chart, scale, bottom);
  double y = top;
  for (const BarGroup& group : chart.groups) {
    svg.text({20, y + barHeight}, group.name, {12, "#202124", Anchor::Start, true});
    for (const Bar& bar : group.bars) {
      drawBar(svg, bar, y, scale);
      y += rowHeight;
    }
    y += groupGap;
  }
  return svg.str();
}

}  // namespace prelight::benchmarks
