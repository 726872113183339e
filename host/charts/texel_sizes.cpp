#include "charts/texel_sizes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/kept_work.h"
#include "base/parallel.h"
#include "charts/hidden_light.h"
#include "charts/light_map_lookup.h"
#include "charts/make_light_map_layout.h"
#include "charts/texel_cells.h"

namespace prelight {

namespace {

constexpr double leastAcross = 2.0;  // texels; smaller charts are not judged
constexpr double firstPilot =
    4.0;  // texel size of the first pilots, relative to the size chosen without errors
constexpr double texelsAcrossPilot = 6;  // least number of texels along a chart in its first pilot
// Number of half-octave steps from the first pilots up to the coarsest size tried.
constexpr int coarsestStep = 8;
constexpr int leastSteps = 4;  // at least an octave's, which shows how errors fall
constexpr double steepest = 1.0 / 16.0,
                 flattest = 0.5;  // ratio of squared errors per octave: for smooth light, for edges

bool isSpeck(const LightMapCharts& charts, std::size_t chart) {
  return charts.charts[chart].size.x < leastAcross * charts.texelSize;
}

/// The squared error of a chart at a texel size, and its uncertainty due to the pilots' noise.
struct Estimate {
  double error = 0.0;
  double uncertainty = 0.0;
};

/// ChartSums over a chart's texels.
struct ChartSums {
  double products = 0.0;
  double squares = 0.0;  ///< squares of the products
  double light = 0.0;
  double count = 0.0;

  void add(double product, double lightThere) {
    products += product;
    squares += product * product;
    light += lightThere;
    count += 1.0;
  }

  Estimate relativeTo(double mean) const {
    if (!(count > 0.0 && mean > 0.0)) return {};
    const double average = products / count;
    const double variance = std::max(0.0, squares / count - average * average);
    return {std::max(0.0, average) / (mean * mean),
            std::sqrt(variance / std::max(1.0, count - 1.0)) / (mean * mean)};
  }
};

/// Two independent light maps of the same texels.
struct Pilot {
  std::array<LightMap, 2> maps;
  std::array<std::vector<glm::dvec3>, 2> light;  ///< values that a look-up shows, [index in layout.texels]
  std::vector<std::uint8_t> hidden;              ///< [index in layout.texels]

  const LightMapLayout& layout() const { return maps[0].layout; }
};

glm::dvec3 valueAt(const LightMap& map, const LightMapTexel& texel) {
  return lightMapIrradiance(map, texel.face, double(texel.b1), double(texel.b2));
}

Pilot makePilot(LightMapLayout layout, PilotLight light) {
  Pilot pilot;
  pilot.hidden = std::move(light.hidden);
  for (std::size_t i = 0; i < 2; ++i) {
    LightMap& map = pilot.maps[i];
    map.layout = layout;
    map.values.assign(3 * layout.texelCount(), 0.0f);
    fillHidden(layout, 3, pilot.hidden, light.irradiance[i]);
    for (std::size_t t = 0; t < layout.texels.size(); ++t)
      std::copy_n(&light.irradiance[i][3 * t], 3, &map.values[3 * std::size_t{layout.texels[t].texel}]);
    for (const LightMapTexel& texel : layout.texels) pilot.light[i].push_back(valueAt(map, texel));
  }
  return pilot;
}

/// Returns the map on a coarser layout whose texels are means of a pilot over their cells.
LightMap sampled(const CompiledScene& scene, const LightMap& pilot, const LightMapLayout& layout) {
  const TexelCells cells(scene, layout);
  LightMap map;
  map.layout = layout;
  map.values.assign(3 * layout.texelCount(), 0.0f);
  parallelRanges(layout.texels.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      glm::dvec3 value(0.0);
      for (const LightMapTexel& place : cells.around(layout.texels[t]))
        value += valueAt(pilot, place) / double(TexelCells::placeCount);
      for (std::size_t c = 0; c < 3; ++c)
        map.values[3 * std::size_t{layout.texels[t].texel} + c] =
            static_cast<float>(value[static_cast<int>(c)]);
    }
  });
  return map;
}

class TexelSizer {
 public:
  TexelSizer(const CompiledScene& scene, const LightMapCharts& charts, const TexelSizeRequest& request,
             const PilotSource& light)
      : scene_(scene),
        charts_(charts),
        request_(request),
        light_(light),
        pilotSizes_(charts.charts.size()),
        tooLarge_(charts.charts.size()) {
    result_.sizes.assign(charts.charts.size(), std::max(request.finest, charts.texelSize));
    result_.errors.assign(charts.charts.size(), 0.0);
    for (std::uint32_t c = 0; c < charts.charts.size(); ++c) start(c);
  }

