#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <regex>
#include <set>

#include "architecture/source_files.h"
#include "benchmarks/lab/lab_kernels.h"
#include "benchmarks/suites/stability/cases.h"
#include "benchmarks/suites/stability/stability_suite.h"
#include "benchmarks/suites/stability/trials.h"
#include "device/kernel_source.h"
#include "support/devices.h"

namespace prelight::benchmarks {
namespace {

std::map<std::string, std::string> allKernelSources() {
  std::map<std::string, std::string> sources = kernelSources();
  sources.insert(labKernelSources().begin(), labKernelSources().end());
  return sources;
}

std::set<std::string> kernelsOf(const std::map<std::string, std::string>& sources) {
  const std::regex entry(R"(__kernel[^;{]*?\bvoid\s+(\w+)\s*\()");
  std::set<std::string> kernels;
  for (const auto& [file, text] : sources)
    for (std::sregex_iterator match(text.begin(), text.end(), entry), end; match != end; ++match)
      kernels.insert(file + ":" + (*match)[1].str());
  return kernels;
}

/// Kernels of a technique whose file names the test that holds them to closed forms.
std::set<std::string> kernelsWithTests() {
  std::map<std::string, std::string> sources = allKernelSources();
  std::erase_if(sources, [](const auto& source) {
    std::smatch named;
    return !std::regex_search(source.second, named,
                              std::regex("// Tested by (tests/techniques/\\w+_test\\.cpp)")) ||
           !std::filesystem::exists(test::sourceRoot() / named[1].str());
  });
  return kernelsOf(sources);
}

TEST(StabilitySubjects, Kernels_AreAllThatThereAre) {
  std::set<std::string> listed;
  for (const stability::Subject& subject : stability::subjects())
    listed.insert(subject.kernels.begin(), subject.kernels.end());
  const std::set<std::string> there = kernelsOf(allKernelSources());
  EXPECT_GT(there.size(), 70u);
  listed.merge(kernelsWithTests());
  EXPECT_EQ(listed, there);
}

TEST(StabilitySubjects, EachOne_SaysWhatItsBoundRestsOn) {
  std::set<std::string> names;
  for (const stability::Subject& subject : stability::subjects()) {
    EXPECT_TRUE(names.insert(subject.name).second) << subject.name;
    EXPECT_EQ(subject.name.find('/'), std::string::npos) << subject.name << ": a slash parts a case's names";
    EXPECT_FALSE(subject.truth.empty() || subject.scale.empty() || subject.rests.empty()) << subject.name;
    EXPECT_NE(subject.run, nullptr) << subject.name;
  }
}

// The other subjects are run by the suite itself, which takes minutes.
TEST(StabilityWalks, WeightsOfWhiteBodies_StayWithinTheirBounds) {
  const Progress progress;
  const auto options = optionsIn<StabilityOptions>({});
  stability::Trials trials(test::sharedDevice(), options, progress);
  trials.begin("walks in bodies");
  stability::runWalks(trials);
  ASSERT_FALSE(trials.all().empty());
  for (const stability::Trial& trial : trials.all())
    EXPECT_TRUE(trial.holds()) << trial.stress << ": " << trial.differences.relative() << " of "
                               << trial.bound;
}

TEST(StabilityDifferences, ErrorsAreRelativeToTheScale_AndNoNumbersAreCounted) {
  stability::Differences differences;
  differences.add(1.5, 1.0, 4.0);
  differences.add(-3.0, -2.0);
  EXPECT_DOUBLE_EQ(differences.relative(), 0.5);
  EXPECT_DOUBLE_EQ(differences.absolute(), 1.0);
  differences.add(std::numeric_limits<double>::quiet_NaN(), 0.0, 1.0);
  differences.add(std::numeric_limits<double>::infinity(), 0.0, 1.0);
  EXPECT_EQ(differences.notFinite(), 2u);
  EXPECT_EQ(differences.values(), 4u);
}

TEST(StabilityDifferences, WhatADeviceMayFlush_IsARoundoff) {
  stability::Differences differences;
  differences.add(0.0, double(std::numeric_limits<float>::min()));
  EXPECT_LE(differences.relative(), stability::unitRoundoff);
}

TEST(StabilityBounds, ErrorsBeyondThemAndNoNumbers_AreNamed) {
  const std::vector<BenchmarkResult> results = {{"good", "relative error", 1e-7, "", "bound", 2.0},
                                                {"poor", "relative error", 1e-3, "", "bound", 0.5},
                                                {"none", "values not finite", 3.0, "", {}, {}},
                                                {"other", "absolute error", 1.0, "", {}, {}}};
  const std::vector<std::string> broken = brokenBounds(results);
  ASSERT_EQ(broken.size(), 2u);
  EXPECT_NE(broken[0].find("poor"), std::string::npos);
  EXPECT_NE(broken[1].find("none"), std::string::npos);
}

}  // namespace
}  // namespace prelight::benchmarks
