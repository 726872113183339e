#include "prelight/options.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gi/probes/probe_light.h"
#include "integrators/global_illumination_renderer.h"
#include "integrators/live_virtual_lights.h"
#include "integrators/reference.h"
#include "options/bad_numbers.h"
#include "options/shared_bake_options.h"
#include "options/sound_rows.h"
#include "prelight/error.h"
#include "techniques/registry/registry.h"

namespace prelight {
namespace {

template <typename Options>
class OptionTable : public ::testing::Test {};

using Structures = ::testing::Types<BakeRequest, AnimationKeys, RenderOptions, ReferenceGoal, PhotonOptions,
                                    LoadOptions, ProbeRequest, GlobalIlluminationPictureRequest,
                                    InstantOptions, reference::ReferenceRequest>;
TYPED_TEST_SUITE(OptionTable, Structures);

TYPED_TEST(OptionTable, Rows_AreSound) {
  std::set<std::string> fields, names;
  for (const Option<TypeParam>& row : optionsOf<TypeParam>()) test::expectSound(row, fields, names);
}

TYPED_TEST(OptionTable, NumbersOutOfTheirRanges_AreRefusedByName) {
  const auto bad = test::badNumbersOf(TypeParam());
  const auto rows = optionsOf<TypeParam>();
  const auto numbers = std::ranges::count(rows, OptionKind::Number, &Option<TypeParam>::kind);
  EXPECT_GE(std::ssize(bad), 2 * numbers - 2);
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

TYPED_TEST(OptionTable, Defaults_AreTaken) { EXPECT_NO_THROW(requireRanges(TypeParam())); }

TEST(BakeOptions, FlagThatIncludesAnother_SetsIt) {
  const std::pair<const char*, const char*> included[] = {
      {"cones", "ao"}, {"glossy-bounces", "specular-transport"}, {"caustics", "lightmap"}};
  const auto rows = optionsOf<BakeRequest>();
  for (const auto& [name, other] : included) {
    const auto row = std::ranges::find(rows, std::string_view(name), &Option<BakeRequest>::name);
    const auto set = std::ranges::find(rows, std::string_view(other), &Option<BakeRequest>::name);
    BakeRequest request;
    row->set(request, 0.0);
    EXPECT_EQ(set->get(request), 0.0) << name;
    row->set(request, 1.0);
    EXPECT_EQ(set->get(request), 1.0) << name;
  }
}

TEST(BakeOptions, OfTechniques_StandBehindOnesThatAreThere) {
  std::set<std::string_view> before;
  for (const Technique& technique : techniques()) {
    const auto& [rows, behind] = technique.options;
    EXPECT_TRUE(behind.empty() || before.contains(behind)) << technique.name << " behind " << behind;
    for (const Option<BakeRequest>& row : rows) before.insert(row.name);
  }
  EXPECT_EQ(before.size(), techniqueOptions().size());
}

/// Returns another value than the usual one.
double otherValue(const Option<BakeRequest>& row) {
  const std::vector<double> ends = test::endsOf(row);
  return row.usualValue() == ends.front() ? ends.back() : ends.front();
}

TEST(BakeRequest, WithoutTechniques_KeepsWhatTheyShare) {
  const std::span<const Option<BakeRequest>> shared[] = {lightOptions(), castOptions()};
  BakeRequest request;
  for (const Option<BakeRequest>& row : optionsOf<BakeRequest>())
    if (row.kind != OptionKind::Own) row.set(request, otherValue(row));
  request.shadowSets = {{{"floor"}, {"ball"}}};
  const BakeRequest kept = request.withoutTechniques();
  for (const Option<BakeRequest>& row : techniqueOptions()) EXPECT_FALSE(row.isSet(kept)) << row.name;
  for (const auto rows : shared)
    for (const Option<BakeRequest>& row : rows) {
      if (row.kind == OptionKind::Own) continue;
      EXPECT_EQ(row.get(kept), row.get(request)) << row.name;
    }
  EXPECT_EQ(kept.shadowSets.size(), 1u);
}

TEST(OptionInfo, Shadings_AreToldApart) {
  OptionInfo info{.field = "", .name = ""};
  EXPECT_TRUE(info.shadingNames().empty());
  info.shadings = "ao screen";
  EXPECT_EQ(info.shadingNames(), (std::vector<std::string_view>{"ao", "screen"}));
  EXPECT_TRUE(info.appliesTo("ao") && info.appliesTo("screen"));
  EXPECT_FALSE(info.appliesTo("a") || info.appliesTo("ao screen") || info.appliesTo(""));
}

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
