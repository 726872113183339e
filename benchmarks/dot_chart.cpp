#include <algorithm>
#include <limits>

#include "benchmarks/charts.h"
#include "benchmarks/log_axis.h"
#include "benchmarks/svg.h"

namespace prelight::benchmarks {

namespace {

constexpr double dotWidth = 760.0;
constexpr double dotMargin = 20.0;
constexpr double leastDotLeft = 120.0;  // of the axis; labels lie before it
constexpr double dotTop = 96.0;
constexpr double dotRowHeight = 20.0;
constexpr double dotRadius = 4.0;
constexpr std::string_view dotGridColor = "#e4e6e9";
constexpr std::string_view dotQuietColor = "#6b7178";

template <typename Function>
void forRows(const DotChart& chart, const Function& function) {
  for (const DotGroup& group : chart.groups)
    for (const DotRow& row : group.rows) function(row);
}

LogAxis dotAxis(const DotChart& chart, double left) {
  double least = std::numeric_limits<double>::max(), most = 0.0;
  forRows(chart, [&](const DotRow& row) {
    for (const Dot& dot : row.dots) {
      least = std::min(least, dot.value);
      most = std::max(most, dot.value);
    }
  });
  if (most <= 0.0) least = most = 1.0;
  return {least, most, left, dotWidth - dotMargin};
}

double dotBottom(const DotChart& chart) {
  double y = dotTop;
  for (const DotGroup& group : chart.groups)
    y += dotRowHeight * (static_cast<double>(group.rows.size()) + 1.5);
  return y;
}

/// A thin line from the least to the greatest, and the dots on it.
void drawRow(Drawing& drawing, const DotRow& row, double y, double left, const LogAxis& axis) {
  drawing.text({left - 10.0, y + 4.0}, row.label, {12, "#3c4043", Anchor::End});
  drawing.line({{left, y}, {dotWidth - dotMargin, y}}, {dotGridColor});
  for (const Dot& dot : row.dots) drawing.circle({axis.pixel(dot.value), y}, dotRadius, dot.color);
}

}  // namespace

std::string drawDotChart(const DotChart& chart) {
  double labels = 0.0;
  forRows(chart, [&](const DotRow& row) { labels = std::max(labels, textWidth(row.label)); });
  const double left = std::max(leastDotLeft, dotMargin + labels + 10.0), bottom = dotBottom(chart);
  const LogAxis axis = dotAxis(chart, left);
  Svg svg(dotWidth, bottom + 52);
  drawTitle(svg, dotMargin, chart.title, chart.subtitle);
  drawLegend(svg, {dotMargin, 64}, chart.legend);
  for (const double tick : axis.ticks()) {
    svg.line({{axis.pixel(tick), dotTop - 6}, {axis.pixel(tick), bottom}}, {dotGridColor});
    svg.text({axis.pixel(tick), bottom + 16}, tickText(tick), {11, dotQuietColor, Anchor::Middle});
  }
  svg.text({0.5 * (left + dotWidth - dotMargin), bottom + 36}, chart.axis,
           {12, dotQuietColor, Anchor::Middle});
  double y = dotTop + 0.5 * dotRowHeight;
  for (const DotGroup& group : chart.groups) {
    svg.text({dotMargin, y + 4.0}, group.name, {12, "#202124", Anchor::Start, true});
    y += dotRowHeight;
    for (const DotRow& row : group.rows) {
      drawRow(svg, row, y, left, axis);
      y += dotRowHeight;
    }
    y += 0.5 * dotRowHeight;
  }
  return svg.str();
}

}  // namespace prelight::benchmarks
