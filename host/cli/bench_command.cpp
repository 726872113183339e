#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <exception>
#include <memory>

#include "base/suggestion.h"
#include "benchmarks/plot.h"
#include "benchmarks/ray_peer.h"
#include "benchmarks/stability/stability_suite.h"
#include "benchmarks/suite.h"
#include "cli/bench_report.h"
#include "cli/commands.h"
#include "cli/output_file.h"
#include "cli/run_program.h"
#include "cli/session.h"
#include "cli/values.h"
#include "prelight/error.h"
#include "prelight/plan.h"

namespace prelight::cli {
namespace {

using benchmarks::BenchmarkOptions;
using benchmarks::BenchmarkResult;

constexpr std::uint64_t maxTruthSamples = 1u << 20;
constexpr double leastSeconds = 1.0, mostSeconds = 1e7;
constexpr std::uint64_t maxPhotons = 0xf0000000u;

struct BenchCommand {
  std::string suite;  ///< empty: all
  std::filesystem::path json;
  std::filesystem::path plots;
  std::vector<std::filesystem::path> skies;
  std::vector<std::string> models;
  std::string onlyCase;
  std::filesystem::path truths;
  std::optional<double> seconds;
  std::optional<std::uint64_t> rays;
  std::optional<std::uint64_t> samples;
  std::optional<std::uint64_t> photons;
  std::optional<PictureSize> size;
  bool quick = false;
};

std::vector<std::string> knownSuites() {
  std::vector<std::string> names;
  for (const auto& suite : benchmarks::suites()) names.push_back(suite.name);
  return names;
}

std::vector<std::string> chosenSuites(const std::string& suite) {
  const std::vector<std::string> known = knownSuites();
  if (suite.empty()) return known;
  if (std::find(known.begin(), known.end(), suite) == known.end())
    throw UsageError("SUITE", fmt::format("got '{}', expected one of {}", suite, fmt::join(known, ", ")),
                     didYouMean(suite, known) + "prelight bench --help lists them");
  return {suite};
}

/// Returns the suites to measure, without those in which no case is chosen.
std::vector<std::string> suitesWithCases(const std::vector<std::string>& suites,
                                         const BenchmarkOptions& options) {
  std::vector<std::string> kept;
  std::copy_if(suites.begin(), suites.end(), std::back_inserter(kept),
               [&](const std::string& suite) { return benchmarks::hasChosenCase(suite, options); });
  if (kept.empty())
    throw UsageError(
        "--case " + options.onlyCase, "no suite has a case with this name",
        "`prelight bench viewer --case x` names its cases, docs/notes/skipping.md those of `skip`");
  return kept;
}

void checkBenchOutputs(const BenchCommand& command) {
  const std::vector<std::string> known = knownSuites();
  if (std::find(known.begin(), known.end(), command.json) != known.end())
    throw UsageError("--json", fmt::format("got the suite '{}', expected a file", command.json.string()),
                     "name the suite before --json");
  if (!command.json.empty()) checkOutputFile("--json", command.json, {".json"});
  if (!command.plots.empty()) checkOutputFolder("--plot", command.plots);
  if (!command.truths.empty()) checkOutputFolder("--truths", command.truths);
}

/// Returns a text such as "10.2 M rays/s" or "0.123 s".
std::string valueText(const BenchmarkResult& result) {
  if (result.value >= 1000.0) return fmt::format("{} {}", shortCount(result.value), result.unit);
  return fmt::format("{:.4g} {}", result.value, result.unit);
}

void printResult(const Console& console, const BenchmarkResult& result) {
  const std::string ratio =
      result.ratio ? fmt::format("   {:.2f} x {}", *result.ratio, result.peer) : std::string();
  console.line(result.suite,
               fmt::format("{:<40} {:<15} {:<14}{}", result.case_, result.metric, valueText(result), ratio));
}

void writePlots(const std::filesystem::path& folder, const std::vector<BenchmarkResult>& results,
                const DeviceInfo& device, bool quick, const Console& console) {
  const std::string subtitle =
      fmt::format("{}{} ({} compute units), {}", quick ? "Quick run, not to be kept. " : "", device.name,
                  device.computeUnits, device.platform);
  for (const benchmarks::Plot& plot : benchmarks::makePlots(results, subtitle)) {
    const std::filesystem::path file = folder / (plot.name + ".svg");
    writeTextFile(file, plot.svg);
    console.line("wrote", file.string());
  }
}

/// Throws if a result breaks its bounds. It is called after all outputs are written, which a failure must not
/// prevent.
void checkBounds(const std::vector<BenchmarkResult>& results) {
  const std::vector<std::string> broken = benchmarks::brokenBounds(results);
  if (broken.empty()) return;
  throw Error(
      ExitCode::RuntimeFailure, "bench stability",
      fmt::format("{} bounds of this suite are broken:\n  {}", broken.size(), fmt::join(broken, "\n  ")),
      "docs/notes/stability.md explains the bounds");
}

BenchmarkOptions optionsOf(const BenchCommand& command) {
  BenchmarkOptions options = command.quick ? BenchmarkOptions::quick() : BenchmarkOptions();
  options.skies = command.skies;
  options.folder = command.plots;
  options.truths = command.truths;
  options.onlyCase = command.onlyCase;
  options.program = std::filesystem::read_symlink("/proc/self/exe");
  options.suiteSeconds = command.seconds.value_or(options.suiteSeconds);
  if (command.rays) {
    options.techniqueRays = options.objectRays = *command.rays;
    options.materialRays = {*command.rays};
  }
  if (command.samples)
    options.techniqueSamples = options.objectSamples = options.materialTruthSamples = *command.samples;
  options.stabilityFlownPhotons = command.photons.value_or(options.stabilityFlownPhotons);
  if (command.size) {
    options.techniqueHeight = command.size->height;
    options.techniqueWidth = command.size->width.value_or(command.size->height * 16 / 9);
    options.viewerSizes = {{options.techniqueWidth, options.techniqueHeight}};
    options.objectWidth = options.materialWidth = options.techniqueWidth;
    options.objectHeight = options.materialHeight = options.techniqueHeight;
  }
  for (std::vector<std::string>* scenes :
       {&options.screenScenes, &options.gatherScenes, &options.viewerScenes, &options.rasterisedScenes,
        &options.liveLightRows})
    scenes->insert(scenes->begin(), command.models.begin(), command.models.end());
  options.objectModels.insert(options.objectModels.end(), command.models.begin(), command.models.end());
  return options;
}

/// Measures the suites; each case's results reach the report as soon as the case ends.
void measure(const std::vector<std::string>& suites, const Device& device, const BenchmarkOptions& options,
             Session& session, BenchReport& report) {
  for (const std::string& suite : suites) {
    benchmarks::SuiteRun run(session.progress(), [&](std::span<const BenchmarkResult> measured) {
      session.progress().clear();
      for (const BenchmarkResult& result : measured) printResult(session.console(), result);
      report.add(measured);
    });
    benchmarks::runSuite(suite, device, options, run);
    run.finish();
    report.finish(suite);
    session.progress().clear();
  }
}

void runBench(const BenchCommand& command, Context& context) {
  Session session(context);
  std::vector<std::string> suites = chosenSuites(command.suite);
  checkBenchOutputs(command);
  const BenchmarkOptions options = optionsOf(command);
  if (command.suite.empty()) suites = suitesWithCases(suites, options);
  const Device device = Device::open(session.deviceOptions());
  if (!command.plots.empty()) makeOutputFolder("--plot", command.plots);
  if (!command.truths.empty()) makeOutputFolder("--truths", command.truths);
  session.console().line("device", device.info().name);
  const std::string peer = benchmarks::embreeVersion();
  session.console().line("ray peer", peer.empty() ? "none: built without Embree (libembree-dev)" : peer);
  const StopSignals::SafePoints safePoints(context.signals);  // suites write files of their own
  BenchReport report(command.json, suites, options, device.info());
  std::exception_ptr stopped;
  try {
    measure(suites, device, options, session, report);
  } catch (const Interrupted&) {
    stopped = std::make_exception_ptr(
        Interrupted("interrupted; the output files hold everything that was measured before"));
  }
  if (!command.json.empty()) session.console().line("wrote", command.json.string());
  if (!command.plots.empty())
    writePlots(command.plots, report.results(), device.info(), command.quick, session.console());
  if (stopped) std::rethrow_exception(stopped);
  session.console().json(report.json());
  checkBounds(report.results());
}

std::string suitesText() {
  std::string text = "Suites:\n";
  for (const auto& suite : benchmarks::suites())
    text += fmt::format("  {:<14}{}\n", suite.name, suite.description);
  return text;
}

void addBenchCommand(CLI::App& program, Context& context) {
  const auto command = std::make_shared<BenchCommand>();
  CLI::App* app = program.add_subcommand("bench", "Measure speed and error on built-in scenes");
  app->add_option("SUITE", command->suite, "what to measure (default: every suite)")->type_name("");
  // This shadows the global flag of the same name, whose meaning is that of --json without FILE.
  CLI::Option* json = app->add_option("--json", command->json, "write the results; without FILE, to stdout")
                          ->type_name("[FILE]")
                          ->expected(0, 1);
  app->add_option("--plot", command->plots,
                  "write a chart of each suite (.svg), and the tables and pictures of `techniques`, `screen` "
                  "and `stability`")
      ->type_name("DIR");
  app->add_option("--env", command->skies,
                  "skies that `wavelets` uses in addition to its own lights; `techniques` uses the first one")
      ->type_name("MAP");
  app->add_option("--model", command->models,
                  "glTF files that `gather`, `live-light`, `rasterised`, `screen` and `viewer` measure in "
                  "addition to their scenes")
      ->type_name("FILE");
  app->add_option(
         "--case", command->onlyCase,
         "run only those cases of `bake-scaling`, `compress`, `skip`, `stability` and `viewer` whose names "
         "contain this; a case of `bake-scaling` that is named in full runs however long it takes")
      ->type_name("TEXT");
  addRealNumber(
      *app, "--time", {leastSeconds, mostSeconds}, [command](double value) { command->seconds = value; },
      "seconds that `viewer`, `gather` and `techniques` take each, approximately (default 540): the cases of "
      "a suite share them, and slow ones are repeated less often");
  app->add_option("--truths", command->truths,
                  "folder that keeps the path-traced pictures of `techniques`, which later runs continue")
      ->type_name("DIR");
  addWholeNumber(
      *app, "--rays", {1, BakeRequest::maxRays}, [command](std::uint64_t n) { command->rays = n; },
      "rays per vertex for `techniques` on its scenes with few vertices (default 10000; at most 1024 on the "
      "others), and for `objects` and `materials`");
  addWholeNumber(
      *app, "--spp", {1, maxTruthSamples}, [command](std::uint64_t n) { command->samples = n; },
      "samples per pixel: for `techniques` the greatest number in each part of its path-traced pictures "
      "(default 65536; a part ends earlier when it is exact enough or the scene's share of --time is spent), "
      "and for `objects` and `materials` the number (default 512)");
  addWholeNumber(
      *app, "--photons", {1, maxPhotons}, [command](std::uint64_t n) { command->photons = n; },
      "photons that `stability` sends through each of its rooms (default 65536)");
  addPictureSize(
      *app, "--size", [command](PictureSize size) { command->size = size; },
      "size in pixels of the pictures of `techniques`, `objects` (default 240x135), `materials` (160x120) "
      "and `viewer` (640x360 and 1280x720); one number is the height");
  app->add_flag("--quick", command->quick,
                "run for a few seconds to show that everything works; the numbers are worth nothing");
  app->footer(suitesText() +
              "\nExamples:\n"
              "  prelight bench\n"
              "  prelight bench cast --json cast.json --plot plots\n"
              "  prelight bench viewer --time 120 --json viewer.json --plot plots\n"
              "  prelight bench techniques --plot techniques --env sky.hdr --truths truths");
  app->callback([command, json, &context] {
    if (json->count() > 0 && command->json.empty()) context.options.json = true;
    runBench(*command, context);
  });
}

}  // namespace
}  // namespace prelight::cli

int main(int argumentCount, char** arguments) {
  return prelight::cli::runProgram(argumentCount, arguments, prelight::cli::addBenchCommand);
}
