#pragma once

#include <string>
#include <vector>

#include "benchmarks/drawing.h"

/// The kinds of chart that plots are drawn as.
namespace prelight::benchmarks {

struct LegendEntry {
  std::string name;
  std::string color;
};

/// A row of a bar chart: parts one after the other, and a thinner bar of what it is compared with.
struct Bar {
  struct Part {
    double value = 0.0;
    std::string color;
  };
  std::string label;
  std::vector<Part> parts;
  double peer = 0.0;  ///< 0: none
  std::string note;   ///< behind the bar
};

struct BarGroup {
  std::string name;
  std::vector<Bar> bars;
};

struct BarChart {
  std::string title;
  std::string subtitle;
  std::string axis;
  std::vector<LegendEntry> legend;
  std::vector<BarGroup> groups;
};

std::string drawBarChart(const BarChart& chart);

enum class CurveStyle { Strong, Thin, Dashed };

struct Curve {
  std::string name;
  std::string color;
  CurveStyle style = CurveStyle::Strong;
  std::vector<Point> points;  ///< positive, ascending in x
};

/// Both axes are logarithmic.
struct CurveChart {
  std::string title;
  std::string subtitle;
  std::string xAxis;
  std::string yAxis;
  std::vector<Curve> curves;
};

std::string drawCurveChart(const CurveChart& chart);

/// The same on something that holds a drawing of that size.
constexpr double curveChartWidth = 760.0;
constexpr double curveChartHeight = 500.0;
void drawCurveChart(const CurveChart& chart, Drawing& drawing);

/// Several beside and below one another, two a row.
std::string drawCurvePanels(const std::vector<CurveChart>& panels);

struct Dot {
  double value = 0.0;  ///< > 0
  std::string color;
};

struct DotRow {
  std::string label;
  std::vector<Dot> dots;
};

struct DotGroup {
  std::string name;
  std::vector<DotRow> rows;
};

/// Rows of dots on a logarithmic axis, for values that differ by orders of magnitude.
struct DotChart {
  std::string title;
  std::string subtitle;
  std::string axis;
  std::vector<LegendEntry> legend;
  std::vector<DotGroup> groups;
};

std::string drawDotChart(const DotChart& chart);

/// About `count` round numbers from `min` to `max`, which is above it: multiples of 1, 2 or 5 times a power
/// of ten.
std::vector<double> linearTicks(double min, double max, double count);

/// Round numbers on a logarithmic axis from `min` > 0 to `max`: powers of ten, or more of them where these
/// would be few, at least two wherever numbers differ.
std::vector<double> logTicks(double min, double max);

/// "250 k", "0.02", "2e-5".
std::string tickText(double tick);

/// Squares of colour with their names, from a place to the right.
void drawLegend(Drawing& drawing, Point at, const std::vector<LegendEntry>& legend);

/// Title and subtitle in the upper left corner.
void drawTitle(Drawing& drawing, double left, const std::string& title, const std::string& subtitle);

}  // namespace prelight::benchmarks
