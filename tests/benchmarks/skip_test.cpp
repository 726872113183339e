#include <gtest/gtest.h>

#include <cctype>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "benchmarks/suites/skip/carry_out.h"
#include "benchmarks/suites/skip/rows.h"
#include "benchmarks/suites/skip/skip_suite.h"
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

skip::Effort quickEffort() { return optionsIn<SkipOptions>(RunOptions::quickRun()); }

/// What the row of that name comes to. Each is carried out once per process: every test below compares with
/// the absent one.
const Outcome& outcomeOf(const skip::Row& row, Presence presence) {
  static std::map<std::pair<std::string, Presence>, Outcome> outcomes;
  const auto known = outcomes.find({row.name, presence});
  if (known != outcomes.end()) return known->second;
  Progress ignored;
  const skip::Setting setting = row.make(presence, quickEffort());
  return outcomes[{row.name, presence}] = carryOut(setting, test::sharedDevice(), ignored);
}

class SkippedWork : public testing::TestWithParam<skip::Row> {};

TEST_P(SkippedWork, FeaturePresentInVain_ChangesNoBitAndTakesNoRayAndNoLaunch) {
  const Outcome& absent = outcomeOf(GetParam(), Presence::Absent);
  const Outcome& unneeded = outcomeOf(GetParam(), Presence::Unneeded);
  EXPECT_FALSE(absent.values.empty());
  EXPECT_TRUE(sameValues(absent, unneeded));
  EXPECT_EQ(unneeded.rays, absent.rays);
  EXPECT_EQ(unneeded.launches, absent.launches);
  EXPECT_EQ(unneeded.workItems, absent.workItems);
}

/// Texels, and the texture coordinates of every vertex with them: all that is uploaded is the material.
TEST(SkippedUploads, TextureThatNoTriangleHas_StaysOnTheHost) {
  constexpr std::uint64_t materialBytes = 1024;  // at most, in all arrays together
  for (const skip::Row& row : skip::rows()) {
    if (row.name != "base-colour texture" && row.name != "images" && row.name != "texture, path tracing" &&
        row.name != "normal map of a light map")
      continue;
    EXPECT_LE(outcomeOf(row, Presence::Unneeded).deviceBytes,
              outcomeOf(row, Presence::Absent).deviceBytes + materialBytes)
        << row.name;
  }
}

TEST_P(SkippedWork, FeatureThatIsNeeded_ChangesValues) {
  EXPECT_FALSE(sameValues(outcomeOf(GetParam(), Presence::Absent), outcomeOf(GetParam(), Presence::Needed)));
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
