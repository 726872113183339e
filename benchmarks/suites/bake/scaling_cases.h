#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/run/line_fit.h"
#include "benchmarks/suites/bake/bake_suite.h"
#include "prelight/request.h"

namespace prelight::benchmarks {

/// One whole bake of `bake-scaling`.
struct ScalingCase {
  std::string scene;       ///< "balls 407k"
  std::string technique;   ///< as options of the command line
  std::uint64_t rays = 0;  ///< a vertex
  BakeRequest request = {};

  std::string name() const;                  ///< "balls 407k/--ao --sh 3/64 rays"
  std::vector<std::string> options() const;  ///< arguments of `prelight bake`
};

/// Every technique at every number of rays that the options let a scene of so many vertices have.
std::vector<ScalingCase> scalingCases(const std::string& scene, std::uint64_t vertices,
                                      const BakeOptions& options);

/// Sums over the stages of a bake's report, from the first after the device was opened, "prepare", to
/// "write": seconds, and processor time of all threads, s.
double bakeSeconds(const nlohmann::ordered_json& report);
double bakeProcessorSeconds(const nlohmann::ordered_json& report);

/// Exponent of the power law through points of positive coordinates; there must be two different x.
double powerOf(std::vector<Point> points);

}  // namespace prelight::benchmarks
