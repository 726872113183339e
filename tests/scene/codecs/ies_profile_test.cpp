#include "scene/codecs/ies_profile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "prelight/scene.h"
#include "scene/light_profile.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using testing::HasSubstr;

constexpr double degree = std::numbers::pi / 180.0;

/// Text of an IES file. `counts` holds the numbers of vertical and horizontal angles and the photometric
/// type, `rest` the angles and intensities.
std::string iesText(const std::string& counts, const std::string& rest,
                    const std::string& head = "IESNA:LM-63-2002", const std::string& factors = "1 7 60") {
  return head + "\r\n[TEST] a lamp\n[MANUFAC] none\nTILT=NONE\n1 -1 2.0 " + counts + " 2 0 0 0\n" + factors +
         "\n" + rest + "\n";
}

/// Intensity in W/sr in a direction of the lamp's own frame.
double towards(const std::string& text, const glm::dvec3& direction) {
  Light light;
  light.profile = std::make_shared<const LightProfile>(parseIesProfile(text, "a.ies"));
  return profileTowards(light, glm::normalize(direction));
}

glm::dvec3 directionC(double height, double turn) {
  const double h = height * degree, t = turn * degree;
  return {std::sin(h) * std::cos(t), std::sin(h) * std::sin(t), -std::cos(h)};
}

std::string refusal(const std::string& text) {
  return test::inputErrorOf([&] { (void)parseIesProfile(text, "a.ies"); });
}

TEST(IesProfile, OneHorizontalAngle_IsTheSameAllAround) {
  const std::string text = iesText("3 1 1", "0 45 90\n0\n100 60 10");
  for (const double turn : {0.0, 77.0, 180.0, 359.0}) {
    EXPECT_NEAR(towards(text, directionC(0.0, turn)), 200.0, 1e-9);
    EXPECT_NEAR(towards(text, directionC(22.5, turn)), 160.0, 1e-9);
    EXPECT_NEAR(towards(text, directionC(89.99, turn)), 20.0, 0.05);
    EXPECT_EQ(towards(text, directionC(91.0, turn)), 0.0);
  }
}

TEST(IesProfile, HalvesAndQuarters_AreMirrored) {
  const std::string quarter = iesText("2 2 1", "0 90\n0 90\n10 10\n20 40");
  const std::string half = iesText("2 3 1", "0 90\n0 90 180\n10 10\n20 40\n10 30");
  const std::string across = iesText("2 3 1", "0 90\n90 180 270\n10 10\n20 40\n10 30");
  const std::string all = iesText("2 4 1", "0 90\n0 90 180 270\n10 10\n20 40\n10 30\n10 70");
  const auto at = [](const std::string& text, double turn) {
    return towards(text, directionC(89.9999, turn));
  };
  for (const double turn : {30.0, 150.0, 210.0, 330.0}) EXPECT_NEAR(at(quarter, turn), 40.0, 0.01) << turn;
  EXPECT_NEAR(at(half, 135.0), 70.0, 0.01);
  EXPECT_NEAR(at(half, 225.0), 70.0, 0.01);
  EXPECT_NEAR(at(across, 180.0), 80.0, 0.01);
  EXPECT_NEAR(at(across, 45.0), 50.0, 0.01);
  EXPECT_NEAR(at(across, 135.0), 50.0, 0.01);
  EXPECT_NEAR(at(all, 315.0), 80.0, 0.01);  // The horizontal angles close the circle.
}

// Seen from the upright axis, +X, H turns clockwise; V rises towards that axis.
TEST(IesProfile, TypesAAndB_AreGlobesWithUprightAndLevelAxis) {
  const std::string rest = "-90 0 45 90\n-90 0 45 90\n1 1 1 1\n1 1 2 3\n1 4 5 6\n1 7 8 9";
  const double root = std::sqrt(0.5);
  EXPECT_NEAR(towards(iesText("4 4 3", rest), {0, 0, -1}), 2.0, 1e-9);
  EXPECT_NEAR(towards(iesText("4 4 2", rest), {0, 0, -1}), 2.0, 1e-9);
  EXPECT_NEAR(towards(iesText("4 4 3", rest), {root, 0, -root}), 4.0, 1e-9);  // V 45.
  EXPECT_NEAR(towards(iesText("4 4 2", rest), {root, 0, -root}), 4.0, 1e-9);
  EXPECT_NEAR(towards(iesText("4 4 3", rest), {0, -root, -root}), 8.0, 1e-9);  // H 45.
  EXPECT_NEAR(towards(iesText("4 4 2", rest), {0, -root, -root}), 8.0, 1e-9);
  // Both are 45: H is a longitude in type A, and a latitude in type B.
  EXPECT_NEAR(towards(iesText("4 4 3", rest), {root, -0.5, -0.5}), 10.0, 1e-9);
  EXPECT_NEAR(towards(iesText("4 4 2", rest), {0.5, -root, -0.5}), 10.0, 1e-9);
  EXPECT_EQ(towards(iesText("4 4 2", rest), {0, 0, 1}), 0.0);
}

