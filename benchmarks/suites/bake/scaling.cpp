#include "benchmarks/suites/bake/scaling.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "bake/make_plan.h"
#include "benchmarks/peers/embree/ray_peer.h"
#include "benchmarks/run/measure.h"
#include "benchmarks/scenes/detailed_scene.h"
#include "benchmarks/suites/bake/bake_suite.h"
#include "benchmarks/suites/bake/scaling_peers.h"
#include "prelight/error.h"
#include "prelight/progress.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"

namespace prelight::benchmarks {

namespace {

/// A bake in a separate process, so that time and memory are those of the bake alone.
struct BakeProcess {
  std::filesystem::path program;  ///< `prelight`
  std::filesystem::path scene;
  std::filesystem::path output;
  std::vector<std::string> options;  ///< arguments of `prelight bake`: techniques and effort
};

/// Time and results of a BakeProcess.
struct ProcessCost {
  bool finished = false;          ///< false: a signal ended it, as happens when memory is short
  double seconds = 0.0;           ///< from start to end
  double processorSeconds = 0.0;  ///< processor time of all its threads
  nlohmann::ordered_json report;  ///< the file of `--report`; null where it did not finish
  std::uint64_t outputBytes = 0;
};

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds pollInterval{5};
constexpr std::size_t shownOutput = 2000;  // characters of the output in an error message
constexpr int cannotStart = 127;           // as in shells

std::string textOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> argumentsOf(const BakeProcess& bake, const std::filesystem::path& report) {
  std::vector<std::string> arguments = {bake.program, "bake",     bake.scene, "-o",
                                        bake.output,  "--report", report,     "--quiet"};
  arguments.insert(arguments.end(), bake.options.begin(), bake.options.end());
  return arguments;
}

/// Runs in the new process, where only functions that are safe in signal handlers may be called.
[[noreturn]] void become(char* const* arguments, const char* log) {
  if (const int score = open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC); score >= 0) {
    const ssize_t written = write(score, "1000", 4);
    if (written < 0) close(score);  // only makes it likelier that this process is ended when memory is short
  }
  if (const int output = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0600); output >= 0) {
    dup2(output, STDOUT_FILENO);
    dup2(output, STDERR_FILENO);
  }
  execv(arguments[0], arguments);
  _exit(cannotStart);
}

pid_t start(const std::vector<std::string>& arguments, const std::filesystem::path& log) {
  std::vector<char*> pointers;
  for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
  pointers.push_back(nullptr);
  const pid_t process = fork();
  if (process == 0) become(pointers.data(), log.c_str());
  if (process < 0)
    throw Error(ExitCode::RuntimeFailure, arguments.front(),
                fmt::format("cannot start it: {}", std::generic_category().message(errno)));
  return process;
}

/// Waits for a process and returns its status.
int await(pid_t process, const Progress& progress, rusage& usage) {
  int status = 0;
  bool stopped = false;
  for (;;) {
    const pid_t ended = wait4(process, &status, stopped ? 0 : WNOHANG, &usage);
    if (ended == process) break;
    if (!stopped && progress.stopRequested()) {
      kill(process, SIGTERM);
      stopped = true;
    }
    if (ended == 0) std::this_thread::sleep_for(pollInterval);
  }
  if (stopped) throw Interrupted();
  return status;
}

double secondsIn(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Runs a bake to its end. If memory is short, the system ends the bake before this process. Throws
/// Interrupted after ending the bake, and Error with the end of its output if it fails.
ProcessCost runBakeProcess(const BakeProcess& bake, const Progress& progress) {
  const std::filesystem::path report = bake.output.string() + ".json", log = bake.output.string() + ".log";
  const std::vector<std::string> arguments = argumentsOf(bake, report);
  rusage usage{};
  const Clock::time_point begin = Clock::now();
  const int status = await(start(arguments, log), progress, usage);
  ProcessCost cost;
  cost.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  cost.processorSeconds = secondsIn(usage.ru_utime) + secondsIn(usage.ru_stime);
  cost.finished = WIFEXITED(status);
  if (!cost.finished) return cost;
  if (const int code = WEXITSTATUS(status); code != 0) {
    const std::string printed = textOf(log);
    throw Error(ExitCode::RuntimeFailure, fmt::format("{}", fmt::join(arguments, " ")),
                fmt::format("it ended with exit code {}:\n{}", code,
                            printed.substr(printed.size() - std::min(printed.size(), shownOutput))));
  }
  cost.report = nlohmann::ordered_json::parse(textOf(report));
  cost.outputBytes = std::filesystem::file_size(bake.output);
  return cost;
}

struct Technique {
  const char* options;
  int shOrder;
  int bounces;
};

constexpr std::array<Technique, 2> techniques = {{{"--ao", 0, 0}, {"--ao --sh 3 --bounces 1", 3, 1}}};

/// Rays per vertex with which every size is measured.
constexpr std::uint64_t commonRays = 64;

bool isWanted(const ScalingCase& some, std::uint64_t vertices, const BakeOptions& options) {
  if (some.name() == options.onlyCase) return true;
  const bool affordable = some.rays == commonRays || some.rays * vertices <= options.scalingMostRays;
  return affordable && some.name().find(options.onlyCase) != std::string::npos;
}

}  // namespace

