#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <exception>
#include <memory>

#include "base/text.h"
#include "benchmarks/catalogue.h"
#include "benchmarks/peers/embree/ray_peer.h"
#include "benchmarks/plot/python.h"
#include "benchmarks/truth/picture_error.h"
#include "cli/commands.h"
#include "cli/commands/bench_report.h"
#include "cli/options/values.h"
#include "cli/output_file.h"
#include "cli/run_program.h"
#include "cli/session.h"
#include "prelight/error.h"
#include "prelight/plan.h"

namespace prelight::cli {
namespace {

using benchmarks::BenchmarkResult;
using benchmarks::ChosenPart;
using benchmarks::RunOptions;
using benchmarks::Suite;
using Suites = std::vector<std::unique_ptr<Suite>>;

constexpr std::uint64_t maxTruthSamples = 1u << 20;
constexpr double leastSeconds = 1.0, mostSeconds = 1e7;
constexpr std::uint64_t maxPhotons = 0xf0000000u;
constexpr const char* measuredBefore =
    "interrupted; the output files hold everything that was measured before";

struct BenchCommand {
  std::string suite;  ///< or a part of one; empty: all
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
  std::vector<std::string> options;  ///< NAME=VALUE
  bool quick = false;
  bool list = false;  ///< print the options of the suites and measure nothing
};

std::vector<ChosenPart> chosenParts(const std::string& name, const Suites& suites) {
  std::vector<ChosenPart> parts = benchmarks::partsNamed(name, suites);
  if (!parts.empty()) return parts;
  const std::vector<std::string> known = benchmarks::knownNames(suites);
  throw UsageError("SUITE", fmt::format("got '{}', expected one of {}", name, fmt::join(known, ", ")),
                   didYouMean(name, known) + "prelight bench --help lists them");
}

/// Returns the options that `--set` gives. Throws UsageError for one that no suite of these parts has.
std::vector<benchmarks::SetOption> givenOptions(const std::vector<std::string>& texts,
                                                const std::vector<ChosenPart>& parts) {
  std::vector<std::string> known;
  for (const ChosenPart& chosen : parts)
    for (const benchmarks::OptionText& option : chosen.suite->options()) known.push_back(option.name);
  std::vector<benchmarks::SetOption> given;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos)
      throw UsageError("--set", fmt::format("got '{}', expected NAME=VALUE", text),
                       "write for example --set rayRounds=3");
    given.push_back({text.substr(0, equals), text.substr(equals + 1)});
    const std::string& name = given.back().name;
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw UsageError("--set " + name, "no suite that runs has this option",
                       didYouMean(name, known) + "prelight bench SUITE --list shows the options of a suite");
  }
  return given;
}

/// Leaves out parts without a chosen case. A single part reports itself which cases it has.
std::vector<ChosenPart> partsWithCases(const std::vector<ChosenPart>& parts, const std::string& onlyCase) {
  if (parts.size() == 1) return parts;
  std::vector<ChosenPart> kept;
  std::copy_if(parts.begin(), parts.end(), std::back_inserter(kept),
               [](const ChosenPart& chosen) { return chosen.suite->hasChosenCase(chosen.part); });
  if (kept.empty())
    throw UsageError("--case " + onlyCase, "no suite has a case of such a name",
                     "`prelight bench viewer --case x` names its cases, docs/skipping.md those of `skip`");
  return kept;
}