TEST(IesProfile, Factors_CountByTheVersion) {
  const std::string rest = "0 90\n0\n3 3";
  EXPECT_NEAR(towards(iesText("2 1 1", rest, "IES:LM-63-2019", "0.5 7 60"), {0, 0, -1}), 3.0, 1e-9);
  EXPECT_NEAR(towards(iesText("2 1 1", rest, "IESNA91", "0.5 7 60"), {0, 0, -1}), 21.0, 1e-9);
}

TEST(IesProfile, Version_IsFoundAfterAByteOrderMarkAndInOtherSpellings) {
  const std::string rest = "0 90\n0\n3 3";
  for (const char* late : {"\xEF\xBB\xBFIES:LM-63-2019", "\xEF\xBB\xBFIESNA:LM-63-2002", "ANSI/IES LM-63-19",
                           "IESNA: LM-63-1995", "IES:LM-63-2025"})
    EXPECT_NEAR(towards(iesText("2 1 1", rest, late, "1 7 60"), {0, 0, -1}), 6.0, 1e-9) << late;
  for (const char* early : {"IESNA:LM-63-1991", "IESNA86", "LM-63-", "\xEF\xBB\xBFIESNA91", "a lamp"})
    EXPECT_NEAR(towards(iesText("2 1 1", rest, early, "1 7 60"), {0, 0, -1}), 42.0, 1e-9) << early;
}

TEST(IesProfile, AnyLineEnds_AreRead) {
  for (const char* end : {"\n", "\r", "\r\n"}) {
    const auto lines = [&](const std::vector<std::string>& all) {
      std::string text;
      for (const std::string& line : all) text += line + end;
      return text;
    };
    EXPECT_NEAR(towards(lines({"IESNA91", "[TEST] a", "TILT=NONE", "1 1 1 2 1 1 1 0 0 0", "1 1 0", "0 180",
                               "0", "5 5"}),
                        {0, 1, 0}),
                5.0, 1e-9);
    EXPECT_THAT(refusal(lines({"IESNA91", "TILT=NONE", "", "1 2", "three"})), HasSubstr("line 5: expected"));
    EXPECT_THAT(refusal(lines({"IESNA91", "TILT=NONE", "1 2 -3"})), HasSubstr("line 3: the candela"));
  }
}

TEST(IesProfile, AnglesThatFloatsCannotTellApart_AreRefused) {
  EXPECT_THAT(refusal(iesText("3 1 1", "0 30 30.0000001\n0\n1 1 1")),
              HasSubstr("30.0000001 comes after 30, expected ascending ones, 0.0001 degrees apart"));
  const LightProfile profile =
      parseIesProfile(iesText("2 3 1", "0 90\n0 200 359.99999\n1 1\n2 2\n3 3"), "a.ies");
  EXPECT_EQ(profile.turns.size(), 3u);  // The circle is closed without a sliver.
  EXPECT_DOUBLE_EQ(profile.turns.back(), 2.0 * std::numbers::pi);
}

TEST(IesProfile, PowerOfCells_IsNeverNegative) {
  LightProfile profile;
  profile.turns = {0.0, 1.0};
  profile.values = {0.0, 0.0, 0.0, 0.0};
  for (int i = 0; i < 10000; ++i) {
    const double from = 3.14 * i / 10000;
    profile.heights = {from, from + 1e-9};
    profile.values = {0.0, 1.0, 0.0, 1.0};
    ASSERT_GE(cellPower(profile, 0, 0), 0.0) << from;
  }
}

TEST(IesProfile, TiltedLamps_AreReadPastTheirTilts) {
  const std::string text =
      "IESNA91\nTILT=INCLUDE\n1\n3\n0 45 90\n1 0.9 0.8\n1 1000 1 2 1 1 1 0,0,0\n1 1 0\n0 180\n0\n5e0 +5.0\n";
  EXPECT_NEAR(towards(text, {0, 1, 0}), 5.0, 1e-9);
}

TEST(IesProfile, Power_IsTheIntegralOfTheIntensity) {
  std::string angles, values;
  for (int v = 0; v <= 90; ++v) {
    angles += std::to_string(v) + " ";
    values += std::to_string(0.5 * std::cos(v * degree)) + "\n";
  }
  const LightProfile profile = parseIesProfile(iesText("91 1 1", angles + "\n0\n" + values), "a.ies");
  EXPECT_NEAR(profilePower(profile), std::numbers::pi, 1e-4);  // Power of a cosine lobe.
  EXPECT_NEAR(profilePower(parseIesProfile(iesText("2 1 1", "0 180\n0\n1.5 1.5"), "a.ies")),
              12.0 * std::numbers::pi, 1e-9);
}