std::string ScalingCase::name() const { return fmt::format("{}/{}/{} rays", scene, technique, rays); }

std::vector<std::string> ScalingCase::options() const {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < technique.size();) {
    const std::size_t end = std::min(technique.find(' ', at), technique.size());
    words.push_back(technique.substr(at, end - at));
    at = end + 1;
  }
  words.insert(words.end(), {"--rays", std::to_string(rays)});
  return words;
}

std::vector<ScalingCase> scalingCases(const std::string& scene, std::uint64_t vertices,
                                      const BakeOptions& options) {
  std::vector<ScalingCase> cases;
  for (const Technique& technique : techniques)
    for (const std::uint64_t rays : options.scalingRays) {
      ScalingCase some{scene, technique.options, rays, aoRequest(rays, 0)};
      some.request.sh.order = technique.shOrder;
      some.request.bounces = technique.bounces;
      if (isWanted(some, vertices, options)) cases.push_back(std::move(some));
    }
  return cases;
}

double bakeSeconds(const nlohmann::ordered_json& report) {
  const std::set<std::string> before = {"load", "compile", "plan", "device"};
  double seconds = 0.0;
  for (const auto& stage : report.at("stages").items())
    if (!before.contains(stage.key())) seconds += stage.value().get<double>();
  return seconds;
}

double bakeProcessorSeconds(const nlohmann::ordered_json& report) {
  double seconds = 0.0;
  for (const auto& part : report.at("processorSeconds").items()) seconds += part.value().get<double>();
  return seconds;
}

double powerOf(std::vector<Point> points) {
  for (Point& p : points) p = {std::log(p.x), std::log(p.y)};
  return fitLine(points).slope;
}

namespace {

constexpr int tracingRounds = 2;
constexpr std::uint64_t smallScene = 2000;  // triangles of bakes that only warm up
constexpr std::uint64_t fewRays = 16;       // rays per vertex of those

/// Returns the memory that a bake may use besides its output, bytes.
double memoryBound(double triangles) { return 400.0 * triangles + 300e6; }

struct MeasuredCase {
  ScalingCase some;
  TracingCost tracing;  ///< cost of tracing some of the bake's rays
  std::vector<ProcessCost> runs = {};
};

/// Returns the median over runs of one of their numbers.
template <typename Value>
double medianOf(const std::vector<ProcessCost>& runs, const Value& value) {
  std::vector<double> values;
  for (const ProcessCost& run : runs) values.push_back(value(run));
  return median(values);
}

constexpr const char* smallRoom = "cornell";

std::string ballsOf(std::uint64_t triangles) { return "balls " + sizeName(triangles); }

class ScalingRun {
 public:
  ScalingRun(const Device& device, const BakeOptions& options, SuiteRun& run)
      : device_(device), options_(options), progress_(run), results_(run.results()) {}

  void run() {
    StepCounter steps(progress_, "bench bake-scaling", 1 + options_.scalingTriangles.size());
    measure(
        smallRoom, [] { return makeBuiltinScene("cornell"); }, true);
    steps.advance();
    stages_.clear();  // loading is not one of the stages that grow
    const std::vector<std::uint64_t>& compared = options_.peerTriangles;
    for (const std::uint64_t triangles : options_.scalingTriangles) {
      measure(
          ballsOf(triangles), [&] { return makeBumpyBalls(triangles); },
          std::find(compared.begin(), compared.end(), triangles) != compared.end());
      steps.advance();
    }
    addPowers();
  }

