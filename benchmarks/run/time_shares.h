#pragma once

#include <functional>

namespace prelight::benchmarks {

/// Seconds of some moment.
using SecondsSource = std::function<double()>;
double steadySeconds();

/// The end of something that may take a time.
class Deadline {
 public:
  explicit Deadline(double seconds, SecondsSource clock = steadySeconds);

  bool isPast() const { return left() <= 0.0; }
  double left() const;  ///< s, >= 0

 private:
  SecondsSource clock_;
  double end_;
};

/// Seconds that are dealt out to parts of work as each begins: its share, by its weight, of what is left.
/// The time that one takes more or less than that is the loss or gain of all that follow.
class TimeShares {
 public:
  /// `weights`: of all parts together.
  TimeShares(double seconds, double weights, SecondsSource clock = steadySeconds);

  /// Seconds of the part that begins now; 0 when others have spent all.
  double next(double weight = 1.0);

  double left() const { return deadline_.left(); }
  bool isSpent() const { return deadline_.isPast(); }

 private:
  Deadline deadline_;
  double weights_;
};

}  // namespace prelight::benchmarks
