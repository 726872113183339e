#include "benchmarks/run/timing.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <utility>

#include "benchmarks/run/measure.h"

namespace prelight::benchmarks {

namespace {

template <typename Summary>
double sumOverParts(const std::vector<double>& rounds, std::size_t parts, const Summary& summary) {
  double sum = 0.0;
  for (std::size_t part = 0; part < parts; ++part) {
    std::vector<double> seconds;
    for (std::size_t round = part; round < rounds.size(); round += parts)
      if (rounds[round] >= 0.0) seconds.push_back(rounds[round]);
    sum += summary(seconds);
  }
  return sum;
}

}  // namespace

void takeTurns(std::vector<Contender>& contenders, std::size_t parts, int rounds, const Progress& progress) {
  for (Contender& contender : contenders) {
    contender.run(0);
    contender.seconds.assign(static_cast<std::size_t>(rounds), -1.0);
    contender.cpuSeconds = contender.seconds;
  }
  for (std::size_t round = 0; round < static_cast<std::size_t>(rounds); ++round) {
    progress.check();
    for (std::size_t turn = 0; turn < contenders.size(); ++turn) {
      Contender& contender = contenders[(round + turn) % contenders.size()];
      if (round % static_cast<std::size_t>(contender.every) != 0) continue;
      const std::clock_t before = std::clock();
      contender.seconds[round] = secondsOf([&] { contender.run(round % parts); });
      contender.cpuSeconds[round] = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
    }
  }
}

double medianRatio(const std::vector<double>& own, const std::vector<double>& other) {
  std::vector<double> ratios;
  for (std::size_t round = 0; round < own.size(); ++round)
    if (own[round] > 0.0 && other[round] >= 0.0) ratios.push_back(other[round] / own[round]);
  return ratios.empty() ? 1.0 : median(std::move(ratios));
}

double medianSeconds(const std::vector<double>& rounds, std::size_t parts) {
  return sumOverParts(rounds, parts, [](const std::vector<double>& seconds) { return median(seconds); });
}

double leastSeconds(const std::vector<double>& rounds, std::size_t parts) {
  return sumOverParts(rounds, parts, [](const std::vector<double>& seconds) {
    return *std::min_element(seconds.begin(), seconds.end());
  });
}

Deadline::Deadline(double seconds, SecondsSource clock)
    : clock_(std::move(clock)), end_(clock_() + seconds) {}

double Deadline::left() const { return std::max(0.0, end_ - clock_()); }

TimeShares::TimeShares(double seconds, double weights, SecondsSource clock)
    : deadline_(seconds, std::move(clock)), weights_(weights) {}

double TimeShares::next(double weight) {
  const double share = weights_ > 0.0 ? left() * std::min(1.0, weight / weights_) : left();
  weights_ = std::max(0.0, weights_ - weight);
  return share;
}

}  // namespace prelight::benchmarks
