#include "benchmarks/charts.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "benchmarks/plot.h"

namespace prelight::benchmarks {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// A text of a drawing and the box that it takes.
struct Written {
  std::string text;
  double left = 0.0, right = 0.0, top = 0.0, bottom = 0.0;
};

std::vector<Written> textsOf(const std::string& svg) {
  const std::regex pattern(
      "<text x=\"([^\"]*)\" y=\"([^\"]*)\" "
      "font-size=\"([^\"]*)\"[^>]*text-anchor=\"([^\"]*)\"([^>]*)>([^<]*)<");
  std::vector<Written> texts;
  for (std::sregex_iterator it(svg.begin(), svg.end(), pattern), end; it != end; ++it) {
    const std::string rest = (*it)[5];
    if (rest.find("rotate") != std::string::npos) continue;  // the name of an axis, in a margin of its own
    const double x = std::stod((*it)[1]), y = std::stod((*it)[2]), size = std::stod((*it)[3]);
    const std::string anchor = (*it)[4], text = (*it)[6];
    const double width = textWidth(text, {.size = size, .bold = rest.find("bold") != std::string::npos});
    const double left = anchor == "start" ? x : anchor == "middle" ? x - 0.5 * width : x - width;
    texts.push_back({text, left, left + width, y - 0.8 * size, y + 0.2 * size});
  }
  return texts;
}

void expectReadable(const std::string& svg) {
  const std::vector<Written> texts = textsOf(svg);
  EXPECT_GT(texts.size(), 3u);
  const double width = std::stod(svg.substr(svg.find("width=\"") + 7));
  const double height = std::stod(svg.substr(svg.find("height=\"") + 8));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const Written& a = texts[i];
    EXPECT_GE(a.left, 0.0) << a.text;
    EXPECT_LE(a.right, width) << a.text;
    EXPECT_LE(a.bottom, height) << a.text;
    for (std::size_t k = i + 1; k < texts.size(); ++k) {
      const Written& b = texts[k];
      const bool apart = a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top;
      EXPECT_TRUE(apart) << "'" << a.text << "' lies on '" << b.text << "'";
    }
  }
}

BarChart barChart(const std::string& group, const std::string& label, double value) {
  return {"Title",
          "subtitle",
          "seconds",
          {{"now", "#000000"}, {"a rather long name of then", "#ff0000"}},
          {{group,
            {{label, {{value, "#000000"}}, 0.3 * value, "a note of some length"},
             {"b", {{0.01 * value, "#000000"}}, 0.0, "c"}}},
           {"other", {{"d", {{0.5 * value, "#000000"}}, value, "note"}}}}};
}

TEST(BarChart, NamesLabelsAndNotes_LieBesideOneAnother) {
  for (const char* group : {"", "shapes", "cornell, with all of its boxes moving about"}) {
    for (const char* label : {"AO", "SH rotation, order 6, 3000 functions at a time"}) {
      for (const double value : {1e-4, 0.7, 9.99, 58.3, 123456.0}) {
        SCOPED_TRACE(std::string(group) + "/" + label + "/" + std::to_string(value));
        expectReadable(drawBarChart(barChart(group, label, value)));
      }
    }
  }
}

TEST(CurveChart, NamesOfManyCurves_LieBesideOneAnother) {
  for (const double end : {1e-7, 0.5, 300.0}) {
    CurveChart chart{"Title", "subtitle", "bytes", "error", {}};
    for (int i = 0; i < 22; ++i)
      chart.curves.push_back({"curve " + std::to_string(i),
                              "#000000",
                              CurveStyle::Dashed,
                              {{1.0, 2.0}, {30.0, end * (1.0 + 0.001 * i)}}});
    expectReadable(drawCurveChart(chart));
  }
}

TEST(CurveChart, OfOnePointOrNone_IsStillAChart) {
  expectReadable(
      drawCurveChart({"Title", "s", "x", "y", {{"one", "#000000", CurveStyle::Strong, {{3.3, 0.21}}}}}));
  const std::string empty =
      drawCurveChart({"Title", "s", "x", "y", {{"none", "#000000", CurveStyle::Strong, {}}}});
  EXPECT_THAT(empty, HasSubstr("no results"));
  EXPECT_THAT(empty, Not(HasSubstr("nan")));
}