  TexelSizes run(Progress& progress) {
    const double first = static_cast<double>(active_.size());
    WorkPart part(progress, "texel sizes", [this](auto& state) { this->exchange(state); });
    while (!active_.empty()) {
      progress.report("texel sizes", 1.0 - static_cast<double>(active_.size()) / first);
      progress.check();
      judge();
      part.advance();
    }
    part.finish();
    return std::move(result_);
  }

 private:
  /// Saves or loads what is known of each chart.
  template <typename State>
  void exchange(State& state) {
    for (std::vector<double>* sizes : {&result_.sizes, &result_.errors, &pilotSizes_, &tooLarge_}) {
      state.sameSize(*sizes);
      state.requireFinite(*sizes);
      state.check(
          [&] { return std::all_of(sizes->begin(), sizes->end(), [](double s) { return s >= 0.0; }); });
    }
    state.value(result_.specks);
    state.value(result_.limited);
    state.value(result_.rays);
    bool known = sceneMean_.has_value();
    state.value(known);
    if (known && !sceneMean_) sceneMean_.emplace();
    if (known) state.value(*sceneMean_);
    state.require(!known || std::isfinite(*sceneMean_));
    state.values(active_);
    state.check([&] {
      return std::all_of(active_.begin(), active_.end(), [&](std::uint32_t chart) {
        return chart < charts_.charts.size() && pilotSizes_[chart] >= request_.finest &&
               pilotSizes_[chart] > 0.0;
      });
    });
  }

  void start(std::uint32_t chart) {
    if (isSpeck(charts_, chart)) {
      ++result_.specks;
      return;
    }
    pilotSizes_[chart] = std::max(request_.finest, std::min(charts_.charts[chart].size.x / texelsAcrossPilot,
                                                            firstPilot * charts_.texelSize));
    tooLarge_[chart] = pilotSizes_[chart] * std::exp2(0.5 * (coarsestStep + 1));
    active_.push_back(chart);
  }

  /// Returns the number of steps from a pilot's size up to the coarsest size to be tried in any active chart.
  int stepsToTry() const {
    double most = 1.0;
    for (const std::uint32_t c : active_) most = std::max(most, tooLarge_[c] / pilotSizes_[c]);
    return std::max(leastSteps, static_cast<int>(std::lround(2.0 * std::log2(most))) - 1);
  }

  LightMapCharts activeCharts() const {
    LightMapCharts some{{}, charts_.area, charts_.texelSize};
    for (const std::uint32_t c : active_) some.charts.push_back(charts_.charts[c]);
    return some;
  }

  /// Returns the layout of active charts at `factor` times their pilots' texel sizes.
  LightMapLayout layoutAt(double factor, const LightMapCharts& active) const {
    std::vector<double> sizes;
    for (const std::uint32_t c : active_) sizes.push_back(factor * pilotSizes_[c]);
    return layOutLightMap(scene_, active, sizes);
  }

