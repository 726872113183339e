#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "benchmarks/measure.h"
#include "benchmarks/suites.h"
#include "benchmarks/technique_report.h"
#include "viewer/gl/egl_context.h"

namespace prelight::benchmarks {

namespace {

using Techniques = std::vector<Technique>;

/// What scenes of few mirrors are compared with; bakes tell whether there are any.
Techniques diffuse(const Techniques& all) {
  Techniques chosen;
  std::copy_if(all.begin(), all.end(), std::back_inserter(chosen), [](const Technique& technique) {
    return !technique.specular || technique.shading == viewer::Shading::Vo;
  });
  return chosen;
}

/// What mirrors are compared with, and two that know none.
Techniques specular(const Techniques& all) {
  Techniques chosen;
  std::copy_if(all.begin(), all.end(), std::back_inserter(chosen), [](const Technique& technique) {
    return technique.specular || technique.name == "Phong" || technique.name == "VO/DD";
  });
  return chosen;
}

/// Those of the thesis' Figure 7.21.
Techniques curveOf(const Techniques& all) {
  Techniques chosen;
  std::copy_if(all.begin(), all.end(), std::back_inserter(chosen), [](const Technique& technique) {
    return technique.name == "Phong" || technique.name == "VO/DD" || technique.name == "VO/DD+DS+SS";
  });
  return chosen;
}

void addResults(const SceneComparison& scene, std::vector<BenchmarkResult>& results) {
  for (const TechniqueResult& row : scene.techniques) {
    const auto add = [&](const char* metric, double value, const char* unit, double thesis,
                         bool lessIsBetter) {
      BenchmarkResult result{
          "techniques", fmt::format("{}/{}", scene.name, row.name), metric, value, unit, {}, {}};
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
    add("RMSE", row.rmse, "W/(m2 sr)", 0.0, true);
    add("FLIP", row.flip, "1", 0.0, true);
  }
  const std::string truth = scene.name + "/path traced";
  results.push_back({"techniques", truth, "time", scene.truth.seconds, "s", {}, {}});
  results.push_back({"techniques", truth, "standard error", scene.truth.rmse, "W/(m2 sr)", {}, {}});
}

std::vector<std::string> notesOn(const TechniqueReport& report) {
  std::vector<std::string> notes = {
      "AO, SSAO, HBAO and GTAO occlude light of the sky alone: under point lights they are Phong.",
      "Wavelets and glossy matrices (SS of SH and CH) take a point light outside the scene for one at "
      "infinity, as seen from "
      "the scene's middle; SH and CH of diffuse surfaces see it from every vertex."};
  const auto shown = [&](const std::string& name) {
    for (const SceneComparison& scene : report.scenes)
      for (const TechniqueResult& row : scene.techniques)
        if (row.name == name) return true;
    return false;
  };
  if (!shown("Radiosity")) notes.emplace_back("Radiosity: this version has none.");
  if (!shown("VO/DD+DS+SS")) notes.emplace_back("VO/DD+DS+SS: this version stores no specular vectors.");
  return notes;
}

ComparedScene underSky(const BenchmarkOptions& options) {
  const int objects = (options.techniqueObjects + 1) / 2;
  if (options.skies.empty()) return makeCrowdUnder(makeEveningSky(options.techniqueSkyRows), objects);
  return makeCrowdUnder(readEnvironment(options.skies.front()), objects);
}

struct Comparison {
  const char* name;
  ComparedScene (*make)(const BenchmarkOptions&);
  Techniques (*choose)(const Techniques&);
  bool asThesis;  ///< in its number of rays
};

constexpr std::array<Comparison, 4> comparisons = {
    {{"shapes", [](const BenchmarkOptions&) { return makeShapes(); }, diffuse, true},
     {"shiny shapes", [](const BenchmarkOptions&) { return makeShinyShapes(); }, specular, true},
     {"crowd", [](const BenchmarkOptions& o) { return makeCrowd(o.techniqueObjects, o.techniqueLights); },
      diffuse, false},
     {"crowd under a sky", underSky, diffuse, false}}};

}  // namespace

std::vector<BenchmarkResult> runTechniquesSuite(const Device& device, const BenchmarkOptions& options,
                                                Progress& progress) {
  const Techniques all = comparedTechniques(options.techniqueOrder, options.techniqueHaarSize);
  const Techniques few = curveOf(all);
  const viewer::gl::EglContext context;
  std::size_t count = few.size() + 1;
  std::vector<Comparison> chosen;
  for (const Comparison& comparison : comparisons) {
    const auto& names = options.techniqueScenes;
    if (std::find(names.begin(), names.end(), comparison.name) == names.end()) continue;
    chosen.push_back(comparison);
    count += comparison.choose(all).size() + 1;
  }
  StepCounter steps(progress, "bench techniques", count);
  TechniqueReport report;
  report.where = fmt::format("{} ({} compute units), {}", device.info().name, device.info().computeUnits,
                             device.info().platform);
  warmUp(all, device, progress);
  const std::uint64_t fewerRays = std::min(options.techniqueRays, options.techniqueCrowdRays);
  for (const Comparison& comparison : chosen) {
    const ComparedScene scene = comparison.make(options);
    const Techniques techniques = comparison.choose(all);
    TechniqueTrial trial(scene, techniques, comparison.asThesis ? options.techniqueRays : fewerRays, device,
                         options, progress, steps);
    report.scenes.push_back(trial.compare());
    steps.advance();
  }
  const ComparedScene shinyShapes = makeShinyShapes();
  TechniqueTrial curve(shinyShapes, few, fewerRays, device, options, progress, steps);
  report.framesByLights = curve.framesByLights(options.voLightCounts);
  report.curveScene = shinyShapes.scene.name;
  steps.advance();
  report.notes = notesOn(report);

  std::vector<BenchmarkResult> results;
  for (const SceneComparison& scene : report.scenes) addResults(scene, results);
  for (const Curve& technique : report.framesByLights)
    for (const Point& point : technique.points)
      results.push_back({"techniques",
                         fmt::format("lights/{}, {:g} lights", technique.name, point.x),
                         "frames",
                         point.y,
                         "1/s",
                         {},
                         {}});
  if (!options.folder.empty()) writeTechniqueReport(options.folder, report);
  return results;
}

}  // namespace prelight::benchmarks
