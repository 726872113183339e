#include "benchmarks/suites/techniques/techniques_suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <tuple>

#include "benchmarks/run/measure.h"
#include "benchmarks/suites/techniques/technique_trial.h"
#include "viewer/gl/egl_context.h"

namespace prelight::benchmarks {

namespace {

using Techniques = std::vector<Technique>;

/// Time for frames by the number of lights, relative to that of a scene.
constexpr double curveWeight = 0.3;

void addResults(const SceneComparison& scene, std::vector<BenchmarkResult>& results) {
  for (const TechniqueResult& row : scene.techniques) {
    const auto add = [&](const char* metric, double value, const char* unit, double thesis,
                         bool lessIsBetter) {
      BenchmarkResult result{fmt::format("{}/{}", scene.name, row.name), metric, value, unit, {}, {}};
      if (scene.name.ends_with("shapes") && thesis > 0.0 && value > 0.0) {
        result.peer = fmt::format("thesis {:g}", thesis);
        result.ratio = lessIsBetter ? thesis / value : value / thesis;
      }
      results.push_back(std::move(result));
    };
    const ThesisRow then = row.thesis.value_or(ThesisRow{0, 0, 0, 0});
    if (row.firstPass > 0.0) add("pass 1", row.firstPass, "s", then.firstPass, true);
    if (row.secondPass > 0.0) add("pass 2", row.secondPass, "s", then.secondPass, true);
    add("storage", static_cast<double>(row.bytes), "B", then.megabytes * 1e6, true);
    add("frames", 1.0 / row.frameSeconds, "1/s", then.frames, false);
    add("processor time of a frame", row.frameProcessorSeconds, "s", 0.0, true);
    add("RMSE", row.error.rmse, "W/(m2 sr)", 0.0, true);
    add("standard error of RMSE", row.error.standardError, "W/(m2 sr)", 0.0, true);
    add("RMSE of its claim", row.ofClaim.rmse, "W/(m2 sr)", 0.0, true);
    add("claim", row.claim, "segments", 0.0, true);
    add("rank", row.rank, "", 0.0, true);
    if (row.flip) add("FLIP", *row.flip, "1", 0.0, true);
  }
  const std::string truth = scene.name + "/path traced";
  results.push_back({truth, "time", scene.truth.seconds, "s", {}, {}});
  results.push_back({truth, "standard error", scene.truth.rmse, "W/(m2 sr)", {}, {}});
  const TruthShare share = truthShare(scene);
  results.push_back({truth, "over the best technique's", share.picture, "1", {}, {}});
  results.push_back({truth, "left in the best technique's", share.left, "1", {}, {}});
}

std::vector<std::string> notesOn(const TechniqueReport& report) {
  std::vector<std::string> notes = {
      "AO, SSAO, HBAO, GTAO and disks occlude light of the sky alone: under point lights they are Phong.",
      "Wavelets and glossy matrices (SS of SH and CH) take a point light outside the scene for one at "
      "infinity, as seen from "
      "the scene's middle; SH and CH of diffuse surfaces see it from every vertex."};
  for (const SceneComparison& scene : report.scenes)
    if (const double left = truthShare(scene).left; left > wantedShare)
      notes.push_back(
          fmt::format("{}: the truth's noise leaves {:.2f} of the best technique's error in doubt, more than "
                      "{:g}: give --time more.",
                      scene.name, left, wantedShare));
  return notes;
}

Environment skyOf(const TechniquesOptions& options) {
  return options.skies.empty() ? makeEveningSky(options.skyRows) : readEnvironment(options.skies.front());
}

/// Returns the number of objects of half a crowd.
int halfOf(const TechniquesOptions& options) { return (options.objects + 1) / 2; }

struct Comparison {
  const char* name;
  ComparedScene (*make)(const TechniquesOptions&);
  unsigned kind;  ///< one of the constants of compared
  bool asThesis;  ///< uses as many rays as the thesis
};

constexpr std::array<Comparison, 7> comparisons = {
    {{"shapes", [](const TechniquesOptions&) { return makeShapes(); }, compared::lamps, true},
     {"shiny shapes", [](const TechniquesOptions&) { return makeShinyShapes(); }, compared::mirrors, true},
     {"crowd", [](const TechniquesOptions& o) { return makeCrowd(o.objects, o.lights); }, compared::lamps,
      false},
     {"crowd under a sky", [](const TechniquesOptions& o) { return makeCrowdUnder(skyOf(o), halfOf(o)); },
      compared::sky, false},
     {"crowd with an object put in",
      [](const TechniquesOptions& o) { return makeCrowdWithObject(skyOf(o), halfOf(o)); }, compared::volume,
      false},
     {"cornell", [](const TechniquesOptions&) { return makeRoom(); }, compared::room, false},
     {"rooms by area lights", [](const TechniquesOptions&) { return makeRoomsByAreaLights(); },
      compared::areaLamps, false}}};

}  // namespace

void runTechniques(const Device& device, const TechniquesOptions& options, SuiteRun& run) {
  const Techniques all = comparedTechniques(options.order, options.haarSize);
  const Techniques few = techniquesOn(compared::curve, all);
  const viewer::gl::EglContext context;
  std::size_t count = few.size() + 1;
  std::vector<Comparison> chosen;
  for (const Comparison& comparison : comparisons) {
    const auto& names = options.scenes;
    if (std::find(names.begin(), names.end(), comparison.name) == names.end()) continue;
    chosen.push_back(comparison);
    count += techniquesOn(comparison.kind, all).size() + 1;
  }
  StepCounter steps(run, "bench techniques", count);
  TechniqueReport report;
  report.where = fmt::format("{} ({} compute units), {}", device.info().name, device.info().computeUnits,
                             device.info().platform);
  warmUp(all, device, run);
  const std::uint64_t fewerRays = std::min(options.rays, options.crowdRays);
  TimeShares shares(options.suiteSeconds, static_cast<double>(chosen.size()) + curveWeight);
  std::vector<BenchmarkResult>& results = run.results();
  for (const Comparison& comparison : chosen) {
    const double seconds = shares.next();
    const Deadline end(seconds);
    const ComparedScene scene = comparison.make(options);
    const Techniques techniques = techniquesOn(comparison.kind, all);
    TechniqueTrial trial(scene, techniques, comparison.asThesis ? options.rays : fewerRays, device, options,
                         run, steps);
    report.scenes.push_back(trial.compare(end, seconds));
    addResults(report.scenes.back(), results);
    report.notes = notesOn(report);
    if (!options.folder.empty()) writeTechniqueReport(options.folder, report);
    steps.advance();
  }
  const ComparedScene shinyShapes = makeShinyShapes();
  TechniqueTrial curve(shinyShapes, few, fewerRays, device, options, run, steps);
  report.framesByLights = curve.framesByLights(options.lightCounts);
  report.curveScene = shinyShapes.scene.name;
  steps.advance();
  for (const FrameCurve& technique : report.framesByLights)
    for (const Point& point : technique.points)
      results.push_back({fmt::format("lights/{}, {:g} lights", technique.technique, point.x),
                         "frames",
                         point.y,
                         "1/s",
                         {},
                         {}});
  if (!options.folder.empty()) writeTechniqueReport(options.folder, report);
}

const OptionTable<TechniquesOptions>& TechniquesOptions::table() {
  static const OptionTable<TechniquesOptions> table =
      OptionTable<TechniquesOptions>()
          .add("scenes", &TechniquesOptions::scenes,
               {"shapes", "shiny shapes", "crowd", "crowd under a sky", "crowd with an object put in",
                "cornell", "rooms by area lights"},
               {"shapes", "crowd under a sky", "cornell"}, "scenes that are compared")
          .add("rays", &TechniquesOptions::rays, 10000, 8, "rays per vertex of scenes of the thesis' size")
          .add("crowdRays", &TechniquesOptions::crowdRays, 1024,
               "largest number of rays per vertex of other scenes")
          .add("order", &TechniquesOptions::order, 6, 3, "largest order of SH and CH", {.most = 32})
          .add("haarSize", &TechniquesOptions::haarSize, 32, 4,
               "texels per side of a face of wavelets' cube maps",
               {.least = 4, .most = 512, .powerOfTwo = true})
          .add("width", &TechniquesOptions::width, 240, 32, "width of the pictures, pixels", {.most = 8192})
          .add("height", &TechniquesOptions::height, 135, 18, "height of the pictures, pixels",
               {.most = 8192})
          .add("samples", &TechniquesOptions::samples, 1u << 16, 4,
               "largest number of samples per pixel of the path-traced pictures")
          .add("frames", &TechniquesOptions::frames, 9, 1,
               "frames of each technique; the median of their times counts")
          .add("objects", &TechniquesOptions::objects, 25, 2, "objects of the crowd")
          .add("lights", &TechniquesOptions::lights, 20, 2, "lights of the crowd")
          .add("skyRows", &TechniquesOptions::skyRows, 256, 16, "rows of the sky where --env gives none",
               {.least = 2, .most = 16384})
          .add("lightCounts", &TechniquesOptions::lightCounts, {1, 2, 4, 8, 16, 32}, {1, 2, 3},
               "numbers of lights at which frames per second are measured");
  return table;
}

void TechniquesOptions::takeGiven() {
  rays = given.rays.value_or(rays);
  samples = given.samples.value_or(samples);
  if (given.size) std::tie(width, height) = *given.size;
}

std::unique_ptr<Suite> techniquesSuite() {
  SuiteOf<TechniquesOptions>::Runners parts = {
      {"techniques", "seconds, bytes, frames and errors of every technique, against path-traced pictures",
       runTechniques},
  };
  return std::make_unique<SuiteOf<TechniquesOptions>>(
      "techniques", "every technique compared, against path-traced pictures", std::move(parts));
}

}  // namespace prelight::benchmarks
