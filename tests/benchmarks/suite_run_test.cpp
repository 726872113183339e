#include "benchmarks/run/suite.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "benchmarks/run/timing.h"

namespace prelight::benchmarks {
namespace {

BenchmarkResult resultOf(const std::string& name) { return {name, "metric", 1.0, "s", {}, {}}; }

class Stages final : public Progress {
 public:
  void report(std::string_view stage, double) override { names.emplace_back(stage); }
  std::vector<std::string> names;
};

TEST(SuiteRun, Report_HandsOnWhatIsNew_AndNothingTwice) {
  Stages stages;
  std::vector<std::vector<std::string>> kept;
  SuiteRun run(stages, [&](std::span<const BenchmarkResult> fresh) {
    kept.emplace_back();
    for (const BenchmarkResult& result : fresh) kept.back().push_back(result.case_);
  });
  run.report("bench", 0.0);
  run.results().push_back(resultOf("a"));
  run.results().push_back(resultOf("b"));
  run.report("bench", 0.5);
  run.report("bench", 0.6);
  run.results().push_back(resultOf("c"));
  run.finish();
  run.finish();
  EXPECT_EQ(kept, (std::vector<std::vector<std::string>>{{"a", "b"}, {"c"}}));
  ASSERT_EQ(stages.names.size(), 3u);
  EXPECT_EQ(stages.names[0], "bench");
  EXPECT_NE(stages.names[1].find("left"), std::string::npos);
}

TEST(SuiteRun, ClockText_HasHoursOnlyWhereThereAreAny) {
  EXPECT_EQ(clockText(4.6), "0:05");
  EXPECT_EQ(clockText(760.0), "12:40");
  EXPECT_EQ(clockText(3750.0), "1:02:30");
}

TEST(TimeShares, WhatOnePartTakesMore_IsTheLossOfAllThatFollow) {
  double now = 7.0;
  TimeShares shares(100.0, 4.0, [&] { return now; });
  EXPECT_DOUBLE_EQ(shares.next(), 25.0);
  now += 40.0;
  EXPECT_DOUBLE_EQ(shares.next(), 20.0);
  now += 5.0;
  EXPECT_DOUBLE_EQ(shares.next(2.0), 55.0);
  now += 80.0;
  EXPECT_TRUE(shares.isSpent());
  EXPECT_DOUBLE_EQ(shares.next(), 0.0);
}

TEST(Deadline, IsPast_WhenItsSecondsAreOver) {
  double now = 1.0;
  const Deadline end(2.0, [&] { return now; });
  EXPECT_DOUBLE_EQ(end.left(), 2.0);
  now = 2.9;
  EXPECT_FALSE(end.isPast());
  now = 3.1;
  EXPECT_TRUE(end.isPast());
  EXPECT_DOUBLE_EQ(end.left(), 0.0);
}

}  // namespace
}  // namespace prelight::benchmarks
