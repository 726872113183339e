#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include "cli/cli_test.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

bool canImport(const std::string& module) {
  const std::string code = " -c 'import " + module + "' 2> /dev/null";
  return std::system(("python3" + code + " || /usr/bin/python3" + code).c_str()) == 0;
}

class CliBench : public CliTest {
 protected:
  /// Charts are drawn where Python has matplotlib, and only there.
  void expectChart(const std::string& name) const {
    static const bool drawn = canImport("matplotlib");
    ASSERT_EQ(std::filesystem::exists(path("plots/" + name + ".svg")), drawn) << name;
    if (drawn) {
      EXPECT_THAT(readFile("plots/" + name + ".svg"), HasSubstr("<svg")) << name;
    }
  }
};

std::set<std::string> keysOf(const nlohmann::json& object) {
  std::set<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.insert(key);
  return keys;
}

void expectReport(const nlohmann::json& report) {
  EXPECT_EQ(keysOf(report),
            (std::set<std::string>{"version", "commit", "device", "driver", "options", "results"}));
  for (const char* key : {"version", "commit", "device", "driver"})
    EXPECT_FALSE(report[key].get<std::string>().empty()) << key;
  EXPECT_GE(report["options"]["runs"], 1);
  ASSERT_FALSE(report["results"].empty());
  for (const auto& result : report["results"]) {
    EXPECT_EQ(keysOf(result),
              (std::set<std::string>{"suite", "case", "metric", "value", "unit", "peer", "ratio"}));
    EXPECT_TRUE(std::isfinite(result["value"].get<double>())) << result;
    // The rate of a suite that ran nothing would be 0.
    if (const std::string unit = result["unit"]; unit.ends_with("/s")) {
      EXPECT_GT(result["value"], 0.0) << result;
    }
    EXPECT_EQ(result["peer"].is_null(), result["ratio"].is_null()) << result;
  }
}

TEST_F(CliBench, Help_ListsTheSuitesAndAnExample) {
  const std::string help = prelightDone({"bench", "--help"}).output;
  for (const char* part : {"cast", "rays", "trees", "build", "scaling", "bake", "error", "reference",
                           "relight", "compress", "vo", "photons", "Examples:", "prelight bench"})
    EXPECT_THAT(help, HasSubstr(part));
}

TEST_F(CliBench, Json_WithAFile_HoldsTheResults) {
  const ProcessResult result =
      prelightDone({"bench", "cast", "--quick", "--json", "cast.json", "--plot", "plots"});
  EXPECT_THAT(result.output, HasSubstr("rays/s"));
  const nlohmann::json report = nlohmann::json::parse(readFile("cast.json"));
  expectReport(report);
  EXPECT_EQ(report["options"]["suites"], nlohmann::json({"tracing"}));
  EXPECT_EQ(report["options"]["parts"], nlohmann::json({"cast"}));
  EXPECT_EQ(report["options"]["finished"], nlohmann::json({"cast"}));
  EXPECT_EQ(report["options"]["tracing"]["castRays"], 1 << 14);
  for (const auto& entry : report["results"]) {
    EXPECT_EQ(entry["suite"], "tracing");
    EXPECT_THAT(entry["case"].get<std::string>(), StartsWith("cast/"));
    EXPECT_GT(entry["value"], 0.0) << entry;
    EXPECT_GT(entry["ratio"], 0.0) << entry;
  }
  expectChart("cast");
}

TEST_F(CliBench, Rays_ThroughATreeAndItsPeer_HitTheSame) {
  prelightDone({"bench", "rays", "--quick", "--quiet", "--json", "rays.json"});
  const nlohmann::json report = nlohmann::json::parse(readFile("rays.json"));
  const bool withPeer = report["options"]["rayPeer"] != "none";
  std::set<std::string> cases;
  for (const auto& entry : report["results"]) {
    cases.insert(entry["case"].get<std::string>());
    EXPECT_EQ(entry["peer"].is_null(), !withPeer || entry["metric"] == "disagreement") << entry;
    if (entry["metric"] == "disagreement") {
      EXPECT_LT(entry["value"], 1e-4) << entry;
    }
  }
  EXPECT_EQ(cases, (std::set<std::string>{"rays/bake-order 2k", "rays/random 2k", "rays/bake-order-any 2k",
                                          "rays/random-any 2k", "rays/bake-order-near 2k", "rays/photon 2k",
                                          "rays/camera 2k"}));
}