  /// Returns [active chart] sums of a pilot's differences from a coarser layout.
  std::vector<ChartSums> compare(const Pilot& pilot, const LightMapLayout& layout) const {
    const std::array<LightMap, 2> coarse{sampled(scene_, pilot.maps[0], layout),
                                         sampled(scene_, pilot.maps[1], layout)};
    const std::vector<LightMapTexel>& texels = pilot.layout().texels;
    std::vector<std::array<double, 2>> found(texels.size());  // product of the two differences, light
    parallelRanges(texels.size(), 4096, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        const glm::dvec3 &one = pilot.light[0][t], &other = pilot.light[1][t];
        const glm::dvec3 off = valueAt(coarse[0], texels[t]) - one,
                         alsoOff = valueAt(coarse[1], texels[t]) - other;
        const glm::dvec3 both = one + other;
        found[t] = {glm::dot(off, alsoOff) / 3.0, (both.x + both.y + both.z) / 6.0};
      }
    });
    std::vector<ChartSums> sums(active_.size());
    for (std::size_t t = 0; t < texels.size(); ++t)
      if (pilot.hidden[t] == 0) sums[layout.chartOf[texels[t].face]].add(found[t][0], found[t][1]);
    return sums;
  }

  void judge() {
    const LightMapCharts active = activeCharts();
    const LightMapLayout layout = layoutAt(1.0, active);
    PilotLight light = light_(layout);
    result_.rays += light.rays;
    const Pilot pilot = makePilot(layout, std::move(light));
    const int steps = stepsToTry();
    std::vector<std::vector<ChartSums>> sums;  // [step from an octave on][active chart]
    for (int step = 2; step <= steps; ++step)
      sums.push_back(compare(pilot, layoutAt(std::exp2(0.5 * step), active)));
    if (!sceneMean_) sceneMean_ = meanOf(sums.front());
    std::vector<std::uint32_t> rest;
    for (std::size_t a = 0; a < active_.size(); ++a) {
      const ChartSums& sum = sums.front()[a];
      const double mean = std::max(sum.count > 0.0 ? sum.light / sum.count : 0.0,
                                   TexelSizeRequest::darkestMean * *sceneMean_);
      std::vector<Estimate> estimates;
      for (const std::vector<ChartSums>& step : sums) estimates.push_back(step[a].relativeTo(mean));
      if (!choose(active_[a], estimates)) rest.push_back(active_[a]);
    }
    active_ = std::move(rest);
    for (const std::uint32_t c : active_) pilotSizes_[c] = std::max(request_.finest, 0.5 * pilotSizes_[c]);
  }

  /// Returns the mean light over the surface of all active charts.
  double meanOf(const std::vector<ChartSums>& sums) const {
    double light = 0.0, area = 0.0;
    for (std::size_t a = 0; a < active_.size(); ++a) {
      const double texel = pilotSizes_[active_[a]] * pilotSizes_[active_[a]];
      light += texel * sums[a].light;
      area += texel * sums[a].count;
    }
    return area > 0.0 ? light / area : 0.0;
  }

  bool suffices(const Estimate& estimate) const {
    return estimate.error + estimate.uncertainty <= request_.error * request_.error;
  }

  bool failsForSure(const Estimate& estimate) const {
    return estimate.error - estimate.uncertainty > request_.error * request_.error;
  }

  /// Chooses a chart's texel size. `estimates`: for twice the pilot's size and on, in half octaves. Returns
  /// false when a finer pilot is needed.
  bool choose(std::uint32_t chart, const std::vector<Estimate>& estimates) {
    const auto failed = std::find_if(estimates.begin(), estimates.end(),
                                     [&](const Estimate& estimate) { return !suffices(estimate); });
    if (failed != estimates.begin()) {
      const auto step = failed - estimates.begin() - 1;
      set(chart, 2 + static_cast<int>(step), estimates[static_cast<std::size_t>(step)].error);
      return true;
    }
    for (std::size_t step = estimates.size(); step-- > 0;)
      if (failsForSure(estimates[step]))
        tooLarge_[chart] = pilotSizes_[chart] * std::exp2(0.5 * static_cast<double>(step + 2));
    // The pilot cannot judge sizes nearer to its own; errors are assumed to fall further as over the last
    // octave.
    const Estimate &twice = estimates[0], &fourTimes = estimates[2];
    const double octave =
        fourTimes.error > 0.0 ? std::clamp(twice.error / fourTimes.error, steepest, flattest) : flattest;
    Estimate expected = twice;
    for (const int step : {1, 0}) {
      expected.error *= std::sqrt(octave);
      expected.uncertainty *= std::sqrt(octave);
      if (!suffices(expected)) continue;
      set(chart, step, expected.error);
      return true;
    }
    if (pilotSizes_[chart] > request_.finest) return false;
    set(chart, 0, expected.error);
    if (expected.error > request_.error * request_.error) ++result_.limited;
    return true;
  }

  void set(std::uint32_t chart, int step, double squaredError) {
    result_.sizes[chart] = pilotSizes_[chart] * std::exp2(0.5 * step);
    result_.errors[chart] = std::sqrt(squaredError);
  }

  const CompiledScene& scene_;
  const LightMapCharts& charts_;
  TexelSizeRequest request_;
  const PilotSource& light_;
  std::vector<double> pilotSizes_;  ///< [chart], m
  std::vector<double> tooLarge_;    ///< [chart] m; sizes from here on are known to fail
  std::vector<std::uint32_t> active_;
  std::optional<double> sceneMean_;  ///< W/m2
  TexelSizes result_;
};

}  // namespace

TexelSizeReport reportOf(const TexelSizes& sizes, const LightMapCharts& charts) {
  TexelSizeReport report;
  report.specks = sizes.specks;
  report.limited = sizes.limited;
  if (sizes.sizes.empty()) return report;
  const auto [smallest, largest] = std::minmax_element(sizes.sizes.begin(), sizes.sizes.end());
  report.smallest = *smallest;
  report.largest = *largest;
  double squares = 0.0, areas = 0.0;
  for (std::size_t c = 0; c < sizes.sizes.size(); ++c) {
    if (isSpeck(charts, c)) continue;
    const double area = flatArea(charts.charts[c]);
    squares += area * sizes.errors[c] * sizes.errors[c];
    areas += area;
  }
  if (areas > 0.0) report.error = std::sqrt(squares / areas);
  return report;
}

TexelSizes chooseTexelSizes(const CompiledScene& scene, const LightMapCharts& charts,
                            const TexelSizeRequest& request, const PilotSource& light, Progress& progress) {
  return TexelSizer(scene, charts, request, light).run(progress);
}

}  // namespace prelight
