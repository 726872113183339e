#pragma once

#include <cstddef>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "base/clocks.h"
#include "prelight/progress.h"

namespace prelight::benchmarks {

/// One of several ways to do the same work, and the time that it took.
struct Contender {
  std::string name;
  std::function<void(std::size_t part)> run;  ///< does one part of the work and waits until it is done
  int every = 1;                              ///< takes part in every n-th round
  std::vector<double> seconds = {};           ///< [round], negative for rounds without it
  std::vector<double> cpuSeconds = {};        ///< processor time of this process in each round, s
};

/// Runs short rounds, in each of which every contender does the same part of the work, one after the other,
/// so that disturbances by other programs affect all of them. Round r does part r mod `parts`; the first
/// contender changes from round to round.
/// Before, every contender does part 0 once, unmeasured. Throws Interrupted.
void takeTurns(std::vector<Contender>& contenders, std::size_t parts, int rounds, const Progress& progress);

/// Returns the median, over the rounds in which both took part, of `other` / `own`: > 1 if `own` is faster.
double medianRatio(const std::vector<double>& own, const std::vector<double>& other);

/// Return seconds of the whole work: the sum over its parts of the median, or the least, of the rounds.
double medianSeconds(const std::vector<double>& rounds, std::size_t parts);
double leastSeconds(const std::vector<double>& rounds, std::size_t parts);

/// A clock: returns seconds since some moment.
using SecondsSource = std::function<double()>;

/// A moment by which work should end.
class Deadline {
 public:
  explicit Deadline(double seconds, SecondsSource clock = steadySeconds);

  bool isPast() const { return left() <= 0.0; }
  double left() const;  ///< s, >= 0

 private:
  SecondsSource clock_;
  double end_;
};

/// Divides seconds among parts of work. Each part gets, when it begins, its share by weight of the seconds
/// that are left; so time that a part saves or overspends is shared by all later parts.
class TimeShares {
 public:
  /// `weights`: sum of the weights of all parts.
  TimeShares(double seconds, double weights, SecondsSource clock = steadySeconds);

  /// Returns the seconds of the part that begins now; 0 if none are left.
  double next(double weight = 1.0);

  double left() const { return deadline_.left(); }
  bool isSpent() const { return deadline_.isPast(); }

 private:
  Deadline deadline_;
  double weights_;
};

/// Returns the processor time of all threads of this process so far, s.
inline double processorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace prelight::benchmarks
