#pragma once

#include <chrono>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

namespace prelight::cli {

/// Seconds per stage, in the order in which the stages ran.
class StageTimes {
 public:
  /// Runs `work` and adds its time to `stage`.
  template <typename Work>
  decltype(auto) measure(const std::string& stage, Work&& work) {
    const Entry entry(*this, stage);
    return std::forward<Work>(work)();
  }

  void add(const std::string& stage, double seconds) { stages_.emplace_back(stage, seconds); }

  const std::vector<std::pair<std::string, double>>& stages() const { return stages_; }

  /// Measures the processor time of `work`, in all threads, under a name of its own.
  template <typename Work>
  decltype(auto) measureProcessor(const std::string& name, Work&& work) {
    const ProcessorEntry entry(*this, name);
    return std::forward<Work>(work)();
  }

  const std::vector<std::pair<std::string, double>>& processor() const { return processor_; }

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

  class ProcessorEntry {
   public:
    ProcessorEntry(StageTimes& times, std::string name) : times_(times), name_(std::move(name)) {}
    ~ProcessorEntry() {
      times_.processor_.emplace_back(name_, static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC);
    }
    ProcessorEntry(const ProcessorEntry&) = delete;
    ProcessorEntry& operator=(const ProcessorEntry&) = delete;

   private:
    StageTimes& times_;
    std::string name_;
    std::clock_t start_ = std::clock();
  };

  Clock::time_point start_ = Clock::now();
  std::vector<std::pair<std::string, double>> stages_, processor_;
};

}  // namespace prelight::cli
