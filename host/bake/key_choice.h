#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <vector>

namespace prelight {

/// How the key moments of an animation are chosen: evenly, or with `error` such that interpolation stays
/// within it.
struct KeyRequest {
  int count = 9;  ///< 1 .. mostKeys, evenly spaced including both ends; ignored with `error`
  /// Greatest relative difference, > 0, that a moment between two keys may have from their interpolation.
  std::optional<double> error;
  /// With `error`: moments to try besides the middles, such as the key times of the motion.
  std::vector<double> moments = {};
  int mostKeys = 1024;  ///< greatest number of keys with `error`, at least 2
};

/// Functions that make and compare keys of any type.
template <typename Key>
struct KeyOperations {
  /// Makes the key at a moment.
  std::function<Key(double seconds)> bake;
  /// Returns the difference of `baked`, made at `seconds`, from the interpolation of the keys at `first` and
  /// `last`.
  std::function<double(double first, const Key& firstKey, double last, const Key& lastKey, double seconds,
                       const Key& baked)>
      difference;
};

/// The chosen keys and their greatest error.
template <typename Key>
struct ChosenKeys {
  std::vector<double> times;  ///< seconds, strictly ascending
  std::vector<Key> keys;      ///< [time]
  double error = 0.0;         ///< greatest difference at the moments tried between keys
};

/// Returns `count` moments from `start` to `end`, both included, or `start` alone if the two are equal.
inline std::vector<double> evenTimes(double start, double end, int count) {
  if (count < 2 || !(end > start)) return {start};
  std::vector<double> times;
  for (int i = 0; i < count; ++i) times.push_back(start + (end - start) * i / (count - 1));
  times.back() = end;
  return times;
}

/// Cuts an animation into intervals over which interpolation is good enough.
template <typename Key>
class KeyChooser {
 public:
  KeyChooser(double start, double end, const KeyRequest& request, const KeyOperations<Key>& operations)
      : request_(request), operations_(operations), longest_(0.25 * (end - start)) {
    assert(request.error && request.mostKeys >= 2);
    for (const double time : evenTimes(start, end, 2)) chosen_[time] = keyAt(time);
    if (chosen_.size() == 2) addInterval(start, end);
  }

  ChosenKeys<Key> run() {
    while (chosen_.size() < static_cast<std::size_t>(request_.mostKeys)) {
      const auto worst = std::max_element(intervals_.begin(), intervals_.end(),
                                          [](const auto& a, const auto& b) { return a.error < b.error; });
      if (worst == intervals_.end() || worst->error <= *request_.error) break;
      const Interval cut = *worst;
      intervals_.erase(worst);
      chosen_[cut.worst] = keyAt(cut.worst);
      addInterval(cut.first, cut.worst);
      addInterval(cut.worst, cut.last);
    }
    ChosenKeys<Key> result;
    for (const auto& [time, key] : chosen_) {
      result.times.push_back(time);
      result.keys.push_back(key);
    }
    for (const Interval& interval : intervals_) result.error = std::max(result.error, interval.error);
    return result;
  }

 private:
  struct Interval {
    double first;
    double last;
    double worst;  ///< moment of the greatest difference
    double error;
  };

  /// Returns the key at a moment, baking each moment once.
  const Key& keyAt(double time) {
    const auto known = baked_.find(time);
    return known != baked_.end() ? known->second : baked_.emplace(time, operations_.bake(time)).first->second;
  }

  void addInterval(double first, double last) {
    const double length = last - first;
    Interval interval{first, last, first + 0.5 * length, -1.0};
    if (!(interval.worst > first && interval.worst < last)) return;
    tryMoment(interval, interval.worst);
    // A motion there and back is at its start again in the middle, so that only the quarters tell it from
    // rest.
    if (interval.error <= *request_.error && length > longest_)
      for (const double part : {0.25, 0.75}) tryMoment(interval, first + part * length);
    for (const double moment : request_.moments) {
      if (interval.error > *request_.error) break;
      if (moment > first && moment < last) tryMoment(interval, moment);
    }
    intervals_.push_back(interval);
  }

  void tryMoment(Interval& interval, double time) {
    const Key& baked = keyAt(time);
    const double error = operations_.difference(interval.first, chosen_.at(interval.first), interval.last,
                                                chosen_.at(interval.last), time, baked);
    if (error <= interval.error) return;
    interval.error = error;
    interval.worst = time;
  }

  KeyRequest request_;
  const KeyOperations<Key>& operations_;
  double longest_;  ///< longest interval, seconds, for which one test in the middle suffices
  std::map<double, Key> baked_;
  std::map<double, Key> chosen_;
  std::vector<Interval> intervals_;
};

/// Chooses keys by error (request.error). Starting with the two ends, the interval with the greatest
/// difference is cut at the moment of that difference, until all intervals are within the error or there are
/// request.mostKeys keys. An interval is tried in its middle, intervals longer than a quarter of the
/// animation at their quarters too, and intervals that pass these tests at request.moments.
template <typename Key>
ChosenKeys<Key> chooseKeys(double start, double end, const KeyRequest& request,
                           const KeyOperations<Key>& operations) {
  return KeyChooser<Key>(start, end, request, operations).run();
}

}  // namespace prelight
