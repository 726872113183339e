#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <span>
#include <vector>

#include "base/colour.h"
#include "benchmarks/run/measure.h"
#include "benchmarks/suites/visibility/visibility_suite.h"
#include "benchmarks/truth/seen_places.h"
#include "benchmarks/truth/traced_accessibility.h"
#include "scene/light_shape.h"
#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"
#include "viewer/options/light_option.h"

namespace prelight::benchmarks {

namespace {

struct Source {
  glm::dvec3 position;
  glm::dvec3 normal;      ///< zero if light leaves it evenly in all directions
  double strength = 0.0;  ///< luminance of the intensity, along the normal if there is one
};

std::vector<Source> sourcesOf(const CompiledScene& scene, const Light& lamp, int samples) {
  const double light = luminance(glm::dvec3(lamp.intensity));
  if (lamp.type == LightType::Point) return {{lamp.position - scene.origin, glm::dvec3(0.0), light}};
  std::vector<Source> sources;
  for (const LightPatch& patch : patchesOf(lamp, samples))
    sources.push_back(
        {patch.position - scene.origin, patch.normal, light * shapeArea(*lamp.shape) / samples});
  return sources;
}

/// Returns the light that reaches a place from a source if nothing lies between them.
double unshadowed(const SeenPlace& place, const Source& source) {
  const glm::dvec3 path = source.position - place.position;
  const double square = glm::dot(path, path), length = std::sqrt(square);
  if (!(length > 0.0) || glm::dot(place.face, path) <= 0.0) return 0.0;
  const double leaving =
      glm::length(source.normal) > 0.0 ? std::max(-glm::dot(source.normal, path) / length, 0.0) : 1.0;
  return source.strength * leaving * std::max(glm::dot(place.normal, path) / length, 0.0) / square;
}

/// Returns the luminance of irradiance of a lamp at places, with traced shadows, 0 where no surface is
/// visible. Area lights have `samples` patches.
std::vector<double> tracedIrradiance(const CompiledScene& scene, Tracer& tracer,
                                     std::span<const SeenPlace> places, const Light& lamp, int samples) {
  const double offset = seenOffset(scene);
  std::vector<double> result(places.size(), 0.0);
  for (const Source& source : sourcesOf(scene, lamp, samples)) {
    std::vector<device::Ray> rays;
    std::vector<std::size_t> lit;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i].triangle == PRELIGHT_NO_TRIANGLE || !(unshadowed(places[i], source) > 0.0)) continue;
      const glm::dvec3 start = places[i].position + offset * places[i].face, path = source.position - start;
      const double distance = glm::length(path);
      rays.push_back(rayFrom(start, path / distance, places[i].triangle, distance * (1.0 - 1e-6)));
      lit.push_back(i);
    }
    const std::vector<device::Hit> hits = tracer.traceAny(rays);
    for (std::size_t r = 0; r < hits.size(); ++r)
      if (hits[r].triangle == PRELIGHT_NO_TRIANGLE) result[lit[r]] += unshadowed(places[lit[r]], source);
  }
  return result;
}

struct Lamp {
  const char* name;
  const char* light;
};