 private:
  struct StagePoint {
    std::string series;  ///< "--ao/64 rays"
    std::string stage;
    Point point;
  };

  /// `compares`: also measures errors, and compares them with those of another baker.
  void measure(const std::string& scene, const std::function<GltfDocument()>& make, bool compares) {
    if (scalingCases(scene, 0, options_).empty()) return;
    writeGlb(folder_ / "scene.glb", make());
    std::vector<MeasuredCase> cases;
    double triangles = 0.0;
    {  // This block frees the scene before the bakes run.
      Warnings warnings;
      const CompiledScene compiled =
          compileScene(loadScene(readGltf(folder_ / "scene.glb", warnings), warnings), warnings);
      triangles = compiled.triangleCount();
      cases = traced(scene, compiled);
    }
    std::vector<FinishedBake> finished;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const std::filesystem::path file = folder_ / fmt::format("baked-{}.glb", compares ? i : 0);
      bake(cases[i], file);
      if (cases[i].runs.empty()) continue;
      report(cases[i], triangles);
      finished.push_back(finishedBake(cases[i], file));
    }
    if (!compares) return;
    const std::vector<BenchmarkResult> compared =
        compareWithVertexBaker(scene, finished, peerThreads(device_.info()), options_, progress_);
    results_.insert(results_.end(), compared.begin(), compared.end());
  }

  /// Returns the bake with its time without writing the file.
  static FinishedBake finishedBake(const MeasuredCase& measured, const std::filesystem::path& file) {
    const auto less = [](double all, const nlohmann::ordered_json& part) {
      return all - part.at("write").get<double>();
    };
    return {measured.some.name(), measured.some.technique, file,
            medianOf(measured.runs,
                     [&](const ProcessCost& run) {
                       return less(bakeSeconds(run.report), run.report.at("stages"));
                     }),
            medianOf(measured.runs, [&](const ProcessCost& run) {
              return less(bakeProcessorSeconds(run.report), run.report.at("processorSeconds"));
            })};
  }

  std::vector<MeasuredCase> traced(const std::string& scene, const CompiledScene& compiled) {
    Tracer tracer(compiled, device_);
    std::vector<MeasuredCase> cases;
    for (const ScalingCase& some : scalingCases(scene, compiled.vertexCount(), options_))
      cases.push_back({some, traceRaysAlone(compiled, some.request, tracer, options_.scalingTracedRays,
                                            tracingRounds, StopOnly(progress_))});
    return cases;
  }

  BakeProcess processOf(const ScalingCase& some, const char* scene, const std::filesystem::path& file) const {
    BakeProcess process{options_.program, folder_ / scene, file, some.options()};
    process.options.insert(process.options.end(), {"--device", std::to_string(device_.info().index)});
    return process;
  }

  /// Bakes a small scene so that the kernels of a technique are compiled and cached.
  void warm(ScalingCase some, const Progress& stop) {
    if (std::find(warm_.begin(), warm_.end(), some.technique) != warm_.end()) return;
    if (warm_.empty()) writeGlb(folder_ / "small.glb", makeBumpyBalls(smallScene));
    warm_.push_back(some.technique);
    some.rays = fewRays;
    runBakeProcess(processOf(some, "small.glb", folder_ / "small-baked.glb"), stop);
  }

  void bake(MeasuredCase& measured, const std::filesystem::path& file) {
    const StopOnly stop(progress_);
    warm(measured.some, stop);
    const BakeProcess process = processOf(measured.some, "scene.glb", file);
    ProcessCost cost = runBakeProcess(process, stop);
    if (!cost.finished) return leaveOut(measured);
    const int runs =
        cost.report.at("rays").get<std::uint64_t>() < options_.scalingLongBake ? options_.runs : 1;
    measured.runs.push_back(std::move(cost));
    while (static_cast<int>(measured.runs.size()) < runs)
      measured.runs.push_back(runBakeProcess(process, stop));
  }

  void leaveOut(const MeasuredCase& measured) {
    add(measured.some.name(), "ended for want of memory", 1.0, "bakes");
  }

