#include "benchmarks/suites/relighting/relighting_suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "basis/ch.h"
#include "basis/sh_evaluate.h"
#include "benchmarks/lab/harmonic_sums.h"
#include "benchmarks/run/measure.h"
#include "benchmarks/run/timing.h"

namespace prelight::benchmarks {

namespace {

std::vector<WeightedDirection> evenDirections(std::size_t count) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  std::vector<WeightedDirection> directions(count / HarmonicSums::blockSize * HarmonicSums::blockSize);
  for (WeightedDirection& d : directions)
    d = {glm::normalize(glm::vec3(normal(random), normal(random), normal(random))), 1.0f};
  return directions;
}

/// Returns the largest difference between means over the first block and those in double precision.
double meanError(const std::vector<float>& sums, const std::vector<WeightedDirection>& directions, bool isCh,
                 int order) {
  std::vector<double> values(static_cast<std::size_t>(order * order)), truth(values);
  for (std::size_t d = 0; d < HarmonicSums::blockSize; ++d) {
    const glm::dvec3 w = glm::normalize(glm::dvec3(directions[d].towards));
    isCh ? ch::evaluate(w, order, values) : sh::evaluate(w, order, values);
    for (std::size_t i = 0; i < values.size(); ++i) truth[i] += values[i];
  }
  double largest = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
    largest = std::max(largest, std::abs(sums[i] - truth[i]) / HarmonicSums::blockSize);
  return largest;
}

/// Measures all ways in turns at one order. Ways of CH are compared with the way of SH before them.
void compareWays(const Device& device, const std::vector<WeightedDirection>& directions, int order,
                 int rounds, SuiteRun& run) {
  const std::span<const HarmonicWayName> ways = harmonicWays();
  std::vector<HarmonicSums> sums;
  sums.reserve(ways.size());
  for (const HarmonicWayName& way : ways) sums.emplace_back(device.context(), way.way, order, directions);
  std::vector<Contender> contenders;
  for (std::size_t i = 0; i < ways.size(); ++i)
    contenders.push_back({ways[i].name, [&sums, i](std::size_t) { sums[i].run(); }});
  takeTurns(contenders, 1, rounds, run);
  std::size_t peer = 0;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const bool isCh = ways[i].isCh;
    if (!isCh) peer = i;
    const std::string name = fmt::format("order {}/{}", order, ways[i].name);
    const auto add = [&](const char* metric, double value, const char* unit, double ratio) {
      run.results().push_back({name, metric, value, unit, isCh ? ways[peer].name : "",
                               isCh ? std::optional(ratio) : std::nullopt});
    };
    add("time", leastSeconds(contenders[i].seconds, 1) / static_cast<double>(directions.size()),
        "s/direction", medianRatio(contenders[i].cpuSeconds, contenders[peer].cpuSeconds));
    const int own = harmonicOperations(ways[i].way, order);
    add("operations", own, "1/direction", double(harmonicOperations(ways[peer].way, order)) / own);
    run.results().push_back({name, "error", meanError(sums[i].sums(), directions, isCh, order), "1", {}, {}});
  }
}

}  // namespace

void runBasis(const Device& device, const RelightingOptions& options, SuiteRun& run) {
  const std::vector<WeightedDirection> directions = evenDirections(options.basisDirections);
  StepCounter steps(run, "bench basis", options.basisOrders.size());
  for (const int order : options.basisOrders) {
    compareWays(device, directions, order, options.basisRounds, run);
    steps.advance();
  }
}

const OptionTable<RelightingOptions>& RelightingOptions::table() {
  static const OptionTable<RelightingOptions> table =
      OptionTable<RelightingOptions>()
          .add("basisOrders", &RelightingOptions::basisOrders, {2, 3, 4, 5, 6, 7, 8, 9, 10}, {2, 3},
               "orders of `basis`", {.least = 2, .most = 10})
          .add("basisDirections", &RelightingOptions::basisDirections, 1u << 18, 1u << 12,
               "directions in which bases are evaluated, as many for each way to evaluate them",
               {.least = 64, .multipleOf = 64})
          .add("basisRounds", &RelightingOptions::basisRounds, 25, 3,
               "short rounds in which the ways to evaluate a basis take turns")
          .add("waveletFaceSize", &RelightingOptions::waveletFaceSize, 64, 8,
               "texels per side of a face of `wavelets`", {.least = 4, .most = 512, .powerOfTwo = true})
          .add("waveletReceivers", &RelightingOptions::waveletReceivers, 300, 12, "receivers of `wavelets`")
          .add("waveletFrames", &RelightingOptions::waveletFrames, 61, 3,
               "frames of `wavelets`, in each of which lights turn by one degree", {.least = 2})
          .add("waveletCounts", &RelightingOptions::waveletCounts, {10, 30, 100, 300, 1000}, {5, 20},
               "numbers of coefficients that the light of `wavelets` keeps")
          .add("relightVertices", &RelightingOptions::relightVertices, 100000, 200, "vertices of `relight`")
          .add("relightSkyRows", &RelightingOptions::relightSkyRows, 512, 16, "rows of the sky of `relight`",
               {.least = 2, .most = 16384})
          .add("relightRounds", &RelightingOptions::relightRounds, 40, 3,
               "short rounds in which kernels and copies of `relight` take turns");
  return table;
}

std::unique_ptr<Suite> relightingSuite() {
  SuiteOf<RelightingOptions>::Runners parts = {
      {"basis", "time, operations and error of evaluating SH and CH on the device, by order", runBasis},
      {"wavelets", "error and flicker of Haar wavelets by the number of the light's coefficients",
       runWavelets},
      {"relight", "bytes per second of relighting and light projection on the device, against copying",
       runRelight},
  };
  return std::make_unique<SuiteOf<RelightingOptions>>(
      "relighting", "bases of light: their evaluation, their errors and relighting with them",
      std::move(parts));
}

}  // namespace prelight::benchmarks