TEST_F(CliBench, Relight_EveryKernel_AgreesWithItsReference) {
  prelightDone({"bench", "relight", "--quick", "--quiet", "--json", "relight.json"});
  const nlohmann::json report = nlohmann::json::parse(readFile("relight.json"));
  expectReport(report);
  std::size_t compared = 0;
  for (const auto& entry : report["results"])
    if (entry["metric"] == "relative error") {
      // Haar wavelets sample noise on a cube and do not integrate it.
      const bool sampled = entry["case"].get<std::string>().starts_with("relight/sky to Haar");
      EXPECT_LT(entry["value"], sampled ? 0.3 : 1e-6) << entry;
      ++compared;
    }
  EXPECT_GE(compared, 15u);
}

TEST_F(CliBench, Compress_EveryMethod_IsSmallerThanFloats) {
  prelightDone({"bench", "compress", "--quick", "--quiet", "--json", "compress.json", "--plot", "plots"});
  const nlohmann::json report = nlohmann::json::parse(readFile("compress.json"));
  expectReport(report);
  std::set<std::string> cases;
  for (const auto& entry : report["results"]) {
    cases.insert(entry["case"].get<std::string>());
    if (entry["metric"] == "bytes per vertex") {
      EXPECT_GT(entry["ratio"], 1.0) << entry;
    }
  }
  EXPECT_EQ(cases.size(), 10u);
  expectChart("compress");
}

TEST_F(CliBench, Vo_EveryTechnique_IsMeasuredWithBothKindsOfLights) {
  prelightDone({"bench", "vo", "--quick", "--quiet", "--json", "vo.json", "--plot", "plots"});
  const nlohmann::json report = nlohmann::json::parse(readFile("vo.json"));
  expectReport(report);
  std::map<std::string, std::set<std::string>> casesOf;
  for (const auto& entry : report["results"]) casesOf[entry["metric"]].insert(entry["case"]);
  for (const char* where : {"around", "inside"}) {
    const std::set<std::string>& cases = casesOf[std::string("error, lights ") + where];
    EXPECT_EQ(cases.size(), 11u);
    for (const char* name : {"no shadow", "traced at vertices", "AO", "node/thesis, N = 2", "auto:12/soft"})
      EXPECT_TRUE(cases.count(std::string("vo/shapes/") + name) == 1) << name;
  }
  EXPECT_EQ(casesOf["added processor time"].size(), 2u);
  EXPECT_EQ(casesOf["R2 of a line"].size(), 1u);
  expectChart("vo");
}

TEST_F(CliBench, Photons_TreesAndGrids_FindTheSame) {
  prelightDone({"bench", "photons", "--quick", "--quiet", "--json", "photons.json"});
  const nlohmann::json report = nlohmann::json::parse(readFile("photons.json"));
  expectReport(report);
  std::size_t compared = 0;
  for (const auto& entry : report["results"])
    if (entry["metric"] == "difference") {
      EXPECT_LT(entry["value"], 1e-4) << entry;
      ++compared;
    }
  EXPECT_EQ(compared, 4u);
}

TEST_F(CliBench, Update_SendsAFewPhotonsAgain_AndSettlesToTheWhole) {
  prelightDone({"bench", "update", "--quick", "--quiet", "--json", "update.json"});
  const nlohmann::json report = nlohmann::json::parse(readFile("update.json"));
  expectReport(report);
  std::map<std::string, std::set<std::string>> metrics;
  for (const auto& entry : report["results"]) {
    metrics[entry["metric"]].insert(entry["case"]);
    if (entry["metric"] == "difference") {
      EXPECT_LT(entry["value"], 0.02) << entry;
    }
    if (entry["metric"] == "frame") {
      EXPECT_FALSE(entry["peer"].is_null()) << entry;
    }
  }
  EXPECT_EQ(metrics["frame"].size(), 2u);
  EXPECT_EQ(metrics["ways that change"].size(), 2u);
  EXPECT_EQ(metrics["difference"].size(), 4u);
}

