#include "benchmarks/suites/bake/scaling_cases.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <set>

#include "benchmarks/run/line_fit.h"
#include "benchmarks/run/measure.h"

namespace prelight::benchmarks {

namespace {

struct Technique {
  const char* options;
  int shOrder;
  int bounces;
};

constexpr std::array<Technique, 2> techniques = {{{"--ao", 0, 0}, {"--ao --sh 3 --bounces 1", 3, 1}}};

/// This many rays a vertex are what every size is measured with.
constexpr std::uint64_t commonRays = 64;

bool isWanted(const ScalingCase& some, std::uint64_t vertices, const BakeOptions& options) {
  if (some.name() == options.onlyCase) return true;
  const bool affordable = some.rays == commonRays || some.rays * vertices <= options.scalingMostRays;
  return affordable && some.name().find(options.onlyCase) != std::string::npos;
}

}  // namespace

std::string ScalingCase::name() const { return fmt::format("{}/{}/{} rays", scene, technique, rays); }

std::vector<std::string> ScalingCase::options() const {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < technique.size();) {
    const std::size_t end = std::min(technique.find(' ', at), technique.size());
    words.push_back(technique.substr(at, end - at));
    at = end + 1;
  }
  words.insert(words.end(), {"--rays", std::to_string(rays)});
  return words;
}

std::vector<ScalingCase> scalingCases(const std::string& scene, std::uint64_t vertices,
                                      const BakeOptions& options) {
  std::vector<ScalingCase> cases;
  for (const Technique& technique : techniques)
    for (const std::uint64_t rays : options.scalingRays) {
      ScalingCase some{scene, technique.options, rays, aoRequest(rays, 0)};
      some.request.sh.order = technique.shOrder;
      some.request.bounces = technique.bounces;
      if (isWanted(some, vertices, options)) cases.push_back(std::move(some));
    }
  return cases;
}

double bakeSeconds(const nlohmann::ordered_json& report) {
  const std::set<std::string> before = {"load", "compile", "plan", "device"};
  double seconds = 0.0;
  for (const auto& stage : report.at("stages").items())
    if (!before.contains(stage.key())) seconds += stage.value().get<double>();
  return seconds;
}

double bakeProcessorSeconds(const nlohmann::ordered_json& report) {
  double seconds = 0.0;
  for (const auto& part : report.at("processorSeconds").items()) seconds += part.value().get<double>();
  return seconds;
}

double powerOf(std::vector<Point> points) {
  for (Point& p : points) p = {std::log(p.x), std::log(p.y)};
  return fitLine(points).slope;
}

}  // namespace prelight::benchmarks