TEST(Ticks, Linear_AreRoundNumbersWithinTheRange) {
  EXPECT_THAT(linearTicks(0.0, 58.0, 8.0), ElementsAre(0, 10, 20, 30, 40, 50));
  EXPECT_THAT(linearTicks(0.0, 60.0, 8.0), ElementsAre(0, 10, 20, 30, 40, 50, 60));
  EXPECT_THAT(linearTicks(2.1, 4.9, 6.0), ElementsAre(2.5, 3, 3.5, 4, 4.5));
}

TEST(Ticks, Logarithmic_AreThereForEveryRange) {
  EXPECT_THAT(logTicks(0.5, 20.0), ElementsAre(0.5, 1, 2, 5, 10, 20));
  EXPECT_THAT(logTicks(0.5, 2e4), ElementsAre(1, 10, 100, 1000, 10000));
  for (double min = 1e-9; min < 1e9; min *= 3.7) {
    for (const double ratio : {1.05, 1.3, 2.0, 9.0, 11.0, 500.0, 1e4, 1e9, 1e15}) {
      const std::vector<double> ticks = logTicks(min, min * ratio);
      EXPECT_GE(ticks.size(), 2u) << min << ' ' << ratio;
      EXPECT_LE(ticks.size(), 10u) << min << ' ' << ratio;
      EXPECT_TRUE(std::is_sorted(ticks.begin(), ticks.end()));
      EXPECT_GE(ticks.front(), min * (1.0 - 1e-6));
      EXPECT_LE(ticks.back(), min * ratio * (1.0 + 1e-6));
    }
  }
}

TEST(Ticks, Text_IsShortAndExact) {
  EXPECT_EQ(tickText(0.0), "0");
  EXPECT_EQ(tickText(0.02), "0.02");
  EXPECT_EQ(tickText(2000), "2000");
  EXPECT_EQ(tickText(250000), "250 k");
  EXPECT_EQ(tickText(1e-5), "1e-5");
  EXPECT_EQ(tickText(2e-12), "2e-12");
}

TEST(Plots, OfTransferSuites_AreReadable) {
  const auto result = [](const char* suite, const std::string& name, const char* metric, double value) {
    BenchmarkResult r;
    r.suite = suite;
    r.case_ = name;
    r.metric = metric;
    r.value = value;
    r.ratio = 70.0;
    return r;
  };
  std::vector<BenchmarkResult> results;
  for (const char* name : {"shapes/AO", "shiny shapes/SH3/DD+SS", "crowd under a sky/VO/DD auto:12"})
    results.push_back(result("techniques", name, "FLIP", 0.3));
  for (const char* name : {"shapes/traced at vertices", "shapes/auto:12/thesis, N = 2"})
    results.push_back(result("vo", name, "error, lights around", 0.6));
  for (const char* name : {"swing/two seeds", "cornell, boxes moving/3 keys/linear"})
    results.push_back(result("animation", name, "rms error", 0.2));
  for (const char* name : {"copy", "SH rotation, order 6, 3000 functions"})
    results.push_back(result("relight", name, "bandwidth a core", 3e9));
  for (const char* scene : {"cornell", "rooms"})
    for (const std::string way : {"all", "cache", "guided"}) {
      for (const char* rays : {"/16 rays", "/32 rays"})
        for (const char* metric : {"error", "time"})
          results.push_back(result("gather", scene + ("/" + way) + rays, metric, 0.02));
      results.push_back(result("gather", scene + ("/" + way) + "/long run", "bias", 0.01));
    }
  for (const char* scene : {"shapes", "CesiumMilkTruck"})
    for (const char* size : {"640x360", "1280x720"})
      for (const char* metric : {"median frame", "latency to the next picture", "part: shadow maps"})
        for (const char* movement : {"orbit", "moving light"})
          results.push_back(
              result("viewer", fmt::format("{}/lightmap/{}/{}", scene, size, movement), metric, 30.0));
  const std::vector<Plot> plots = makePlots(results, "device");
  ASSERT_EQ(plots.size(), 9u);
  for (const Plot& plot : plots) {
    SCOPED_TRACE(plot.name);
    expectReadable(plot.svg);
  }
}

}  // namespace
}  // namespace prelight::benchmarks
