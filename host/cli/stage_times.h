#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace prelight::cli {

/// Seconds by stage, in the order they ran.
class StageTimes {
 public:
  /// Runs `work` and files the time it took under `stage`.
  template <typename Work>
  decltype(auto) measure(const std::string& stage, Work&& work) {
    const Entry entry(*this, stage);
    return std::forward<Work>(work)();
  }

  void add(const std::string& stage, double seconds) { stages_.emplace_back(stage, seconds); }

  const std::vector<std::pair<std::string, double>>& stages() const { return stages_; }

  double total() const { return secondsSince(start_); }

 private:
  using Clock = std::chrono::steady_clock;

  static double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

  class Entry {
   public:
    Entry(StageTimes& times, std::string stage) : times_(times), stage_(std::move(stage)) {}
    ~Entry() { times_.add(stage_, secondsSince(start_)); }
    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;

   private:
    StageTimes& times_;
    std::string stage_;
    Clock::time_point start_ = Clock::now();
  };

  Clock::time_point start_ = Clock::now();
  std::vector<std::pair<std::string, double>> stages_;
};

}  // namespace prelight::cli
