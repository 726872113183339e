#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>

#include "base/colour.h"
#include "benchmarks/run/measure.h"
#include "benchmarks/run/timing.h"
#include "benchmarks/suites/live/live_suite.h"
#include "benchmarks/truth/seen_places.h"
#include "charts/light_map_lookup.h"
#include "gi/indirect_light.h"
#include "gi/update/live_light.h"
#include "prelight/load.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "viewer/core/camera.h"

namespace prelight::benchmarks {

namespace {

constexpr double gapOfRow = 1.05;  ///< distance between copies, in widths of the scene
constexpr std::uint64_t trialSeed = 5;

/// Adds copies of a document's scene, side by side along +X.
void repeatScene(nlohmann::ordered_json& json, int copies, double step) {
  auto& scene = json["scenes"][json.value("scene", 0)];
  const nlohmann::ordered_json nodes = json["nodes"], roots = scene["nodes"];
  for (int copy = 1; copy < copies; ++copy) {
    const int first = static_cast<int>(json["nodes"].size());
    for (nlohmann::ordered_json node : nodes) {
      if (node.contains("children"))
        for (auto& child : node["children"]) child = child.get<int>() + first;
      json["nodes"].push_back(node);
    }
    nlohmann::ordered_json holder = {{"translation", {copy * step, 0.0, 0.0}}, {"children", roots}};
    for (auto& child : holder["children"]) child = child.get<int>() + first;
    scene["nodes"].push_back(json["nodes"].size());
    json["nodes"].push_back(holder);
  }
}

GltfDocument documentOf(const std::string& nameOrFile) {
  if (!std::filesystem::path(nameOrFile).has_extension()) return makeBuiltinScene(nameOrFile);
  return *load(nameOrFile).document;
}

/// Adds a lamp over each copy of a scene without lights.
void addLamps(CompiledScene& compiled, int copies, double step, double width, double height) {
  for (int copy = 0; copy < copies; ++copy) {
    Light lamp;
    lamp.type = LightType::Point;
    lamp.intensity = glm::vec3(static_cast<float>(width * width));
    lamp.position = compiled.origin + glm::dvec3(compiled.boundsMin) +
                    glm::dvec3(0.5 * width + copy * step, 1.5 * height, 0.5 * width);
    compiled.lights.push_back(lamp);
  }
}

struct Row {
  BenchmarkScene scene;
  double width = 0.0;  ///< width of a copy, m
};

Row makeRow(const std::string& nameOrFile, int copies) {
  const BenchmarkScene one = loadNamedScene(nameOrFile);
  const glm::dvec3 size(one.compiled.boundsMax - one.compiled.boundsMin);
  const double step = gapOfRow * size.x;
  Warnings warnings;
  GltfDocument document = documentOf(nameOrFile);
  repeatScene(document.json, copies, step);
  Row row{{one.name, loadScene(document, warnings), {}}, size.x};
  row.scene.compiled = compileScene(row.scene.scene, warnings);
  const LightTables lights = makeLightTables(row.scene.compiled, row.scene.compiled.lights, nullptr, true);
  if (lights.groupCount == 0) addLamps(row.scene.compiled, copies, step, size.x, size.y);
  return row;
}

/// The place of a pixel on a face.
struct SeenFace {
  std::uint32_t face = 0;
  double b1 = 0.0, b2 = 0.0;
};

/// Light at the points of a scene's surface that a picture shows.
class SeenLight {
 public:
  SeenLight(const BenchmarkScene& scene, Camera camera, const LiveOptions& options, const Device& device)
      : camera_(std::move(camera)), height_(options.liveLightHeight) {
    Tracer tracer(scene.compiled, device);
    for (const SeenPlace& place : placesSeen(scene.compiled, tracer, {camera_, height_ * 16 / 9, height_}))
      if (place.triangle != PRELIGHT_NO_TRIANGLE) faces_.push_back(faceOf(scene.compiled, place));
  }

  glm::dvec3 eye() const { return glm::dvec3(camera_.world[3]); }

  /// Returns [pixel with texels] the luminance of indirect irradiance.
  std::vector<double> of(const LiveLight& live) const {
    LightMap map;
    map.layout = live.layout();
    map.values.assign(3 * map.layout.texelCount(), 0.0f);
    if (!live.indirect().empty()) setIrradiance(live, map);
    std::vector<double> light;
    for (const SeenFace& at : faces_)
      if (map.layout.chartOf[at.face] != LightMapLayout::noChart)
        light.push_back(luminance(lightMapIrradiance(map, at.face, at.b1, at.b2)));
    return light;
  }

