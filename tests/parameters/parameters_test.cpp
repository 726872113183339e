#include "prelight/parameters.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>

#include "gi/probes/probe_light.h"
#include "parameters/bad_numbers.h"
#include "prelight/error.h"

namespace prelight {
namespace {

template <typename Options>
class ParameterTable : public ::testing::Test {};

using Structures = ::testing::Types<BakeRequest, AnimationKeys, RenderOptions, ReferenceGoal, PhotonOptions,
                                    LoadOptions, ProbeRequest>;
TYPED_TEST_SUITE(ParameterTable, Structures);

TYPED_TEST(ParameterTable, Rows_AreSound) {
  std::set<std::string> fields, names;
  for (const Parameter<TypeParam>& row : parametersOf<TypeParam>()) {
    SCOPED_TRACE(row.field);
    EXPECT_TRUE(fields.insert(row.field).second) << "is there twice";
    EXPECT_TRUE(*row.option == '\0' || names.insert(row.option).second) << row.option;
    EXPECT_LT(row.range.least, row.range.most);
    EXPECT_TRUE(row.range.contains(row.range.least) && row.range.contains(row.range.most));
    EXPECT_FALSE(row.range.contains(std::numeric_limits<double>::quiet_NaN()));
    EXPECT_FALSE(row.range.zero != nullptr && row.range.contains(0.0)) << "0 cannot mean two things";
    EXPECT_NE(std::string(row.help), "");
    TypeParam options;
    EXPECT_TRUE(row.range.allows(row.get(options).value_or(row.range.least))) << "the default";
    for (const double value : {row.range.least, row.range.most}) {
      row.set(options, value);
      EXPECT_EQ(row.get(options), value);
    }
  }
}

TYPED_TEST(ParameterTable, NumbersOutOfTheirRanges_AreRefusedByName) {
  const auto bad = test::badNumbersOf(TypeParam());
  EXPECT_GE(bad.size(), 2 * parametersOf<TypeParam>().size() - 2);
  for (const auto& one : bad) {
    SCOPED_TRACE(std::string(one.row->field) + " " + std::to_string(one.value));
    try {
      requireRanges(one.options);
      ADD_FAILURE() << "taken";
    } catch (const UsageError& error) {
      EXPECT_EQ(error.where(), one.row->field);
      EXPECT_NE(error.problem().find("got "), std::string::npos);
      EXPECT_NE(error.problem().find("expected " + one.row->range.text()), std::string::npos) << error.what();
    }
  }
}

TYPED_TEST(ParameterTable, Defaults_AreTaken) { EXPECT_NO_THROW(requireRanges(TypeParam())); }

TEST(NumberRange, Texts_SayWhatIsTaken) {
  EXPECT_EQ((NumberRange{NumberKind::Whole, 1, 32, "none"}.textWithZero()),
            "a whole number from 1 to 32, or 0 (none)");
  EXPECT_EQ((NumberRange{NumberKind::Real, 1e-6, 1}.textWithZero()), "a number from 1e-06 to 1");
  EXPECT_EQ((NumberRange{NumberKind::PowerOfTwo, 1, 128}.text()), "a power of two from 1 to 128");
}

TEST(NumberRange, Kinds_AreTold) {
  const NumberRange whole{NumberKind::Whole, 1, 8}, power{NumberKind::PowerOfTwo, 1, 8};
  EXPECT_TRUE(whole.contains(3) && power.contains(4) && power.contains(1));
  EXPECT_FALSE(whole.contains(2.5) || whole.contains(0) || power.contains(3) || power.contains(0.5));
}

}  // namespace
}  // namespace prelight