std::vector<Lamp> lampsOf(const std::string& scene) {
  if (scene == "rooms")
    return {{"point, the file's", "point:-1.9,2.2,0.4:1,1,1"},
            {"point, in the other room", "point:2.2,1.6,0.5:1,1,1"},
            {"point, 10 cm above the floor", "point:1.2,0.1,0.6:1,1,1"},
            {"point, in the doorway", "point:0,1,0:1,1,1"},
            {"sphere of 10 cm", "area:sphere:2.2,1.6,0.5:0.1:1,1,1"},
            {"sphere of 30 cm", "area:sphere:-1.9,1.8,0.4:0.3:1,1,1"},
            {"disk under the ceiling", "area:disk:2.2,2.3,0.2:0,-1,0:0.3:1,1,1"},
            {"quad before a wall", "area:quad:3.9,1.4,-0.4:-1,0,0:1,0.7:1,1,1"},
            {"polygon in the other room", "area:polygon:-2.5,2.3,-0.5:-1.2,2.3,-0.5:-1.8,2.3,0.6:1,1,1"}};
  return {{"point, under the ceiling", "point:0,1.9,0:1,1,1"},
          {"point, in the middle", "point:0,1,0:1,1,1"},
          {"point, 6 cm above the floor", "point:0.3,0.06,0.8:1,1,1"},
          {"point, 7 cm from a wall", "point:0.93,1,0.2:1,1,1"},
          {"point, behind a block", "point:-0.3,0.6,-0.75:1,1,1"},
          {"sphere of 10 cm", "area:sphere:0,1.3,0.3:0.1:1,1,1"},
          {"sphere of 30 cm", "area:sphere:0.4,1.2,0.3:0.3:1,1,1"},
          {"disk under the ceiling", "area:disk:0,1.95,0:0,-1,0:0.2:1,1,1"},
          {"quad before a wall", "area:quad:0.95,1.2,0.2:-1,0,0:0.6,0.6:1,1,1"},
          {"polygon beside a block", "area:polygon:-0.9,0.2,0.6:-0.9,0.2,-0.2:-0.9,1,0.2:1,1,1"}};
}

/// A white scene without lights, with its transfer and shells.
struct ShelledScene {
  BenchmarkScene scene;
  Bake bake, plain;  ///< `plain` has no shells
  std::uint64_t raysAdded = 0;
  Environment dark = constantEnvironment(glm::vec3(0.0f));

  ShelledScene(const std::string& name, const Device& device, const VisibilityOptions& options,
               const Progress& progress)
      : scene(loadBuiltinScene(name)) {
    scene.scene = whitened(scene.scene);
    Warnings warnings;
    scene.compiled = compileScene(scene.scene, warnings);
    BakeRequest request;
    request.sh.order = options.nearLampOrder;
    request.bounces = 1;  // without a bounce, closed places have fewer rays if no shells are requested
    request.effort.rays = options.nearLampRays;
    const std::uint64_t before = timedBake(scene, request, device, progress).report.rays;
    request.nearLamps.shells = options.nearLampShells;
    TimedBake with = timedBake(scene, request, device, progress);
    raysAdded = with.report.rays - before;
    bake = std::move(with.bake);
    plain = bake;
    plain.nearLamps.reset();
  }

  viewer::RenderInputs inputs(const Bake& with) const { return {scene.scene, scene.compiled, &with, &dark}; }
};

/// Returns the file's camera and one on the other side of the scene.
std::vector<Camera> camerasOf(const ShelledScene& shelled, const std::string& name) {
  std::vector<Camera> cameras = {shelled.scene.scene.cameras.front()};
  if (name != "rooms") return cameras;  // other scenes show nothing from behind
  cameras.push_back(cameras.front());
  cameras.back().world =
      glm::rotate(glm::dmat4(1.0), std::numbers::pi, glm::dvec3(0, 1, 0)) * cameras.back().world;
  return cameras;
}

/// A view without light, and the places visible in it.
struct LampView {
  viewer::View view;
  std::vector<SeenPlace> places;
};

/// Sums of squared differences of the irradiance in pictures.
struct LampErrors {
  double plain = 0.0, shelled = 0.0, truth = 0.0;
};

double showing(const glm::vec3& pixel) { return std::numbers::pi * luminance(glm::dvec3(pixel)); }

class LampMeter {
 public:
  LampMeter(const ShelledScene& shelled, const std::string& name, Tracer& tracer,
            const VisibilityOptions& options)
      : shelled_(shelled),
        tracer_(tracer),
        samples_(options.nearLampSamples),
        with_(shelled.inputs(shelled.bake)),
        without_(shelled.inputs(shelled.plain)) {
    viewer::RenderOptions render;
    render.shading = viewer::Shading::Sh;
    render.width = options.nearLampWidth;
    render.height = options.nearLampHeight;
    for (const Camera& camera : camerasOf(shelled, name)) {
      LampView seen{viewer::makeView(shelled.inputs(shelled.bake), render), {}};
      seen.view.camera = camera;
      seen.places = placesSeen(shelled.scene.compiled, tracer, {camera, render.width, render.height});
      views_.push_back(std::move(seen));
    }
  }