void checkBenchOutputs(const BenchCommand& command, const Suites& suites) {
  const std::vector<std::string> known = benchmarks::knownNames(suites);
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

void printResult(const Console& console, const std::string& suite, const BenchmarkResult& result) {
  const std::string ratio =
      result.ratio ? fmt::format("   {:.2f} x {}", *result.ratio, result.peer) : std::string();
  console.line(suite,
               fmt::format("{:<40} {:<15} {:<14}{}", result.case_, result.metric, valueText(result), ratio));
}

/// Warns before anything is measured of what will be missing, and says what helps.
void warnOfMissingPython(const BenchCommand& command, const std::vector<ChosenPart>& parts,
                         Session& session) {
  if (!command.plots.empty() && !benchmarks::canDrawCharts())
    session.warn(
        "no charts will be drawn: no Python here has matplotlib; install python3-matplotlib "
        "(Debian) or matplotlib (pip). Tables and pictures are written all the same, and "
        "benchmarks/plot/plot.py draws the charts of a --json file on any machine");
  const bool needsFlip = std::any_of(parts.begin(), parts.end(), [](const ChosenPart& chosen) {
    return chosen.part == "techniques" || chosen.part == "screen";
  });
  if (needsFlip && !benchmarks::canMeasureFlip())
    session.warn("FLIP will be left out: no Python here has flip-evaluator; install it with pip");
}

void writeCharts(const std::filesystem::path& folder, const BenchReport& report, const Console& console) {
  if (!benchmarks::canDrawCharts()) return;
  for (const std::filesystem::path& file : benchmarks::drawCharts(report.json(), folder))
    console.line("wrote", file.string());
}

/// Throws an error that lists the bounds that were not kept. Called after all outputs are written.
void checkBounds(const std::vector<std::string>& broken) {
  if (broken.empty()) return;
  throw Error(
      ExitCode::RuntimeFailure, "bench stability",
      fmt::format("{} bounds of this suite are broken:\n  {}", broken.size(), fmt::join(broken, "\n  ")),
      "docs/notes/stability.md explains the bounds");
}

RunOptions runOptionsOf(const BenchCommand& command, const std::vector<ChosenPart>& parts) {
  RunOptions options = command.quick ? RunOptions::quickRun() : RunOptions();
  options.skies = command.skies;
  options.folder = command.plots;
  options.truths = command.truths;
  options.onlyCase = command.onlyCase;
  options.program = std::filesystem::read_symlink("/proc/self/exe");
  options.suiteSeconds = command.seconds.value_or(options.suiteSeconds);
  options.given = {command.rays, command.samples, command.photons,
                   {},           command.models,  givenOptions(command.options, parts)};
  if (const auto& size = command.size)
    options.given.size = {size->width.value_or(size->height * 16 / 9), size->height};
  return options;
}

/// Measures the parts in their order. Results reach the report as each case ends. Returns a sentence for each
/// bound that results broke.
std::vector<std::string> measure(const std::vector<ChosenPart>& parts, const Device& device, Session& session,
                                 BenchReport& report) {
  std::vector<std::string> broken;
  for (const auto& [suite, part] : parts) {
    benchmarks::SuiteRun run(session.progress(), [&, &suite = suite, &part = part](auto measured) {
      session.progress().clear();
      std::vector<BenchmarkResult> named(measured.begin(), measured.end());
      for (BenchmarkResult& result : named) {
        result.case_ = suite->casePrefix(part) + result.case_;
        printResult(session.console(), suite->name(), result);
      }
      report.add(suite->name(), named);
    });
    suite->run(part, device, run);
    run.finish();
    report.finish(part);
    const std::vector<std::string> more = suite->brokenBounds(run.results());
    broken.insert(broken.end(), more.begin(), more.end());
    session.progress().clear();
  }
  return broken;
}

/// Prints the options of the suites of some parts: values in usual and quick runs, meaning, possible values.
void listOptions(const std::vector<ChosenPart>& parts, const Console& console) {
  const Suite* last = nullptr;
  for (const ChosenPart& chosen : parts) {
    if (chosen.suite == last) continue;
    last = chosen.suite;
    for (const benchmarks::OptionText& option : last->options())
      console.line(last->name(), fmt::format("{:<22} {} (quick: {}): {}; {}", option.name, option.usual,
                                             option.quick, option.help, option.values));
  }
}

void runBench(const BenchCommand& command, Context& context) {
  Session session(context);
  const Suites suites = benchmarks::makeSuites();
  std::vector<ChosenPart> parts = chosenParts(command.suite, suites);
  if (command.list) return listOptions(parts, session.console());
  checkBenchOutputs(command, suites);
  const RunOptions options = runOptionsOf(command, parts);
  for (const ChosenPart& chosen : parts) chosen.suite->configure(options);
  parts = partsWithCases(parts, command.onlyCase);
  const Device device = Device::open(session.deviceOptions());
  if (!command.plots.empty()) makeOutputFolder("--plot", command.plots);
  if (!command.truths.empty()) makeOutputFolder("--truths", command.truths);
  warnOfMissingPython(command, parts, session);
  const StopSignals::SafePoints safePoints(context.signals);  // suites write files of their own
  BenchReport report(command.json, parts, options, device.info());
  if (!command.json.empty()) context.signals.setParting(fmt::format("prelight: {}", measuredBefore));
  session.console().line("device", device.info().name);
  const std::string peer = benchmarks::embreeVersion();
  session.console().line("ray peer", peer.empty() ? "none: built without Embree (libembree-dev)" : peer);
  std::exception_ptr stopped;
  std::vector<std::string> broken;
  try {
    broken = measure(parts, device, session, report);
  } catch (const Interrupted&) {
    stopped = std::make_exception_ptr(Interrupted(measuredBefore));
  }
  if (!command.json.empty()) session.console().line("wrote", command.json.string());
  if (!command.plots.empty()) writeCharts(command.plots, report, session.console());
  if (stopped) std::rethrow_exception(stopped);
  session.console().json(report.json());
  checkBounds(broken);
}

/// Returns a line per suite, followed by its parts if it has several.
std::string suitesText() {
  std::string text = "Suites, and parts of them that can be run alone:\n";
  for (const std::unique_ptr<Suite>& suite : benchmarks::makeSuites()) {
    text += fmt::format("  {:<16}{}\n", suite->name(), suite->description());
    if (suite->parts().size() == 1) continue;
    for (const Suite::Part& part : suite->parts())
      text += fmt::format("    {:<14}{}\n", part.name, part.description);
  }
  return text;
}

void addEffortOptions(CLI::App& app, const std::shared_ptr<BenchCommand>& command) {
  addRealNumber(
      app, "--time", {leastSeconds, mostSeconds}, [command](double value) { command->seconds = value; },
      "approximate seconds that each of `viewer`, `gather` and `techniques` takes (default 540). Cases share "
      "the time, and slow ones are repeated less often");
  app.add_option("--truths", command->truths,
                 "folder that keeps the path-traced pictures of `techniques`; later runs add samples to them")
      ->type_name("DIR");
  addWholeNumber(
      app, "--rays", {1, BakeRequest::maxRays}, [command](std::uint64_t n) { command->rays = n; },
      "rays per vertex of `objects`, `materials` and `techniques` (default 10000; its scenes of many "
      "vertices "
      "have at most 1024)");
  addWholeNumber(
      app, "--spp", {1, maxTruthSamples}, [command](std::uint64_t n) { command->samples = n; },
      "largest number of samples per pixel of each part of the path-traced pictures of `techniques` (default "
      "65536; a picture ends earlier if it is exact enough or the scene's share of --time is spent), and "
      "samples per pixel of those of `objects` and `materials` (default 512)");
  addWholeNumber(
      app, "--photons", {1, maxPhotons}, [command](std::uint64_t n) { command->photons = n; },
      "photons that fly through each room of `stability` (default 65536)");
  addPictureSize(
      app, "--size", [command](PictureSize size) { command->size = size; },
      "pixels of the pictures of `techniques`, `objects` (default 240x135), `materials` (160x120) and "
      "`viewer` (640x360 and 1280x720); one number is the height");
}

void addBenchCommand(CLI::App& program, Context& context) {
  const auto command = std::make_shared<BenchCommand>();
  CLI::App* app = program.add_subcommand("bench", "Measure speed and error on built-in scenes");
  app->add_option("SUITE", command->suite, "a suite or a part of one (default: every suite)")->type_name("");
  // Shadows the global flag of the same name, which has the same meaning as --json without FILE.
  CLI::Option* json = app->add_option("--json", command->json, "write the results; without FILE, to stdout")
                          ->type_name("[FILE]")
                          ->expected(0, 1);
  app->add_option("--plot", command->plots,
                  "write charts (.svg, drawn by Python's matplotlib), and the tables and pictures of "
                  "`techniques`, `screen` and `stability`")
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
         "contain this text. A case of `bake-scaling` that is named in full runs however long it takes")
      ->type_name("TEXT");
  addEffortOptions(*app, command);
  app->add_option("--set", command->options,
                  "set an option of a suite that --list shows; repeat it for more options. Elements of lists "
                  "have commas between them: --set rayTriangles=1000,20000")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  app->add_flag("--quick", command->quick,
                "run for seconds only, to see that everything works; such numbers mean nothing");
  app->add_flag(
      "--list", command->list,
      "list the options of the suite with their values in usual and quick runs, and measure nothing");
  app->footer(suitesText() +
              "\nExamples:\n"
              "  prelight bench\n"
              "  prelight bench tracing --json tracing.json --plot plots\n"
              "  prelight bench cast --json cast.json\n"
              "  prelight bench rays --set rayTriangles=100000 --set rayRounds=6\n"
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
