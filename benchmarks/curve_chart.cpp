#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "benchmarks/charts.h"
#include "benchmarks/log_axis.h"
#include "benchmarks/svg.h"

namespace prelight::benchmarks {

namespace {

constexpr double curveWidth = curveChartWidth;
constexpr double curveHeight = curveChartHeight;
constexpr double left = 80.0;
constexpr double leastRight = 480.0;  // names of curves lie behind it
constexpr double curveTop = 72.0;
constexpr double bottom = 440.0;
constexpr double nameHeight = 16.0;
constexpr double sampleWidth = 22.0;
constexpr std::string_view curveGridColor = "#e4e6e9";
constexpr std::string_view curveQuietColor = "#6b7178";

struct Axes {
  double right;
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
  double names = 0.0;
  for (const Curve& curve : chart.curves) names = std::max(names, textWidth(curve.name));
  const double right = std::max(leastRight, curveWidth - 40.0 - sampleWidth - names);
  return {right, LogAxis(min.x, max.x, left, right), LogAxis(min.y, max.y, bottom, curveTop)};
}

void drawGrid(Drawing& drawing, const CurveChart& chart, const Axes& axes) {
  for (const double tick : axes.x.ticks()) {
    const double x = axes.x.pixel(tick);
    drawing.line({{x, curveTop}, {x, bottom}}, {curveGridColor});
    drawing.text({x, bottom + 18}, tickText(tick), {11, curveQuietColor, Anchor::Middle});
  }
  for (const double tick : axes.y.ticks()) {
    const double y = axes.y.pixel(tick);
    drawing.line({{left, y}, {axes.right, y}}, {curveGridColor});
    drawing.text({left - 8, y + 4}, tickText(tick), {11, curveQuietColor, Anchor::End});
  }
  drawing.text({0.5 * (left + axes.right), bottom + 42}, chart.xAxis, {12, curveQuietColor, Anchor::Middle});
  drawing.text({24, 0.5 * (curveTop + bottom)}, chart.yAxis,
               {.size = 12, .color = curveQuietColor, .anchor = Anchor::Middle, .upright = true});
}

void drawCurve(Drawing& drawing, const Curve& curve, const std::vector<Point>& pixels) {
  const bool strong = curve.style == CurveStyle::Strong;
  drawing.line(pixels, {curve.color, strong ? 2.5 : 1.2, curve.style == CurveStyle::Dashed});
  for (const Point& p : pixels) drawing.circle(p, strong ? 4.0 : 2.5, curve.color);
}

/// Names beside the curves' ends, with a piece of each curve: moved down where they would lie on one another,
/// and all up again where they would leave the chart.
void drawNames(Drawing& drawing, const CurveChart& chart, const Axes& axes) {
  std::vector<const Curve*> curves;
  for (const Curve& curve : chart.curves)
    if (!curve.points.empty()) curves.push_back(&curve);
  const auto end = [&](const Curve* curve) { return axes.pixel(curve->points.back()).y; };
  std::sort(curves.begin(), curves.end(), [&](const Curve* a, const Curve* b) { return end(a) < end(b); });
  std::vector<double> places;
  for (const Curve* curve : curves)
    places.push_back(std::max(end(curve), places.empty() ? curveTop : places.back() + nameHeight));
  double limit = bottom;
  for (std::size_t i = places.size(); i-- > 0; limit -= nameHeight) places[i] = std::min(places[i], limit);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const double x = axes.right + 12.0, y = places[i];
    drawCurve(drawing, *curves[i], {{x, y}, {x + sampleWidth, y}});
    drawing.text({x + sampleWidth + 8.0, y + 4.0}, curves[i]->name, {12, curves[i]->color});
  }
}

/// Draws elsewhere on another drawing.
class Moved final : public Drawing {
 public:
  Moved(Drawing& drawing, Point by) : drawing_(drawing), by_(by) {}

  void rectangle(Point corner, double width, double height, std::string_view color) override {
    drawing_.rectangle(moved(corner), width, height, color);
  }
  void circle(Point centre, double radius, std::string_view color) override {
    drawing_.circle(moved(centre), radius, color);
  }
  void line(const std::vector<Point>& points, const Stroke& stroke) override {
    std::vector<Point> all;
    for (const Point& point : points) all.push_back(moved(point));
    drawing_.line(all, stroke);
  }
  void text(Point at, std::string_view text, const TextStyle& style) override {
    drawing_.text(moved(at), text, style);
  }

 private:
  Point moved(Point point) const { return {point.x + by_.x, point.y + by_.y}; }

  Drawing& drawing_;
  Point by_;
};

}  // namespace

void drawCurveChart(const CurveChart& chart, Drawing& drawing) {
  drawTitle(drawing, 20, chart.title, chart.subtitle);
  if (std::all_of(chart.curves.begin(), chart.curves.end(),
                  [](const Curve& c) { return c.points.empty(); })) {
    drawing.text({0.5 * curveWidth, 0.5 * curveHeight}, "no results above 0",
                 {12, curveQuietColor, Anchor::Middle});
    return;
  }
  const Axes axes = axesOf(chart);
  drawGrid(drawing, chart, axes);
  for (const Curve& curve : chart.curves) {
    std::vector<Point> pixels;
    for (const Point& p : curve.points) pixels.push_back(axes.pixel(p));
    drawCurve(drawing, curve, pixels);
  }
  drawNames(drawing, chart, axes);
}

std::string drawCurvePanels(const std::vector<CurveChart>& panels) {
  const std::size_t columns = std::min<std::size_t>(panels.size(), 2);
  const std::size_t rows = columns == 0 ? 0 : (panels.size() + columns - 1) / columns;
  Svg svg(curveWidth * static_cast<double>(columns), curveHeight * static_cast<double>(rows));
  for (std::size_t i = 0; i < panels.size(); ++i) {
    Moved place(
        svg, {curveWidth * static_cast<double>(i % columns), curveHeight * static_cast<double>(i / columns)});
    drawCurveChart(panels[i], place);
  }
  return svg.str();
}

std::string drawCurveChart(const CurveChart& chart) {
  Svg svg(curveWidth, curveHeight);
  drawCurveChart(chart, svg);
  return svg.str();
}

}  // namespace prelight::benchmarks
