#include <gmock/gmock.h>

#include <set>

#include "benchmarks/catalogue.h"
#include "benchmarks/suites/live/live_suite.h"
#include "benchmarks/suites/pictures/pictures_suite.h"
#include "benchmarks/suites/relighting/relighting_suite.h"
#include "benchmarks/suites/skip/skip_suite.h"
#include "benchmarks/suites/tracing/tracing_suite.h"
#include "prelight/error.h"

namespace prelight::benchmarks {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(SuiteOptions, OfARun_AreThoseOfTheirTable) {
  const auto usual = optionsIn<TracingOptions>({});
  EXPECT_EQ(usual.castRays, 1u << 20);
  EXPECT_THAT(usual.rayTriangles, ElementsAre(250000, 2000000));
  const auto quick = optionsIn<TracingOptions>(RunOptions::quickRun());
  EXPECT_EQ(quick.castRays, 1u << 14);
  EXPECT_EQ(quick.runs, 1);
  EXPECT_EQ(TracingOptions::table().toJson(quick)["rayTriangles"], nlohmann::ordered_json({2000}));
}

TEST(SuiteOptions, MembersOfABase_AreRowsLikeOthers) {
  EXPECT_EQ(optionsIn<SkipOptions>({}).side, 192);
  EXPECT_EQ(optionsIn<SkipOptions>(RunOptions::quickRun()).texelSize, 0.5);
}

TEST(SuiteOptions, GivenValues_TakeTheirPlace) {
  RunOptions run = RunOptions::quickRun();
  run.given = {.rays = 77, .samples = 5, .photons = {}, .size = {{40, 20}}, .models = {"truck.glb"}};
  const auto options = optionsIn<PicturesOptions>(run);
  EXPECT_EQ(options.objectRays, 77u);
  EXPECT_THAT(options.materialRays, ElementsAre(77));
  EXPECT_EQ(options.materialTruthSamples, 5u);
  EXPECT_EQ(options.materialWidth, 40);
  EXPECT_EQ(options.objectHeight, 20);
  EXPECT_THAT(options.objectModels, ElementsAre("ring", "truck.glb"));
}

template <typename Options>
Options optionsWith(const std::vector<SetOption>& given) {
  RunOptions run = RunOptions::quickRun();
  run.given.options = given;
  return optionsIn<Options>(run);
}

TEST(SuiteOptions, SetOnTheCommandLine_ReplaceTheTables) {
  const auto tracing = optionsWith<TracingOptions>({{"rayRounds", "7"}, {"scalingTriangles", "1000,30000"}});
  EXPECT_EQ(tracing.rayRounds, 7);
  EXPECT_THAT(tracing.scalingTriangles, ElementsAre(1000, 30000));
  EXPECT_EQ(tracing.castRays, 1u << 14);
  const auto live = optionsWith<LiveOptions>({{"updateScenes", "rooms:Right crate,cornell:Short box"}});
  EXPECT_THAT(live.updateScenes, ElementsAre(std::pair<std::string, std::string>("rooms", "Right crate"),
                                             std::pair<std::string, std::string>("cornell", "Short box")));
  EXPECT_EQ(optionsWith<SkipOptions>({{"patchSize", "0"}, {"texelSize", "0.25"}}).texelSize, 0.25);
  EXPECT_EQ(optionsWith<SkipOptions>({{"side", "9"}, {"side", "10"}}).side, 10);
}

TEST(SuiteOptions, SetToOtherValues_AreRefusedWithThoseThatTheyTake) {
  const auto refusal = [](const std::string& name, const std::string& value) {
    try {
      optionsWith<TracingOptions>({{name, value}});
      optionsWith<RelightingOptions>({{name, value}});
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal("rayRounds", "0"), HasSubstr("got '0', expected a whole number from 1"));
  for (const char* value : {"", "-1", "2.5", "x", "1e30", "nan", "3,4", "3 "})
    EXPECT_THAT(refusal("rayRounds", value), HasSubstr("--set rayRounds")) << value;
  EXPECT_THAT(refusal("scalingTriangles", "2000,1000"), HasSubstr("ascending, with commas between them"));
  EXPECT_THAT(refusal("scalingTriangles", "1000,"), HasSubstr("whole numbers from 1000"));
  EXPECT_THAT(refusal("waveletFaceSize", "12"), HasSubstr("from 4 to 512, a power of two"));
  EXPECT_THAT(refusal("basisDirections", "100"), HasSubstr("a multiple of 64"));
}

TEST(SuiteOptions, EveryRow_SaysWhatItMeans_AndIsReported) {
  for (const auto& suite : makeSuites()) {
    suite->configure(RunOptions::quickRun());
    const nlohmann::ordered_json json = suite->toJson();
    std::set<std::string> names;
    for (const OptionText& option : suite->options()) {
      EXPECT_TRUE(names.insert(option.name).second) << suite->name() << ": " << option.name;
      EXPECT_FALSE(option.help.empty()) << suite->name() << ": " << option.name;
      EXPECT_EQ(json[option.name].dump(), option.quick) << suite->name() << ": " << option.name;
      EXPECT_FALSE(option.values.empty()) << suite->name() << ": " << option.name;
    }
    EXPECT_EQ(json.size(), names.size());
  }
}

/// Returns a value of a table as `--set` takes it.
std::string setText(const nlohmann::ordered_json& value, const char* separator = ",") {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array()) return value.dump();
  std::string text;
  for (const auto& element : value)
    text += (text.empty() ? "" : separator) +
            setText(element, element.is_array() && element.at(0).is_string() ? ":" : "x");
  return text;
}

TEST(SuiteOptions, UsualAndQuickValues_AreWithinTheirLimits) {
  for (const auto& suite : makeSuites())
    for (const OptionText& option : suite->options())
      for (const std::string& value : {option.usual, option.quick}) {
        RunOptions run;
        run.given.options = {{option.name, setText(nlohmann::ordered_json::parse(value))}};
        EXPECT_NO_THROW(suite->configure(run)) << suite->name() << ": " << option.name;
        EXPECT_EQ(suite->toJson()[option.name].dump(), value) << suite->name() << ": " << option.name;
      }
}

TEST(Catalogue, NameOfASuiteOrOfAPart_ChoosesIt) {
  const auto suites = makeSuites();
  EXPECT_EQ(partsNamed("tracing", suites).size(), 5u);
  const std::vector<ChosenPart> rays = partsNamed("rays", suites);
  ASSERT_EQ(rays.size(), 1u);
  EXPECT_EQ(rays[0].suite->name(), "tracing");
  EXPECT_EQ(rays[0].suite->casePrefix("rays"), "rays/");
  EXPECT_EQ(partsNamed("skip", suites).at(0).suite->casePrefix("skip"), "");
  EXPECT_TRUE(partsNamed("frobnicate", suites).empty());
}

}  // namespace
}  // namespace prelight::benchmarks
