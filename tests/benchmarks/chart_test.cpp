#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>

#include "benchmarks/catalogue.h"
#include "benchmarks/plot/python.h"
#include "benchmarks/run/measure.h"
#include "prelight/error.h"

namespace prelight::benchmarks {
namespace {

using ::testing::HasSubstr;

using Json = nlohmann::ordered_json;

std::string textOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void add(Json& report, const std::string& suite, const std::string& name, const std::string& metric,
         double value) {
  report["results"].push_back(toJson(suite, {name, metric, value, "s", "a peer", 2.0}));
}

/// Results of several suites, some of them with names that are hard to place.
Json someReport() {
  Json report = {{"device", "a device"},
                 {"driver", "a platform, 3.0"},
                 {"options", {{"quick", true}}},
                 {"results", Json::array()}};
  for (const char* name : {"shapes/AO", "shiny shapes/SH3/DD+SS", "crowd under a sky/VO/DD auto:12"})
    add(report, "techniques", name, "RMSE", 0.3);
  for (const char* name : {"vo/shapes/traced at vertices", "vo/shapes/auto:12/thesis, N = 2"})
    add(report, "visibility", name, "error, lights around", 0.6);
  for (const char* name : {"animation/swing/two seeds", "animation/cornell, boxes moving/3 keys/linear"})
    add(report, "transfer", name, "rms error", 0.2);
  for (const char* name : {"relight/copy", "relight/SH rotation, order 6, 3000 functions"})
    add(report, "relighting", name, "bandwidth per core", 3e9);
  for (const char* metric : {"error", "time"})
    add(report, "indirect", "gather/rooms/all/16 rays", metric, 0.02);
  for (const char* movement : {"orbit", "moving light"})
    for (const char* metric : {"median frame", "latency to the next picture", "part: shadow maps"})
      add(report, "viewer", std::string("shapes/lightmap/640x360/") + movement, metric, 30.0);
  return report;
}

TEST(Charts, OfSeveralSuites_AreDrawnWithTheirNamesAndNotes) {
  if (!canDrawCharts()) {
    EXPECT_EQ(pythonWith("matplotlib"), "");
    return;
  }
  const WorkFolder folder;
  std::set<std::string> names;
  for (const std::filesystem::path& file : drawCharts(someReport(), folder / "")) {
    names.insert(file.filename().string());
    const std::string text = textOf(file);
    EXPECT_THAT(text, HasSubstr("<svg")) << file;
    EXPECT_THAT(text, HasSubstr("Quick run, not to be kept. a device, a platform")) << file;
  }
  EXPECT_EQ(names, (std::set<std::string>{"techniques.svg", "techniques-lights.svg", "vo.svg",
                                          "animation.svg", "relight.svg", "gather.svg", "gather-bias.svg",
                                          "viewer.svg", "viewer-parts.svg", "viewer-latency.svg"}));
  for (const char* part : {"traced at vertices", "auto:12, thesis, N = 2", "RMS error of direct light"})
    EXPECT_THAT(textOf(folder / "vo.svg"), HasSubstr(part));
  EXPECT_THAT(textOf(folder / "relight.svg"), HasSubstr("3 GB/s, 2 x"));
}

TEST(Charts, EveryPartOfEverySuite_HasOne) {
  const std::string& script = plotScripts().at("plot/plot.py");
  std::set<std::string> names;
  for (const auto& suite : makeSuites())
    for (const Suite::Part& part : suite->parts()) {
      EXPECT_THAT(script, HasSubstr("\n    \"" + part.name + "\": {\"" + part.name + "\": "));
      EXPECT_TRUE(names.insert(part.name).second) << part.name << " is a part of two suites";
    }
}

TEST(Python, ModuleThatNobodyHas_IsFoundNowhere) { EXPECT_EQ(pythonWith("a_module_that_nobody_has"), ""); }

TEST(Python, ScriptThatFails_SaysWhatItPrinted) {
  const std::string python = pythonWith("json");
  ASSERT_FALSE(python.empty());
  try {
    runScript(python, "flip.py", {"a file that is not there"});
    FAIL() << "it has too few arguments";
  } catch (const Error& error) {
    EXPECT_THAT(std::string(error.what()), HasSubstr("Traceback"));
  }
}

}  // namespace
}  // namespace prelight::benchmarks
