#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/run/measure.h"
#include "benchmarks/suites/bake/bake_suite.h"
#include "prelight/techniques.h"

namespace prelight::benchmarks {

/// One whole bake of `bake-scaling`.
struct ScalingCase {
  std::string scene;       ///< "balls 407k"
  std::string technique;   ///< options of the command line
  std::uint64_t rays = 0;  ///< per vertex
  BakeRequest request = {};

  std::string name() const;                  ///< "balls 407k/--ao --sh 3/64 rays"
  std::vector<std::string> options() const;  ///< arguments of `prelight bake`
};

/// Returns every technique at every number of rays that the options allow for a scene with `vertices`
/// vertices.
std::vector<ScalingCase> scalingCases(const std::string& scene, std::uint64_t vertices,
                                      const BakeOptions& options);

/// Return sums over the stages of a bake's report from "prepare", the first after the device was opened, to
/// "write": seconds, and processor time of all threads, s.
double bakeSeconds(const nlohmann::ordered_json& report);
double bakeProcessorSeconds(const nlohmann::ordered_json& report);

/// Returns the exponent of the power law through points of positive coordinates. At least two x differ.
double powerOf(std::vector<Point> points);

}  // namespace prelight::benchmarks
