#include "base/text.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace prelight {
namespace {

const std::vector<std::string> commands = {"bake", "render", "reference", "view",
                                           "info", "scene",  "bench",     "compare"};

TEST(SuggestName, WordWithOneSlip_FindsTheName) {
  EXPECT_EQ(suggestName("bkae", commands), "bake");     // Swapped.
  EXPECT_EQ(suggestName("rendr", commands), "render");  // Dropped.
  EXPECT_EQ(suggestName("infoo", commands), "info");    // Inserted.
  EXPECT_EQ(suggestName("vuew", commands), "view");     // Changed.
  EXPECT_EQ(suggestName("refrenec", commands), "reference");
}

TEST(SuggestName, WordFarFromEveryName_FindsNone) {
  EXPECT_EQ(suggestName("frobnicate", commands), std::nullopt);
  EXPECT_EQ(suggestName("x", commands), std::nullopt);
  EXPECT_EQ(suggestName("", commands), std::nullopt);
  EXPECT_EQ(suggestName("bake", std::vector<std::string>{}), std::nullopt);
}

TEST(SuggestName, LongWord_FindsNoneAtOnce) {
  EXPECT_EQ(suggestName(std::string(1'000'000, 'b'), commands), std::nullopt);
}

TEST(SuggestName, SeveralNamesNear_TakesTheNearest) {
  const std::vector<std::string> names = {"rooms-sealed", "rooms"};
  EXPECT_EQ(suggestName("room", names), "rooms");
  EXPECT_EQ(suggestName("rooms-saeled", names), "rooms-sealed");
}

TEST(DidYouMean, NameNearOrNone_IsAQuestionOrNothing) {
  EXPECT_EQ(didYouMean("rneder", commands), "did you mean render? ");
  EXPECT_EQ(didYouMean("paint", commands), "");
}

}  // namespace
}  // namespace prelight
