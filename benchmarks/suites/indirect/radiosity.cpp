#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "benchmarks/lab/hemicube.h"
#include "benchmarks/run/measure.h"
#include "benchmarks/suites/indirect/indirect_suite.h"
#include "radiosity/radiosity.h"

namespace prelight::benchmarks {

namespace {

using std::numbers::pi;

void add(std::vector<BenchmarkResult>& results, const std::string& name, const char* metric, double value,
         const char* unit) {
  results.push_back({name, metric, value, unit, {}, {}});
}

CompiledScene plate(const glm::vec3& corner, const glm::vec3& a, const glm::vec3& b) {
  CompiledScene scene;
  scene.positions = {corner, corner + a, corner + a + b, corner + b};
  scene.normals.assign(4, glm::normalize(glm::cross(a, b)));
  scene.texCoords.assign(4, glm::vec2(0.0f));
  scene.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.triangleMaterials.assign(2, 0);
  scene.triangleFlat.assign(2, 1);
  scene.materials.resize(1);
  return scene;
}

/// Two parallel or perpendicular plates of two triangles each, with their form factor (Howell, A Catalog of
/// Radiation Heat Transfer Configuration Factors).
struct PlatePair {
  std::string name;
  CompiledScene scene;
  double factor = 0.0;
};

CompiledScene pairOf(CompiledScene first, const CompiledScene& second) {
  for (std::size_t v = 0; v < 4; ++v) {
    first.positions.push_back(second.positions[v]);
    first.normals.push_back(second.normals[v]);
    first.texCoords.push_back(second.texCoords[v]);
  }
  for (const glm::uvec3& t : second.triangles) first.triangles.push_back(t + 4u);
  first.triangleMaterials.assign(4, 0);
  first.triangleFlat.assign(4, 1);
  return first;
}

/// Returns pairs of unit squares: C-11 and C-14 with all ratios 1.
std::vector<PlatePair> platePairs() {
  const double root2 = std::sqrt(2.0);
  const double parallel =
      2.0 / pi *
      (std::log(std::sqrt(4.0 / 3.0)) + 2.0 * root2 * std::atan(1.0 / root2) - 2.0 * std::atan(1.0));
  const double perpendicular = (2.0 * std::atan(1.0) - root2 * std::atan(1.0 / root2) +
                                0.25 * (std::log(4.0 / 3.0) + 2.0 * std::log(3.0 / 4.0))) /
                               pi;
  const CompiledScene floor = plate({0, 0, 0}, {0, 0, 1}, {1, 0, 0});
  return {{"parallel plates", pairOf(floor, plate({0, 1, 0}, {1, 0, 0}, {0, 0, 1})), parallel},
          {"perpendicular plates", pairOf(floor, plate({0, 0, 0}, {0, 1, 0}, {0, 0, 1})), perpendicular}};
}

double castError(const PlatePair& pair, const RadiosityElements& elements, Tracer& tracer, std::uint32_t rays,
                 std::uint64_t seed) {
  Progress progress;
  FormFactorCast cast(pair.scene, elements, tracer, rays, seed);
  cast.run(progress);
  const FormFactors f = makeFormFactors(elements, cast.counts(), std::uint64_t{1} << 30);
  const std::uint32_t half = elements.perSide() / 2;
  double sum = 0.0;
  for (std::uint32_t i = 0; i < half; ++i)
    for (std::uint32_t k = f.rowStart[i]; k < f.rowStart[i + 1]; ++k) sum += double(f.scale[i]) * f.values[k];
  return sum / half / pair.factor - 1.0;
}

double hemicubeError(const PlatePair& pair, const RadiosityElements& elements, Tracer& tracer, int size,
                     std::uint64_t seed) {
  const ElementPoints points(pair.scene, elements, seed);
  HemicubeCast cast(pair.scene, elements, tracer, size);
  const std::uint32_t half = elements.perSide() / 2;
  double sum = 0.0;
  for (std::uint32_t i = 0; i < half; ++i)
    for (const auto& [met, share] : cast.row(points, i, 1)) sum += share;
  return sum / half / pair.factor - 1.0;
}

/// Measures the RMS error of a form factor over seeds by rays per element, beside hemicubes of about as many
/// pixels.
void measureFormFactors(const Device& device, const IndirectOptions& options, StepCounter& steps,
                        std::vector<BenchmarkResult>& results) {
  // 64 rays against 3 x 4^2 = 48 pixels, and so on.
  constexpr std::array<std::pair<std::uint32_t, int>, 4> sizes = {
      {{64, 4}, {256, 10}, {1024, 18}, {4096, 36}}};
  for (const PlatePair& pair : platePairs()) {
    const RadiosityElements elements = makeElements(pair.scene, 0.4);
    Tracer tracer(pair.scene, device);
    for (const auto& [rays, size] : sizes) {
      if (rays > options.radiosityRays) break;
      double cast = 0.0, hemicube = 0.0;
      for (int seed = 0; seed < options.radiositySeeds; ++seed) {
        const auto s = static_cast<std::uint64_t>(seed);
        cast += std::pow(castError(pair, elements, tracer, rays, s), 2) / options.radiositySeeds;
        hemicube += std::pow(hemicubeError(pair, elements, tracer, size, s), 2) / options.radiositySeeds;
      }
      const double castRms = 100.0 * std::sqrt(cast), hemicubeRms = 100.0 * std::sqrt(hemicube);
      results.push_back({fmt::format("{}/{} rays per element", pair.name, rays), "error", castRms, "%",
                         fmt::format("hemicube of {} pixels", 3 * size * size),
                         castRms > 0.0 ? std::optional(hemicubeRms / castRms) : std::nullopt});
    }
    steps.advance();
  }
}

/// Returns lights with the scene's first lamp moved.
RadiosityLights movedLights(const BenchmarkScene& scene) {
  RadiosityLights lights{scene.compiled.lights, nullptr, 0.0};
  Light lamp;
  lamp.intensity = glm::vec3(10.0f);
  lamp.position =
      scene.compiled.origin + glm::dvec3(0.2f * (scene.compiled.boundsMax - scene.compiled.boundsMin));
  lights.punctual.push_back(lamp);
  return lights;
}

void measureSolvers(const std::string& name, Radiosity& radiosity, const RadiosityLights& lights,
                    const IndirectOptions& options, const Progress& outer,
                    std::vector<BenchmarkResult>& results) {
  StopOnly progress(outer);
  radiosity.setLights(lights, progress);
  for (std::size_t m = 0; m < radiosityMethodNames.size(); ++m) {
    const auto method = static_cast<RadiosityMethod>(m);
    const std::string label = fmt::format("{}/{}", name, radiosityMethodNames[m]);
    ExchangeSolver solver(radiosity.system());
    solver.setDirect(radiosity.directOfElements());
    const SolveReport timed = solver.solve(method, options.radiosityTolerance, 2000.0, progress);
    add(results, label, "sweeps", timed.sweeps(), "");
    add(results, label, "solve", timed.curve.empty() ? 0.0 : timed.curve.back().seconds, "s");
    solver.restart();
    const SolveReport exact = solver.solve(method, 0.1 * options.radiosityTolerance, 200.0, progress, true);
    for (const ResidualPoint& point : exact.curve)
      add(results, fmt::format("{}/{:.2f} sweeps", label, point.sweeps), "residual", point.residual, "");
  }
}

void measureRadiosity(const BenchmarkScene& scene, const Device& device, const IndirectOptions& options,
                      Progress& outer, std::vector<BenchmarkResult>& results) {
  StopOnly progress(outer);
  Tracer tracer(scene.compiled, device);
  RadiosityOptions shape;
  shape.raysPerElement = options.radiosityRays;
  Radiosity radiosity(scene.compiled, tracer, shape);
  radiosity.cast(progress);
  radiosity.relight({scene.compiled.lights, nullptr, 0.0}, progress);
  const RadiosityReport& report = radiosity.report();
  const double found = report.castSeconds + report.rowSeconds;
  add(results, scene.name, "elements", double(report.elements), "");
  add(results, scene.name, "form factors a row", double(report.entries) / double(report.elements), "");
  add(results, scene.name, "form factors", found, "s");
  const RadiosityLights moved = movedLights(scene);
  const double relight = secondsOf([&] { radiosity.relight(moved, progress); });
  results.push_back(
      {scene.name, "relight", relight, "s", "form factors found anew", (found + relight) / relight});
  measureSolvers(scene.name, radiosity, moved, options, outer, results);
}

}  // namespace

void runRadiosity(const Device& device, const IndirectOptions& options, SuiteRun& run) {
  std::vector<BenchmarkResult>& results = run.results();
  StepCounter steps(run, "bench radiosity", 2 + options.radiosityScenes.size());
  measureFormFactors(device, options, steps, results);
  for (const std::string& name : options.radiosityScenes) {
    measureRadiosity(loadBuiltinScene(name), device, options, run, results);
    steps.advance();
  }
}

}  // namespace prelight::benchmarks
