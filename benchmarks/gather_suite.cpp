#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "benchmarks/measure.h"
#include "benchmarks/processor_time.h"
#include "benchmarks/suites.h"
#include "charts/make_light_map_layout.h"
#include "gi/indirect_light.h"
#include "gpu/light_tables.h"
#include "prelight/load.h"
#include "prelight/picture.h"

namespace prelight::benchmarks {

namespace {

constexpr std::array<std::pair<const char*, GatherChoice>, 3> choices = {
    {{"all", GatherChoice::All}, {"cache", GatherChoice::Cache}, {"guided", GatherChoice::Guided}}};
constexpr std::uint64_t truthSeed = 1000;

BenchmarkScene loadGatherScene(const std::string& name) {
  const std::filesystem::path file(name);
  if (!file.has_extension()) return loadBuiltinScene(name);
  LoadedScene loaded = load(file);
  return {file.stem().string(), std::move(loaded.scene), std::move(loaded.compiled)};
}

/// Indirect light at the texels of a map, always from the same photons.
class GatherTrial {
 public:
  GatherTrial(const BenchmarkScene& scene, const BenchmarkOptions& options, const Device& device,
              const Progress& progress)
      : scene_(scene),
        options_(options),
        device_(device),
        quiet_(progress),
        lit_{scene_.compiled, scene_.scene.images, scene_.scene.lights},
        surface_(makeDensitySurface(
            scene.compiled, makeSurfaceRegions(scene.compiled, LightMapLayoutRequest{}.creaseAngle))) {
    LightMapLayoutRequest map;
    map.texels = options.gatherTexels;
    layout_ = makeLightMapLayout(scene.scene, scene.compiled, map);
    const bool dark = makeLightTables(scene.compiled, scene.scene.lights, nullptr, true).groupCount == 0;
    if (dark) lit_.sky = &white_;
    transport_.emplace(lit_, device);
    sent_ = sendPhotons(scene.compiled, *transport_, indirectPhotons(*transport_, {}), quiet_);
  }

  struct Found {
    std::vector<glm::vec3> irradiance;
    double seconds = 0.0;  ///< of all processors
    std::uint64_t rays = 0;
    std::size_t records = 0;
  };

  Found gather(GatherChoice choice, std::uint32_t rays, std::uint64_t seed) {
    IndirectRequest request;
    request.gather = choice;
    request.rays = rays;
    request.gatherSeed = seed;
    IndirectLight light(lit_, *transport_, layout_, surface_, request, device_, sent_);
    Found found;
    const std::uint64_t before = light.rays();
    const double start = processorSeconds();
    found.irradiance = light.gather(layout_.texels, quiet_);
    found.seconds = processorSeconds() - start;
    found.rays = light.rays() - before;
    found.records = light.records();
    return found;
  }

  void findTruth() {
    truth_.assign(layout_.texels.size(), glm::dvec3(0.0));
    for (int run = 0; run < options_.gatherTruthRuns; ++run) {
      const Found found =
          gather(GatherChoice::All, 2 * options_.gatherLongRun, truthSeed + static_cast<std::uint64_t>(run));
      for (std::size_t i = 0; i < truth_.size(); ++i)
        truth_[i] += glm::dvec3(found.irradiance[i]) / static_cast<double>(options_.gatherTruthRuns);
    }
  }

  /// Rms over the texels that are lit, and the mean of all, over the mean of the truth.
  std::pair<double, double> errorOf(std::span<const glm::vec3> irradiance) const {
    double squares = 0.0, sum = 0.0, mean = 0.0, count = 0.0;
    for (std::size_t i = 0; i < truth_.size(); ++i) {
      if (truth_[i] == glm::dvec3(0.0)) continue;  // inside an object
      const glm::dvec3 off = glm::dvec3(irradiance[i]) - truth_[i];
      squares += glm::dot(off, off) / 3.0;
      sum += (off.x + off.y + off.z) / 3.0;
      mean += (truth_[i].x + truth_[i].y + truth_[i].z) / 3.0;
      ++count;
    }
    if (!(mean > 0.0)) return {0.0, 0.0};
    return {std::sqrt(squares / count) / (mean / count), sum / mean};
  }

  void measure(const char* name, GatherChoice choice, std::uint32_t rays,
               std::vector<BenchmarkResult>& results) {
    std::vector<double> seconds;
    double squares = 0.0;
    Found last;
    for (int run = 0; run < options_.runs; ++run) {
      last = gather(choice, rays, static_cast<std::uint64_t>(run) + 1);
      seconds.push_back(last.seconds);
      squares += std::pow(errorOf(last.irradiance).first, 2) / options_.runs;
    }
    const std::string label = fmt::format("{}/{}/{} rays", scene_.name, name, rays);
    results.push_back({"gather", label, "error", std::sqrt(squares), "of the mean", {}, {}});
    results.push_back({"gather", label, "time", median(seconds), "s", {}, {}});
    results.push_back({"gather", label, "rays", static_cast<double>(last.rays), "", {}, {}});
    results.push_back({"gather", label, "gathered at", static_cast<double>(last.records), "texels", {}, {}});
  }

  void measureBias(const char* name, GatherChoice choice, std::vector<BenchmarkResult>& results) {
    const auto [error, mean] = errorOf(gather(choice, options_.gatherLongRun, truthSeed / 2).irradiance);
    const std::string label = fmt::format("{}/{}/long run", scene_.name, name);
    results.push_back({"gather", label, "error", error, "of the mean", {}, {}});
    results.push_back({"gather", label, "bias of the mean", mean, "of the mean", {}, {}});
  }

 private:
  const BenchmarkScene& scene_;
  const BenchmarkOptions& options_;
  const Device& device_;
  StopOnly quiet_;
  LitScene lit_;
  Environment white_ = constantEnvironment(glm::vec3(1.0f));
  DensitySurface surface_;
  LightMapLayout layout_;
  std::optional<TransportScene> transport_;
  SentPhotons sent_;
  std::vector<glm::dvec3> truth_;
};

}  // namespace

std::vector<BenchmarkResult> runGatherSuite(const Device& device, const BenchmarkOptions& options,
                                            Progress& progress) {
  std::vector<BenchmarkResult> results;
  StepCounter steps(progress, "bench gather",
                    options.gatherScenes.size() * choices.size() * (options.gatherRays.size() + 1));
  for (const std::string& name : options.gatherScenes) {
    const BenchmarkScene scene = loadGatherScene(name);
    GatherTrial trial(scene, options, device, progress);
    trial.findTruth();
    for (const auto& [label, choice] : choices) {
      trial.gather(choice, options.gatherRays.front(), 0);  // warms up
      for (const std::uint32_t rays : options.gatherRays) {
        trial.measure(label, choice, rays, results);
        steps.advance();
      }
      trial.measureBias(label, choice, results);
      steps.advance();
    }
  }
  return results;
}

}  // namespace prelight::benchmarks