  LampErrors measure(const Light& lamp) {
    LampErrors errors;
    for (LampView& seen : views_) {
      seen.view.lights = {lamp};
      const Picture shelled = viewer::renderView(with_, seen.view, 1);
      const Picture plain = viewer::renderView(without_, seen.view, 1);
      const std::vector<double> truth =
          tracedIrradiance(shelled_.scene.compiled, tracer_, seen.places, lamp, samples_);
      for (std::size_t i = 0; i < truth.size(); ++i) {
        if (seen.places[i].triangle == PRELIGHT_NO_TRIANGLE) continue;
        errors.shelled += std::pow(showing(shelled.pixels[i]) - truth[i], 2.0);
        errors.plain += std::pow(showing(plain.pixels[i]) - truth[i], 2.0);
        errors.truth += truth[i] * truth[i];
      }
    }
    return errors;
  }

  /// Returns the largest difference that shells make to light of the transfer.
  double farDifference() {
    double largest = 0.0;
    for (LampView& seen : views_) {
      seen.view.lights = {viewer::parseLight("directional:0.3,-1,-0.4:3,3,3"),
                          viewer::parseLight("area:sphere:0,40,30:2:300,300,300")};
      const Picture shelled = viewer::renderView(with_, seen.view, 1);
      const Picture plain = viewer::renderView(without_, seen.view, 1);
      for (std::size_t i = 0; i < plain.pixels.size(); ++i)
        largest = std::max(largest, double(glm::length(shelled.pixels[i] - plain.pixels[i])));
    }
    return largest;
  }

 private:
  const ShelledScene& shelled_;
  Tracer& tracer_;
  int samples_;
  viewer::Renderer with_, without_;
  std::vector<LampView> views_;
};

void measure(const std::string& name, const Device& device, const VisibilityOptions& options,
             const Progress& progress, std::vector<BenchmarkResult>& results) {
  const ShelledScene shelled(name, device, options, progress);
  Tracer tracer(shelled.scene.compiled, device);
  LampMeter meter(shelled, name, tracer, options);
  const auto add = [&](const std::string& setting, const char* metric, double value, const char* unit) {
    results.push_back({name + "/" + setting, metric, value, unit, {}, {}});
  };
  double points = 0.0, areas = 0.0;
  int pointCount = 0, areaCount = 0;
  for (const Lamp& lamp : lampsOf(name)) {
    progress.check();
    const Light light = viewer::parseLight(lamp.light);
    const LampErrors errors = meter.measure(light);
    const double ratio = errors.plain > 0.0 ? std::sqrt(errors.shelled / errors.plain) : 0.0;
    add(lamp.name, "error without shells", std::sqrt(errors.plain / errors.truth), "of rms");
    add(lamp.name, "error with shells", std::sqrt(errors.shelled / errors.truth), "of rms");
    add(lamp.name, "with over without", ratio, "1");
    (light.type == LightType::Area ? areas : points) += ratio;
    ++(light.type == LightType::Area ? areaCount : pointCount);
  }
  add("mean of points", "with over without", points / pointCount, "1");
  add("mean of areas", "with over without", areas / areaCount, "1");
  add("far lights", "largest difference", meter.farDifference(), "W/(m2 sr)");
  add("bake", "rays added", static_cast<double>(shelled.raysAdded), "rays");
}

}  // namespace

void runNearLamps(const Device& device, const VisibilityOptions& options, SuiteRun& run) {
  const viewer::gl::EglContext context;
  StepCounter steps(run, "bench near-lamps", options.nearLampScenes.size());
  std::vector<BenchmarkResult>& results = run.results();
  for (const std::string& name : options.nearLampScenes) {
    measure(name, device, options, run, results);
    steps.advance();
  }
}

}  // namespace prelight::benchmarks
