#include "base/text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace prelight {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(MatchesPattern, StarsAndQuestionMarks_MatchRunsAndSingles) {
  EXPECT_TRUE(matchesPattern("Lamp.001", "Lamp*"));
  EXPECT_TRUE(matchesPattern("Lamp", "Lamp*"));
  EXPECT_TRUE(matchesPattern("Lamp", "L?mp"));
  EXPECT_TRUE(matchesPattern("a:b", "a?b"));
  EXPECT_TRUE(matchesPattern("ceiling lamp left", "*lamp*left"));
  EXPECT_FALSE(matchesPattern("xLamp", "Lamp*"));
  EXPECT_FALSE(matchesPattern("Lamp", "Lamp?"));
}

TEST(MatchesPattern, WithoutStars_TakesTheWholeText) {
  EXPECT_TRUE(matchesPattern("Lamp", "Lamp"));
  EXPECT_FALSE(matchesPattern("Lamp", "Lam"));
  EXPECT_FALSE(matchesPattern("Lamp", "amp*"));
  EXPECT_FALSE(matchesPattern("Lamp", "lamp")) << "case counts";
}

TEST(MatchesPattern, EmptyTextsAndPatterns_MatchOnlyEachOtherAndStars) {
  EXPECT_TRUE(matchesPattern("", ""));
  EXPECT_TRUE(matchesPattern("", "**"));
  EXPECT_FALSE(matchesPattern("", "?"));
  EXPECT_FALSE(matchesPattern("Lamp", ""));
}

TEST(MatchesPattern, StarThatSwallowsTooLittle_IsTriedAgain) {
  EXPECT_TRUE(matchesPattern("abcabd", "*abd"));
  EXPECT_TRUE(matchesPattern("aXbXc", "a*X*c"));
  EXPECT_FALSE(matchesPattern("abcabc", "*abd"));
}

TEST(SplitPatterns, Commas_PartThemAndEmptyOnesAreNone) {
  EXPECT_THAT(splitPatterns(",a,,b*,"), ElementsAre("a", "b*"));
  EXPECT_THAT(splitPatterns(""), IsEmpty());
}

}  // namespace
}  // namespace prelight