TEST_F(CliBench, Stability_OfOneSubject_MeasuresNoOther) {
  prelightDone(
      {"bench", "stability", "--case", "counts of power", "--quick", "--quiet", "--json", "one.json"});
  const nlohmann::json report = nlohmann::json::parse(readFile("one.json"));
  expectReport(report);
  for (const auto& entry : report["results"])
    EXPECT_THAT(entry["case"].get<std::string>(), StartsWith("counts of power/"));
}

TEST_F(CliBench, CaseWithoutASuite_RunsTheSuitesThatHaveIt_AndNoOther) {
  prelightDone({"bench", "--case", "caustics of a light map", "--quick", "--quiet", "--json", "chosen.json"});
  const nlohmann::json report = nlohmann::json::parse(readFile("chosen.json"));
  expectReport(report);
  EXPECT_EQ(report["options"]["suites"], nlohmann::json({"skip"}));
  for (const auto& entry : report["results"])
    EXPECT_THAT(entry["case"].get<std::string>(), StartsWith("caustics of a light map/"));
}

TEST_F(CliBench, CaseOfNoSuite_IsRefused) {
  for (const std::vector<std::string>& suite : {std::vector<std::string>{}, {"skip"}, {"bake-scaling"}}) {
    std::vector<std::string> words = {"bench"};
    words.insert(words.end(), suite.begin(), suite.end());
    words.insert(words.end(), {"--case", "no such case", "--quick"});
    expectFailure(2, words, {"--case no such case"});
  }
}

TEST_F(CliBench, Stability_EveryBound_Holds) {
  prelightDone({"bench", "stability", "--quick", "--quiet", "--json", "stability.json", "--plot", "plots"});
  const nlohmann::json report = nlohmann::json::parse(readFile("stability.json"));
  expectReport(report);
  std::map<std::string, std::size_t> metrics;
  for (const auto& entry : report["results"]) {
    ++metrics[entry["metric"]];
    if (entry["metric"] == "relative error") {
      EXPECT_GE(entry["ratio"], 1.0) << entry;
    }
    if (entry["metric"] == "values not finite") {
      EXPECT_EQ(entry["value"], 0.0) << entry;
    }
  }
  EXPECT_GT(metrics["relative error"], 300u);
  EXPECT_EQ(metrics["values not finite"], metrics["relative error"]);
  for (const char* part : {"| photons |", "| SH |", "`cast/light_kernels.cl:sumLightRays`"})
    EXPECT_THAT(readFile("plots/stability.md"), HasSubstr(part));
  for (const char* name : {"stability", "stability-count", "stability-size"}) expectChart(name);
}

#ifdef PRELIGHT_WITH_VIEWER
TEST_F(CliBench, Techniques_TablesAndPictures_AreWrittenIntoTheFolder) {
  prelightDone({"bench", "techniques", "--quick", "--quiet", "--json", "techniques.json", "--plot", "plots"});
  const nlohmann::json report = nlohmann::json::parse(readFile("techniques.json"));
  expectReport(report);
  std::map<std::string, std::set<std::string>> metrics;
  for (const auto& entry : report["results"]) metrics[entry["case"]].insert(entry["metric"]);
  for (const char* row : {"shapes/VO/DD", "crowd under a sky/GTAO", "cornell/SH3, 8 shells", "cornell/Full"})
    for (const char* metric : {"RMSE", "standard error of RMSE", "RMSE of its claim", "rank"})
      EXPECT_TRUE(metrics[row].contains(metric)) << row << ": " << metric;
  EXPECT_EQ(metrics["shapes/VO/DD"].contains("FLIP"), canImport("flip_evaluator"));
  EXPECT_TRUE(metrics["cornell/path traced"].contains("left in the best technique's"));
  const std::string table = readFile("plots/techniques.md");
  for (const char* part : {"| Phong |", "| VO/DD |", "| SH3/DD |", "| Haar/DD |", "| path traced |",
                           "Table 7.1", "techniques-lights.svg", "Radiosity"})
    EXPECT_THAT(table, HasSubstr(part));
  for (const char* name : {"shapes", "crowd-under-a-sky", "cornell"}) {
    const std::string file = std::string("plots/techniques-") + name;
    EXPECT_THAT(readFile(file + "-00.png"), StartsWith("\x89PNG")) << name;
    EXPECT_EQ(std::filesystem::exists(path(file + ".png")), canImport("matplotlib")) << name;
  }
  expectChart("techniques-lights");

  std::istringstream rows(readFile("plots/techniques.csv"));
  std::string row, names;
  std::getline(rows, names);
  const auto commas = [](const std::string& text) { return std::count(text.begin(), text.end(), ','); };
  int count = 0;
  for (; std::getline(rows, row); ++count) EXPECT_EQ(commas(row), commas(names)) << row;
  EXPECT_GE(count, 2 * 7);
  EXPECT_THAT(readFile("plots/techniques-lights.csv"), StartsWith("technique,lights,frames_per_s\nPhong,1,"));
}
#endif