TEST(IesProfile, BrokenFiles_AreRefusedWithTheirLine) {
  EXPECT_THAT(refusal(""), HasSubstr("no photometric profile"));
  EXPECT_THAT(refusal("hello\nworld\n"), HasSubstr("no photometric profile"));
  EXPECT_THAT(refusal("IESNA91\nTILT=NONE\n1 2 three"),
              HasSubstr("a.ies: line 3: expected the candela multiplier, got \"three\""));
  EXPECT_THAT(refusal(iesText("3 1 1", "0 45 90\n0\n100 60")),
              HasSubstr("the file ends, expected an intensity"));
  EXPECT_THAT(refusal(iesText("3 1 1", "0 90 45\n0\n100 60 1")), HasSubstr("45 comes after 90"));
  EXPECT_THAT(refusal(iesText("3 1 1", "0 90 190\n0\n100 60 1")), HasSubstr("expected 0 to 180"));
  EXPECT_THAT(refusal(iesText("2 2 1", "0 90\n0 80\n1 1 1 1")), HasSubstr("from 0 to 80"));
  EXPECT_THAT(refusal(iesText("2 1 4", "0 90\n0\n1 1")), HasSubstr("photometric type is 4"));
  EXPECT_THAT(refusal(iesText("2 1 1", "0 90\n0\n1 inf")), HasSubstr("not a finite number"));
  EXPECT_THAT(refusal(iesText("2 1 1", "0 90\n0\n1 1e20")), HasSubstr("expected at most 1e+15"));
  EXPECT_THAT(refusal(iesText("1 1 1", "0\n0\n1")), HasSubstr("number of vertical angles is 1"));
}

TEST(IesProfile, MoreAnglesThanTheFileHolds_AreRefusedBeforeMemoryIsTaken) {
  EXPECT_THAT(refusal(iesText("1000000000 1 1", "0")), HasSubstr("has room for"));
  EXPECT_THAT(refusal(iesText("1e300 1 1", "0")), HasSubstr("has room for"));
  EXPECT_THAT(refusal(iesText("2 -1 1", "0")), HasSubstr("has room for"));
  const std::string zeros(200000, '\n');
  EXPECT_THAT(refusal(iesText("60000 60000 1", zeros)), HasSubstr("expected 1048576 at most"));
  EXPECT_THAT(refusal(iesText("1000 1000 1", zeros)), HasSubstr("more than the file has room for"));
}

/// Deterministic damage gives a usable profile or an InputError.
TEST(IesProfile, DamagedFiles_AreReadOrRefused) {
  std::mt19937 random(11);
  const std::vector<std::string> files = {
      iesText("4 4 2", "-90 0 45 90\n-90 0 45 90\n1 1 1 1\n1 1 2 3\n1 4 5 6\n1 7 8 9"),
      iesText("2 3 1", "0 90\n0 90 180\n10 10\n20 40\n10 30"),
      "IESNA91\nTILT=INCLUDE\n1\n3\n0 45 90\n1 0.9 0.8\n1 1000 1 2 1 1 1 0,0,0\n1 1 0\n0 180\n0\n5e0 +5.0\n"};
  const std::string letters = "0123456789.-+eE \n,infaTIL=\t";
  int read = 0, refused = 0;
  for (int round = 0; round < 20000; ++round) {
    std::string text = files[static_cast<std::size_t>(round) % files.size()];
    for (unsigned change = 0; change < 1 + random() % 4; ++change) {
      const std::size_t at = random() % text.size();
      if (random() % 4 == 0)
        text.erase(at, 1 + random() % 9);
      else if (random() % 3 == 0)
        text.insert(at, 1, letters[random() % letters.size()]);
      else
        text[at] = random() % 8 == 0 ? static_cast<char>(random()) : letters[random() % letters.size()];
      if (text.empty()) text = "x";
    }
    try {
      const LightProfile profile = parseIesProfile(text, "a.ies");
      ++read;
      ASSERT_EQ(profile.values.size(), profile.heights.size() * profile.turns.size());
      ASSERT_TRUE(std::is_sorted(profile.heights.begin(), profile.heights.end()));
      ASSERT_LE(profile.turns.back() - profile.turns.front(), 2.0 * std::numbers::pi + 1e-12);
      ASSERT_GE(profilePower(profile), 0.0);
      const double value = towards(text, directionC(double(random() % 181), double(random() % 360)));
      ASSERT_TRUE(std::isfinite(value) && value >= 0.0);
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(read, 1000);
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace prelight
