#include <gtest/gtest.h>

#include <cctype>
#include <set>

#include "benchmarks/skip/measured_row.h"
#include "benchmarks/skip/rows.h"
#include "benchmarks/suite.h"
#include "support/devices.h"

namespace prelight::benchmarks {
namespace {

using skip::Outcome;
using skip::Presence;

TEST(SkipRows, EachName_IsOfOneRowThatSaysHowItsFeatureIsPresent) {
  std::set<std::string> names;
  for (const skip::Row& row : skip::rows()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_EQ(row.name.find('/'), std::string::npos) << row.name << ": a slash parts a case's names";
    EXPECT_FALSE(row.unneeded.empty() || row.needed.empty()) << row.name;
  }
  EXPECT_GT(names.size(), 30u);
}

class SkippedWork : public testing::TestWithParam<skip::Row> {};

TEST_P(SkippedWork, FeaturePresentInVain_ChangesNoBitAndTakesNoRayAndNoLaunch) {
  Progress ignored;
  const skip::MeasuredRow row =
      skip::measureRow(GetParam(), BenchmarkOptions::quick().skipEffort, 0, test::sharedDevice(), ignored);
  const Outcome& absent = row.of(Presence::Absent);
  const Outcome& unneeded = row.of(Presence::Unneeded);
  EXPECT_FALSE(absent.values.empty());
  EXPECT_TRUE(row.unchanged());
  EXPECT_EQ(unneeded.rays, absent.rays);
  EXPECT_EQ(unneeded.launches, absent.launches);
  EXPECT_EQ(unneeded.workItems, absent.workItems);
}

/// Texels, and the texture coordinates of every vertex with them: all that is uploaded is the material.
TEST(SkippedUploads, TextureThatNoTriangleHas_StaysOnTheHost) {
  Progress ignored;
  const skip::Effort effort = BenchmarkOptions::quick().skipEffort;
  constexpr std::uint64_t materialBytes = 1024;  // at most, in all arrays together
  for (const skip::Row& row : skip::rows()) {
    if (row.name != "base-colour texture" && row.name != "images" && row.name != "texture, path tracing" &&
        row.name != "normal map of a light map")
      continue;
    const Outcome absent = carryOut(row.make(Presence::Absent, effort), test::sharedDevice(), ignored);
    const Outcome unneeded = carryOut(row.make(Presence::Unneeded, effort), test::sharedDevice(), ignored);
    EXPECT_LE(unneeded.deviceBytes, absent.deviceBytes + materialBytes) << row.name;
  }
}

TEST_P(SkippedWork, FeatureThatIsNeeded_ChangesValues) {
  Progress ignored;
  const skip::Effort effort = BenchmarkOptions::quick().skipEffort;
  const Outcome absent = carryOut(GetParam().make(Presence::Absent, effort), test::sharedDevice(), ignored);
  const Outcome needed = carryOut(GetParam().make(Presence::Needed, effort), test::sharedDevice(), ignored);
  EXPECT_FALSE(sameValues(absent, needed));
}

std::string nameOfTest(const testing::TestParamInfo<skip::Row>& info) {
  std::string name;
  for (const char c : info.param.name)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) name += c;
  return name;
}

INSTANTIATE_TEST_SUITE_P(Rows, SkippedWork, testing::ValuesIn(skip::rows()), nameOfTest);

}  // namespace
}  // namespace prelight::benchmarks
