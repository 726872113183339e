#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "benchmarks/charts.h"

namespace prelight::benchmarks {

namespace {

constexpr double width = 760.0;
constexpr double height = 500.0;
constexpr double left = 80.0;
constexpr double right = 580.0;  // names of curves lie behind it
constexpr double top = 72.0;
constexpr double bottom = 440.0;
constexpr double nameHeight = 15.0;
constexpr std::string_view gridColor = "#e4e6e9";
constexpr std::string_view quietColor = "#6b7178";

/// Maps positive numbers to pixels by their logarithm.
class LogAxis {
 public:
  LogAxis(double min, double max, double from, double to)
      : min_(std::log(min / margin)), max_(std::log(max * margin)), from_(from), to_(to) {}

  double pixel(double value) const {
    return from_ + (to_ - from_) * (std::log(value) - min_) / (max_ - min_);
  }

  /// Powers of ten; 2 and 5 times those as well where the axis has few.
  std::vector<double> ticks() const {
    std::vector<double> values;
    for (double power = std::pow(10.0, std::floor(min_ / std::log(10.0))); std::log(power) <= max_;
         power *= 10.0)
      for (const double factor : {1.0, 2.0, 5.0})
        if (factor > 1.0 && max_ - min_ > 3.0 * std::log(10.0))
          break;
        else if (const double v = std::log(factor * power); v >= min_ && v <= max_)
          values.push_back(factor * power);
    return values;
  }

 private:
  static constexpr double margin = 1.15;
  double min_, max_, from_, to_;
};

std::string tickText(double tick) {
  if (tick >= 1e6) return fmt::format("{:.6g} M", tick * 1e-6);
  if (tick >= 1e4) return fmt::format("{:.6g} k", tick * 1e-3);
  return fmt::format("{:.6g}", tick);
}

struct Axes {
  LogAxis x, y;
  Point pixel(const Point& p) const { return {x.pixel(p.x), y.pixel(p.y)}; }
};

Axes axesOf(const CurveChart& chart) {
  constexpr double far = std::numeric_limits<double>::max();
  Point min{far, far}, max{0.0, 0.0};
  for (const Curve& curve : chart.curves)
    for (const Point& p : curve.points) {
      min = {std::min(min.x, p.x), std::min(min.y, p.y)};
      max = {std::max(max.x, p.x), std::max(max.y, p.y)};
    }
  return {LogAxis(min.x, max.x, left, right), LogAxis(min.y, max.y, bottom, top)};
}

void drawGrid(Svg& svg, const CurveChart& chart, const Axes& axes) {
  for (const double tick : axes.x.ticks()) {
    const double x = axes.x.pixel(tick);
    svg.line({{x, top}, {x, bottom}}, {gridColor});
    svg.text({x, bottom + 18}, tickText(tick), {11, quietColor, Anchor::Middle});
  }
  for (const double tick : axes.y.ticks()) {
    const double y = axes.y.pixel(tick);
    svg.line({{left, y}, {right, y}}, {gridColor});
    svg.text({left - 8, y + 4}, tickText(tick), {11, quietColor, Anchor::End});
  }
  svg.text({0.5 * (left + right), bottom + 42}, chart.xAxis, {12, quietColor, Anchor::Middle});
  svg.text({24, 0.5 * (top + bottom)}, chart.yAxis,
           {.size = 12, .color = quietColor, .anchor = Anchor::Middle, .upright = true});
}

/// Names at the curves' ends, moved down where they would lie on one another.
void drawNames(Svg& svg, const CurveChart& chart, const Axes& axes) {
  std::vector<const Curve*> curves;
  for (const Curve& curve : chart.curves)
    if (!curve.points.empty()) curves.push_back(&curve);
  const auto end = [&](const Curve* curve) { return axes.pixel(curve->points.back()); };
  std::sort(curves.begin(), curves.end(),
            [&](const Curve* a, const Curve* b) { return end(a).y < end(b).y; });
  double free = top;
  for (const Curve* curve : curves) {
    const double y = std::max(end(curve).y + 4, free);
    svg.text({right + 8, y}, curve->name, {12, curve->color});
    free = y + nameHeight;
  }
}

}  // namespace

std::string drawCurveChart(const CurveChart& chart) {
  const Axes axes = axesOf(chart);
  Svg svg(width, height);
  drawTitle(svg, 20, chart.title, chart.subtitle);
  drawGrid(svg, chart, axes);
  for (const Curve& curve : chart.curves) {
    std::vector<Point> pixels;
    for (const Point& p : curve.points) pixels.push_back(axes.pixel(p));
    const bool strong = curve.style == CurveStyle::Strong;
    svg.line(pixels, {curve.color, strong ? 2.5 : 1.2, curve.style == CurveStyle::Dashed});
    for (const Point& p : pixels) svg.circle(p, strong ? 4.0 : 2.5, curve.color);
  }
  drawNames(svg, chart, axes);
  return svg.str();
}

}  // namespace prelight::benchmarks