#ifdef PRELIGHT_WITH_VIEWER
TEST_F(CliBench, Viewer_EverySizeAndInput_HasTimesLatencyAndUploads) {
  prelightDone({"bench", "viewer", "--quick", "--quiet", "--case", "shapes/vo", "--json", "viewer.json"});
  const nlohmann::json report = nlohmann::json::parse(readFile("viewer.json"));
  expectReport(report);
  std::map<std::string, std::set<std::string>> metrics;
  for (const auto& entry : report["results"]) {
    EXPECT_GE(entry["value"], 0.0) << entry;
    metrics[entry["case"]].insert(entry["metric"]);
  }
  for (const std::string size : {"32x18", "64x36"})
    for (const char* input : {"orbit", "moving light", "turned sky", "moving node"})
      for (const char* metric :
           {"median frame", "processor time", "OpenGL's timer", "uploaded a frame",
            "latency to the next picture", "latency to the finished picture", "frames timed"})
        EXPECT_TRUE(metrics["shapes/vo/" + size + "/" + input].contains(metric)) << size << input << metric;
  EXPECT_TRUE(std::any_of(metrics.begin(), metrics.end(),
                          [](const auto& some) { return some.first.starts_with("OpenGL: "); }));
}
#endif

// Bakes check for a stop after every block.
TEST_F(CliBench, Interrupted_LeavesAValidReport) {
  const ProcessResult stopped =
      prelight({"bench", "stages", "--json", "cut.json"}, {.signalAfterOutput = SIGINT});
  ASSERT_EQ(stopped.exitCode, interrupted) << stopped.errors;
  EXPECT_THAT(stopped.errors, HasSubstr("everything that was measured before"));
  const nlohmann::json report = nlohmann::json::parse(readFile("cut.json"));
  EXPECT_EQ(report["options"]["suites"], nlohmann::json({"bake"}));
  EXPECT_TRUE(report["options"]["finished"].empty());
  EXPECT_TRUE(report["results"].is_array());
}

TEST_F(CliBench, Json_WithoutAFile_GoesToStandardOutput) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"bench", "cast", "--quick", "--json"},
        {"--json", "bench", "cast", "--quick"}})
    expectReport(nlohmann::json::parse(prelightDone(arguments).output));
  EXPECT_TRUE(files().empty());
}

/// Suites and their parts.
const std::map<std::string, std::vector<std::string>>& partsOfSuites() {
  static const std::map<std::string, std::vector<std::string>> parts = {
#ifdef PRELIGHT_WITH_VIEWER
      {"live", {"update", "following", "live-light"}},
      {"pictures", {"reference", "full", "objects", "materials"}},
      {"techniques", {"techniques"}},
      {"viewer", {"viewer"}},
      {"visibility", {"vo", "near-lamps", "screen", "rasterised"}},
#else
      {"live", {"update"}},
      {"pictures", {"reference", "full"}},
      {"visibility", {"vo"}},
#endif
      {"bake", {"stages", "bake-scaling", "error"}},
      {"indirect", {"photons", "gather", "lightmaps", "radiosity"}},
      {"relighting", {"basis", "wavelets", "relight"}},
      {"skip", {"skip"}},
      {"stability", {"stability"}},
      {"tracing", {"cast", "rays", "trees", "build", "scaling"}},
      {"transfer", {"compress", "encodings", "animation"}}};
  return parts;
}

struct SuitePart {
  std::string suite, part;
};

std::vector<SuitePart> allParts() {
  std::vector<SuitePart> all;
  for (const auto& [suite, parts] : partsOfSuites())
    for (const std::string& part : parts) all.push_back({suite, part});
  return all;
}