 private:
  static SeenFace faceOf(const CompiledScene& scene, const SeenPlace& place) {
    const glm::uvec3& t = scene.triangles[place.triangle];
    const glm::dvec3 a(scene.positions[t.x]), b = glm::dvec3(scene.positions[t.y]) - a,
                                              c = glm::dvec3(scene.positions[t.z]) - a;
    const glm::dvec3 normal = glm::cross(b, c), p = place.position - a;
    const double area2 = glm::dot(normal, normal);
    const bool back = glm::dot(normal, place.face) < 0.0;
    return {place.triangle + (back ? scene.triangleCount() : 0), glm::dot(glm::cross(p, c), normal) / area2,
            glm::dot(glm::cross(b, p), normal) / area2};
  }

  Camera camera_;
  int height_;
  std::vector<SeenFace> faces_;
};

double meanOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

/// Returns the RMS difference as a share of the mean.
double pictureError(const std::vector<double>& got, const std::vector<double>& truth) {
  double squares = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) squares += (got[i] - truth[i]) * (got[i] - truth[i]);
  return std::sqrt(squares / static_cast<double>(truth.size())) / meanOf(truth);
}

LiveLightOptions trialOptions(const LiveOptions& options) {
  LiveLightOptions live;
  live.gather.rays = options.liveLightRays;
  live.gather.texelsPerFrame = 100;
  live.causticPhotons = 1000;
  live.seed = trialSeed;
  return live;
}

/// Returns the median processor time of frames in which every lamp changes, s.
double frameOfChanges(LiveLight& live, const CompiledScene& compiled, int frames, Progress& progress) {
  std::vector<double> seconds;
  for (int f = 1; f <= frames; ++f) {
    for (std::size_t l = 0; l < compiled.lights.size(); ++l) {
      Light lamp = compiled.lights[l];
      lamp.intensity *= 1.0f + 0.01f * static_cast<float>(f);
      live.setLight(l, lamp);
    }
    const double before = processorSeconds();
    live.advance(progress);
    seconds.push_back(processorSeconds() - before);
  }
  return median(seconds);
}

/// Compares lamps that are thinned by distance from the viewer with lamps that are not, in a row of copies of
/// a scene seen from the first: error of the picture, and cost of a frame in which every lamp changes.
void thinLamps(const std::string& sceneOrFile, const Device& device, const LiveOptions& options,
               Progress& progress, std::vector<BenchmarkResult>& results) {
  const BenchmarkScene one = loadNamedScene(sceneOrFile);
  const Row row = makeRow(sceneOrFile, options.liveLightCopies);
  const CompiledScene& compiled = row.scene.compiled;
  const SeenLight seen(row.scene, viewer::chooseCamera(one.scene, one.compiled, std::nullopt), options,
                       device);
  const auto make = [&](std::uint64_t photons, double beyond) {
    LiveLightOptions live = trialOptions(options);
    live.texels = options.liveLightTexels;
    live.photons = photons;
    live.thinBeyond = beyond;
    live.eye = seen.eye();
    return LiveLight(row.scene.scene, compiled, nullptr, 0.0, live, {}, device, progress);
  };
  const std::vector<double> truth = seen.of(make(options.liveLightTruth, 0.0));
  for (const std::uint64_t photons : options.liveLightPhotons)
    for (const double beyond : {0.0, 0.5 * row.width, row.width}) {
      LiveLight live = make(photons, beyond);
      const std::string how = beyond > 0.0 ? fmt::format("thinned beyond {:.2g} widths", beyond / row.width)
                                           : std::string("by power");
      const std::string case_ =
          fmt::format("{} x {}/{} photons {}", row.scene.name, options.liveLightCopies, photons, how);
      const auto add = [&](const char* metric, double value, const char* unit) {
        results.push_back({case_, metric, value, unit, {}, {}});
      };
      add("photons", static_cast<double>(live.photons()->pathCount()), "photons");
      add("picture error", pictureError(seen.of(live), truth), "of the mean");
      add("picture mean", meanOf(seen.of(live)) / meanOf(truth), "of the truth's");
      add("frame in which all lamps change", frameOfChanges(live, compiled, options.runs, progress), "s");
    }
}

}  // namespace

void runLiveLight(const Device& device, const LiveOptions& options, SuiteRun& run) {
  StopOnly quiet(run);
  StepCounter steps(run, "bench live-light", options.liveLightRows.size());
  for (const std::string& scene : options.liveLightRows) {
    thinLamps(scene, device, options, quiet, run.results());
    steps.advance();
  }
}

}  // namespace prelight::benchmarks