  void report(const MeasuredCase& measured, double triangles) {
    const std::vector<ProcessCost>& runs = measured.runs;
    const ProcessCost& last = runs.back();
    const auto rays = last.report.at("rays").get<double>();
    const double share = rays / static_cast<double>(measured.tracing.rays);
    const double alone = share * measured.tracing.seconds;
    const double whole = medianOf(runs, [](const ProcessCost& run) { return run.seconds; });
    const double bake = medianOf(runs, [](const ProcessCost& run) { return bakeSeconds(run.report); });
    const double bakeProcessor =
        medianOf(runs, [](const ProcessCost& run) { return bakeProcessorSeconds(run.report); });
    const std::string name = measured.some.name(), peer = "its rays alone";
    add(name, "whole", whole, "s", peer, alone / whole);
    for (const std::string& stage : stagesOf(last))
      addStage(measured.some, stage, triangles, medianOf(runs, [&](const ProcessCost& run) {
                 return run.report.at("stages").value(stage, 0.0);
               }));
    add(name, "prepare to write", bake, "s", peer, alone / bake);
    add(name, "processor", bakeProcessor, "s", peer,
        share * measured.tracing.processorSeconds / bakeProcessor);
    add(name, "cores busy", bakeProcessor / bake, "cores");
    add(name, "rays", rays, "rays");
    add(name, "rays alone", alone, "s");
    reportMemory(name, last, triangles);
  }

  void reportMemory(const std::string& name, const ProcessCost& run, double triangles) {
    const auto& memory = run.report.at("memory");
    double estimate = memory.at("hostEstimate").get<double>();
    if (device_.info().kind == DeviceKind::Cpu) estimate += memory.at("deviceEstimate").get<double>();
    const auto peak = memory.at("peakResident").get<double>();
    const auto output = static_cast<double>(run.outputBytes);
    add(name, "peak memory", peak, "bytes", "the plan's estimate", estimate / peak);
    add(name, "memory beyond the output", peak - output, "bytes", "400 bytes per triangle and 300 MB",
        memoryBound(triangles) / (peak - output));
    add(name, "output", output, "bytes");
  }

  static std::vector<std::string> stagesOf(const ProcessCost& run) {
    std::vector<std::string> stages;
    for (const auto& stage : run.report.at("stages").items()) stages.push_back(stage.key());
    return stages;
  }

  void addStage(const ScalingCase& some, const std::string& stage, double triangles, double seconds) {
    add(some.name(), stage, seconds, "s");
    if (seconds > 0.0)
      stages_.push_back({fmt::format("{}/{} rays", some.technique, some.rays), stage, {triangles, seconds}});
  }

  /// Adds, for every stage measured at two or more sizes, the exponent with which its time grows with
  /// triangles.
  void addPowers() {
    while (!stages_.empty()) {
      const StagePoint first = stages_.front();
      std::vector<Point> points;
      std::erase_if(stages_, [&](const StagePoint& other) {
        const bool same = other.series == first.series && other.stage == first.stage;
        if (same) points.push_back(other.point);
        return same;
      });
      if (points.size() > 1)
        add("growth/" + first.series, first.stage, powerOf(points), "power of triangles");
    }
  }

  void add(const std::string& name, const std::string& metric, double value, const std::string& unit,
           const std::string& peer = {}, std::optional<double> ratio = {}) {
    results_.push_back({name, metric, value, unit, peer, ratio});
  }

  const Device& device_;
  const BakeOptions& options_;
  Progress& progress_;
  WorkFolder folder_;
  std::vector<std::string> warm_;  ///< techniques that have been baked
  std::vector<StagePoint> stages_;
  std::vector<BenchmarkResult>& results_;
};

}  // namespace

bool hasBakeScalingCase(const BakeOptions& options) {
  std::vector<std::string> scenes = {smallRoom};
  for (const std::uint64_t triangles : options.scalingTriangles) scenes.push_back(ballsOf(triangles));
  return std::any_of(scenes.begin(), scenes.end(),
                     [&](const std::string& scene) { return !scalingCases(scene, 0, options).empty(); });
}

void runBakeScaling(const Device& device, const BakeOptions& options, SuiteRun& run) {
  if (!hasBakeScalingCase(options))
    throw UsageError("--case " + options.onlyCase, "no case of `bake-scaling` has such a name",
                     "they are like \"balls 100k/--ao/64 rays\"");
  if (options.program.empty())
    throw UsageError("BakeOptions::program", "bake-scaling runs the program, and none is named",
                     "name the built `prelight`");
  ScalingRun(device, options, run).run();
}

}  // namespace prelight::benchmarks