TEST_F(CliBench, Help_ListsTheSuitesOfTheseTests) {
  std::istringstream help(prelightDone({"bench", "--help"}).output);
  std::map<std::string, std::vector<std::string>> listed;
  std::string suite;
  bool within = false;
  for (std::string line; std::getline(help, line);) {
    std::istringstream words(line);
    std::string first;
    words >> first;
    if (within && line.starts_with("    ")) {
      listed[suite].push_back(first);
    } else if (within && line.starts_with("  ")) {
      listed[suite = first];
    }
    within = line.starts_with("Suites") || (within && line.starts_with("  "));
  }
  for (auto& [name, parts] : listed)
    if (parts.empty()) parts = {name};
  EXPECT_EQ(listed, partsOfSuites());
}

TEST_F(CliBench, List_SaysWhatTheOptionsOfASuiteMean_AndMeasuresNothing) {
  const std::string text = prelightDone({"bench", "tracing", "--list"}).output;
  EXPECT_THAT(text, HasSubstr("castRays"));
  EXPECT_THAT(text, HasSubstr("1048576 (quick: 16384): rays of each case of `cast`"));
  EXPECT_THAT(text, Not(HasSubstr("device")));
}

TEST_F(CliBench, Set_ChangesOptionsOfTheSuite_AndTheReportHasThem) {
  prelightDone(
      {"bench", "build", "--quick", "--quiet", "--set", "rayTriangles=1000,3000", "--json", "set.json"});
  const nlohmann::json report = nlohmann::json::parse(readFile("set.json"));
  EXPECT_EQ(report["options"]["tracing"]["rayTriangles"], nlohmann::json({1000, 3000}));
  EXPECT_EQ(report["options"]["tracing"]["castRays"], 16384);
  EXPECT_THAT(report["results"].back()["case"].get<std::string>(), HasSubstr("3k"));
}

TEST_F(CliBench, Set_OfUnknownOptionsAndValues_IsRefusedBeforeMeasuring) {
  expectFailure(badUsage, {"bench", "tracing", "--set", "rayRound=3"},
                {"--set rayRound", "rayRounds", "--list"});
  expectFailure(badUsage, {"bench", "tracing", "--set", "voRays=3"}, {"--set voRays", "no suite that runs"});
  expectFailure(badUsage, {"bench", "tracing", "--set", "rayRounds"}, {"--set", "NAME=VALUE"});
  expectFailure(badUsage, {"bench", "tracing", "--set", "rayRounds=many"},
                {"--set rayRounds", "'many'", "a whole number from 1"});
}

class CliBenchSuite : public CliBench, public ::testing::WithParamInterface<SuitePart> {};

TEST_P(CliBenchSuite, Quick_MeasuresAndPlots) {
  const auto& [suite, part] = GetParam();
  prelightDone({"bench", part, "--quick", "--quiet", "--json", "all.json", "--plot", "plots"});
  const nlohmann::json report = nlohmann::json::parse(readFile("all.json"));
  expectReport(report);
  for (const auto& entry : report["results"]) {
    EXPECT_EQ(entry["suite"], suite);
    if (suite != part) {
      EXPECT_THAT(entry["case"].get<std::string>(), StartsWith(part + "/"));
    }
  }
  expectChart(part);
}

INSTANTIATE_TEST_SUITE_P(Suites, CliBenchSuite, ::testing::ValuesIn(allParts()), [](const auto& test) {
  std::string name = test.param.part;
  std::erase(name, '-');
  return name;
});

TEST_F(CliBench, Usage_OfUnknownSuitesAndUnusableOutputs_IsRefusedBeforeMeasuring) {
  expectFailure(badUsage, {"bench", "frobnicate"}, {"frobnicate", "cast", "bake", "error"});
  expectFailure(badUsage, {"bench", "--json", "cast"}, {"--json", "cast"});
  expectFailure(badUsage, {"bench", "cast", "--json", "cast.txt"}, {"--json", "cast.txt", ".json"});
  expectFailure(failed, {"bench", "cast", "--json", "nowhere/cast.json"}, {"--json", "nowhere"});
  expectFailure(failed, {"bench", "cast", "--plot", "nowhere/plots"}, {"--plot", "nowhere"});
}

}  // namespace
}  // namespace prelight::test
