#include <fmt/format.h>

#include <algorithm>

#include "benchmarks/charts.h"
#include "benchmarks/svg.h"

namespace prelight::benchmarks {

namespace {

constexpr double barWidth = 760.0;
constexpr double margin = 20.0;
constexpr double leastLeft = 150.0;  // of the bars; labels lie before it
constexpr double labelGap = 10.0;
constexpr double noteGap = 6.0;  // notes lie behind the bars
constexpr double barTop = 96.0;
constexpr double rowHeight = 22.0;
constexpr double barHeight = 12.0;
constexpr double peerHeight = 4.0;
constexpr double groupGap = 14.0;
constexpr std::string_view barGridColor = "#e4e6e9";
constexpr std::string_view peerColor = "#a9b0b8";
constexpr std::string_view barQuietColor = "#6b7178";
constexpr TextStyle labelStyle{12, "#3c4043", Anchor::End};
constexpr TextStyle nameStyle{12, "#202124", Anchor::Start, true};
constexpr TextStyle noteStyle{11, barQuietColor};

double lengthOf(const Bar& bar) {
  double sum = 0.0;
  for (const Bar::Part& part : bar.parts) sum += part.value;
  return sum;
}

template <typename Function>
void forBars(const BarChart& chart, const Function& function) {
  for (const BarGroup& group : chart.groups)
    for (const Bar& bar : group.bars) function(bar);
}

/// Where things lie, by what there is to write.
struct Layout {
  double left = leastLeft;
  double right = 0.0;
  bool namesAbove = false;  ///< groups' names in rows of their own: there is no room beside the labels
  double max = 1.0;         ///< at the right end
  std::vector<double> ticks;

  double x(double value) const { return left + (right - left) * value / max; }
};

/// The axis ends at round numbers.
void chooseAxis(const BarChart& chart, Layout& layout) {
  double most = 0.0;
  forBars(chart, [&](const Bar& bar) { most = std::max({most, lengthOf(bar), bar.peer}); });
  if (most <= 0.0) most = 1.0;
  layout.ticks = linearTicks(0.0, most, 8.0);
  const double step = layout.ticks[1] - layout.ticks[0];
  if (layout.ticks.back() < most * (1.0 - 1e-9)) layout.ticks.push_back(layout.ticks.back() + step);
  layout.max = layout.ticks.back();
}

Layout layoutOf(const BarChart& chart) {
  Layout layout;
  double labels = 0.0, names = 0.0;
  forBars(chart, [&](const Bar& bar) { labels = std::max(labels, textWidth(bar.label, labelStyle)); });
  for (const BarGroup& group : chart.groups) names = std::max(names, textWidth(group.name, nameStyle));
  layout.namesAbove = margin + names + 1.5 * labelGap + labels + labelGap > 240.0;
  layout.left =
      std::max(leastLeft, margin + labels + labelGap + (layout.namesAbove ? 0.0 : names + 1.5 * labelGap));
  chooseAxis(chart, layout);
  // As far right as the notes allow: each lies behind its bar.
  layout.right = barWidth - margin;
  forBars(chart, [&](const Bar& bar) {
    const double room = barWidth - margin - layout.left - noteGap - textWidth(bar.note, noteStyle);
    Layout unit = layout;
    unit.left = 0.0;
    unit.right = 1.0;
    const double share = unit.x(std::max(lengthOf(bar), bar.peer));
    if (share > 0.0) layout.right = std::min(layout.right, layout.left + room / share);
  });
  return layout;
}

double bottomOf(const BarChart& chart, const Layout& layout) {
  double y = barTop;
  for (const BarGroup& group : chart.groups)
    y += (static_cast<double>(group.bars.size()) + (layout.namesAbove && !group.name.empty() ? 1.0 : 0.0)) *
             rowHeight +
         groupGap;
  return y;
}

void drawAxis(Svg& svg, const BarChart& chart, const Layout& layout, double bottom) {
  for (const double tick : layout.ticks) {
    svg.line({{layout.x(tick), barTop - 6}, {layout.x(tick), bottom}}, {barGridColor});
    svg.text({layout.x(tick), bottom + 16}, tickText(tick), {11, barQuietColor, Anchor::Middle});
  }
  svg.text({0.5 * (layout.left + layout.right), bottom + 36}, chart.axis,
           {12, barQuietColor, Anchor::Middle});
}

void drawBar(Svg& svg, const Bar& bar, double y, const Layout& layout) {
  double sum = 0.0;
  for (const Bar::Part& part : bar.parts) {
    const double from = sum > 0.0 ? layout.x(sum) : layout.left;
    sum += part.value;
    svg.rectangle({from, y}, layout.x(sum) - from, barHeight, part.color);
  }
  double end = sum > 0.0 ? layout.x(sum) : layout.left;
  if (bar.peer > 0.0) {
    svg.rectangle({layout.left, y + barHeight}, layout.x(bar.peer) - layout.left, peerHeight, peerColor);
    end = std::max(end, layout.x(bar.peer));
  }
  svg.text({layout.left - labelGap, y + barHeight - 1}, bar.label, labelStyle);
  svg.text({end + noteGap, y + barHeight - 1}, bar.note, noteStyle);
}

}  // namespace

void drawTitle(Drawing& drawing, double x, const std::string& title, const std::string& subtitle) {
  drawing.text({x, 28}, title, {16, "#202124", Anchor::Start, true});
  drawing.text({x, 47}, subtitle, {11, barQuietColor});
}

void drawLegend(Drawing& drawing, Point at, const std::vector<LegendEntry>& legend) {
  for (const LegendEntry& entry : legend) {
    drawing.rectangle(at, 10, 10, entry.color);
    drawing.text({at.x + 15, at.y + 9}, entry.name);
    at.x += 40 + textWidth(entry.name);
  }
}

std::string drawBarChart(const BarChart& chart) {
  const Layout layout = layoutOf(chart);
  const double bottom = bottomOf(chart, layout);
  Svg svg(barWidth, bottom + 52);
  drawTitle(svg, margin, chart.title, chart.subtitle);
  drawLegend(svg, {margin, 64}, chart.legend);
  drawAxis(svg, chart, layout, bottom);
  double y = barTop;
  for (const BarGroup& group : chart.groups) {
    svg.text({margin, y + barHeight - 1}, group.name, nameStyle);
    if (layout.namesAbove && !group.name.empty()) y += rowHeight;
    for (const Bar& bar : group.bars) {
      drawBar(svg, bar, y, layout);
      y += rowHeight;
    }
    y += groupGap;
  }
  return svg.str();
}

}  // namespace prelight::benchmarks
