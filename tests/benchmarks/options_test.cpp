#include <gmock/gmock.h>

#include <set>

#include "benchmarks/catalogue.h"
#include "benchmarks/suites/pictures/pictures_suite.h"
#include "benchmarks/suites/skip/skip_suite.h"
#include "benchmarks/suites/tracing/tracing_suite.h"

namespace prelight::benchmarks {
namespace {

using ::testing::ElementsAre;

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

TEST(SuiteOptions, EveryRow_SaysWhatItMeans_AndIsReported) {
  for (const auto& suite : makeSuites()) {
    suite->configure(RunOptions::quickRun());
    const nlohmann::ordered_json json = suite->toJson();
    std::set<std::string> names;
    for (const OptionText& option : suite->options()) {
      EXPECT_TRUE(names.insert(option.name).second) << suite->name() << ": " << option.name;
      EXPECT_FALSE(option.help.empty()) << suite->name() << ": " << option.name;
      EXPECT_EQ(json[option.name].dump(), option.quick) << suite->name() << ": " << option.name;
    }
    EXPECT_EQ(json.size(), names.size());
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
