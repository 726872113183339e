#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "prelight/progress.h"

namespace prelight::benchmarks {

/// One of those that are compared: the same work, done its way, and how long that took.
struct Contender {
  std::string name;
  std::function<void(std::size_t part)> run;  ///< does one part of the work and waits for it
  int every = 1;                              ///< takes part in every n-th round
  std::vector<double> seconds = {};           ///< [round], negative where it took no part
  std::vector<double> cpuSeconds = {};        ///< processor time of this process in each round, s
};

/// Short rounds, in each of which every contender does the same part of the work (one after the other), so
/// that a disturbance meets all of them. Round r is about part r mod `parts`; who begins changes from round
/// to round.
/// Every contender does part 0 once before, unmeasured. Throws Interrupted.
void takeTurns(std::vector<Contender>& contenders, std::size_t parts, int rounds, const Progress& progress);

/// Median over the common rounds of the other's seconds over the own: > 1 where the own is faster.
double medianRatio(const std::vector<double>& own, const std::vector<double>& other);

/// Seconds of the whole work from those of the rounds: the sum over parts of the median, or of the least.
double medianSeconds(const std::vector<double>& rounds, std::size_t parts);
double leastSeconds(const std::vector<double>& rounds, std::size_t parts);

}  // namespace prelight::benchmarks
