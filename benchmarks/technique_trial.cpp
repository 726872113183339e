#include "benchmarks/technique_trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "benchmarks/detailed_scene.h"
#include "benchmarks/flip.h"
#include "benchmarks/probe_lights.h"
#include "benchmarks/take_turns.h"
#include "integrators/reference.h"
#include "io/baked_file.h"
#include "projectors/light_map/light_map_file.h"
#include "viewer/view.h"

namespace prelight::benchmarks {

namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr std::uint64_t warmingTriangles = 1000, warmingRays = 8;  // enough to have kernels compiled
constexpr int pictureSamplesPerAxis = 3;
constexpr double curveIntensity = 80.0;  // W/sr of all lights of the curve together

std::vector<glm::vec3> displayed(const Picture& picture) {
  std::vector<glm::vec3> result;
  result.reserve(picture.pixels.size());
  for (const glm::vec3& pixel : picture.pixels) result.push_back(toneMap(pixel));
  return result;
}

std::size_t fileBytes(const ComparedScene& scene, const Bake& bake) {
  GltfDocument document = scene.document;
  embedBake(document, scene.scene.compiled, bake);
  std::size_t picture = 0;  // before it is compressed
  if (bake.lightMap) {
    embedLightMap(document, scene.scene.compiled, bake.lightMap->layout, "map.exr");
    picture = bake.lightMap->values.size() * sizeof(float);
  }
  return document.bin.size() - scene.document.bin.size() + picture;
}

/// The view with its lights and sky turned about the vertical through the middle of the scene.
viewer::View turned(viewer::View view, const CompiledScene& scene, double angle) {
  const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), angle, glm::dvec3(0, 1, 0)));
  for (Light& light : view.lights) {
    light.position = scene.origin + turn * (light.position - scene.origin);
    light.direction = turn * light.direction;
  }
  view.skyRotation += angle;
  return view;
}

}  // namespace

double pictureRmse(const Picture& first, const Picture& second) {
  double sum = 0.0;
  for (std::size_t i = 0; i < first.pixels.size(); ++i) {
    const glm::dvec3 white(1.0);
    const glm::dvec3 difference =
        glm::min(glm::dvec3(first.pixels[i]), white) - glm::min(glm::dvec3(second.pixels[i]), white);
    sum += glm::dot(difference, difference);
  }
  return std::sqrt(sum / (3.0 * static_cast<double>(first.pixels.size())));
}

void warmUp(const std::vector<Technique>& techniques, const Device& device, const Progress& progress) {
  const BenchmarkScene scene = makeDetailedRooms(warmingTriangles);
  for (const Technique& technique : techniques) {
    BakeRequest request = technique.request;
    request.effort.rays = warmingRays;
    if (request.anything()) timedBake(scene, request, device, progress);
  }
}

/// A technique ready to be drawn.
struct TechniqueTrial::Entry {
  Technique technique;
  Bake bake;
  double firstPass = 0.0;
  double secondPass = 0.0;
  viewer::RenderInputs inputs;
  viewer::View view;
  std::unique_ptr<viewer::Renderer> renderer;
  std::unique_ptr<viewer::gl::Framebuffer> target;
  double angle = 0.0;  // of the last frame

  Entry(const Technique& t, const ComparedScene& scene, const Device& device)
      : technique(t),
        inputs{scene.scene.scene, scene.scene.compiled, &bake, scene.sky ? &*scene.sky : nullptr, &device} {}

  /// A frame in which the light is elsewhere than in the last, drawn to the end.
  void frame(const std::optional<std::vector<Light>>& lights) {
    viewer::View moved = view;
    if (lights) moved.lights = *lights;
    moved = turned(std::move(moved), inputs.compiled, angle += degree);
    renderer->draw(moved, {0, 0, view.width, view.height}, *target);
    viewer::gl::Framebuffer::finish();
  }
};

TechniqueTrial::TechniqueTrial(const ComparedScene& scene, const std::vector<Technique>& techniques,
                               std::uint64_t rays, const Device& device, const BenchmarkOptions& options,
                               const Progress& progress, StepCounter& steps)
    : scene_(scene), device_(device), rays_(rays), options_(options), progress_(progress) {
  for (const Technique& technique : techniques) {
    add(technique);
    steps.advance();
  }
}

TechniqueTrial::~TechniqueTrial() = default;

void TechniqueTrial::add(const Technique& technique) {
  auto entry = std::make_unique<Entry>(technique, scene_, device_);
  BakeRequest request = technique.request;
  if (request.anything()) {
    request.effort.rays = rays_;
    if (scene_.sky && (request.radiosity || request.lightMap))
      request.radiosity.environment = std::make_shared<Environment>(*scene_.sky);
    TimedBake baked = timedBake(scene_.scene, request, device_, progress_);
    for (const auto& [stage, seconds] : baked.report.stageSeconds)
      (stage == "bounce" || stage == "glossy" ? entry->secondPass : entry->firstPass) += seconds;
    if (!canShow(technique, baked.bake)) return;
    entry->bake = std::move(baked.bake);
  }
  if (technique.shading == viewer::Shading::Vo) {  // AO was only on the way
    entry->bake.ao.clear();
    entry->bake.bentNormals.clear();
  }
  viewer::RenderOptions render;
  render.shading = technique.shading;
  render.occluders = technique.occluders;
  render.screenOcclusion = technique.screenOcclusion;
  render.width = options_.techniqueWidth;
  render.height = options_.techniqueHeight;
  entry->view = viewer::makeView(entry->inputs, render);
  entry->renderer = std::make_unique<viewer::Renderer>(entry->inputs);
  entry->target = std::make_unique<viewer::gl::Framebuffer>(render.width, render.height);
  entries_.push_back(std::move(entry));
}

SceneComparison TechniqueTrial::compare() {
  const CompiledScene& compiled = scene_.scene.compiled;
  SceneComparison result{
      scene_.scene.name,
      scene_.sky ? "a sky"
                 : fmt::format("{} light{}", compiled.lights.size(), compiled.lights.size() == 1 ? "" : "s"),
      compiled.vertexCount(),
      compiled.triangleCount(),
      options_.techniqueWidth,
      options_.techniqueHeight,
      trace(),
      {}};
  for (const auto& entry : entries_) {
    TechniqueResult& row = result.techniques.emplace_back();
    row.name = entry->technique.name;
    row.thesis = entry->technique.thesis;
    row.firstPass = entry->firstPass;
    row.secondPass = entry->secondPass;
    row.bytes = fileBytes(scene_, entry->bake);
    const Picture picture = viewer::renderView(*entry->renderer, entry->view, pictureSamplesPerAxis);
    row.rmse = pictureRmse(picture, result.truth.picture);
    row.displayed = displayed(picture);
    row.flip = flip(row.displayed, result.truth.displayed, result.width, result.height);
  }
  measureFrames(result.techniques);
  return result;
}

void TechniqueTrial::measureFrames(std::vector<TechniqueResult>& results) {
  std::vector<Contender> contenders;
  for (const auto& entry : entries_)
    contenders.push_back({entry->technique.name, [&](std::size_t) { entry->frame(std::nullopt); }});
  takeTurns(contenders, 1, options_.techniqueFrames, progress_);
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    results[i].frameSeconds = medianSeconds(contenders[i].seconds, 1);
    results[i].frameProcessorSeconds = medianSeconds(contenders[i].cpuSeconds, 1);
  }
}

Picture TechniqueTrial::traceHalf(std::uint64_t seed, Truth& truth) {
  const viewer::View& view = entries_.front()->view;
  const reference::ReferenceInputs inputs{
      scene_.scene.compiled, scene_.scene.scene.images,           view.lights,
      view.camera,           scene_.sky ? &*scene_.sky : nullptr, 0.0};
  reference::ReferenceRequest request;
  request.samples = std::max<std::uint64_t>(options_.techniqueSamples / 2, 1);
  request.seed = seed;
  request.width = options_.techniqueWidth;
  request.height = options_.techniqueHeight;
  reference::Film film(request.width, request.height);
  reference::ReferenceReport report;
  StopOnly quiet(progress_);
  reference::renderReference(
      inputs, request, device_, quiet, [] {}, film, report);
  truth.samples += film.passes * reference::samplesPerPass(request);
  truth.seconds += report.seconds;
  return film.picture();
}

Truth TechniqueTrial::trace() {
  Truth truth;
  truth.picture = traceHalf(0, truth);
  const Picture other = traceHalf(1, truth);
  // The halves differ by sqrt(2) of a half's error, which is sqrt(2) of their mean's.
  truth.rmse = 0.5 * pictureRmse(truth.picture, other);
  truth.flip = flip(displayed(truth.picture), displayed(other), other.width, other.height);
  for (std::size_t i = 0; i < other.pixels.size(); ++i)
    truth.picture.pixels[i] = 0.5f * (truth.picture.pixels[i] + other.pixels[i]);
  truth.displayed = displayed(truth.picture);
  return truth;
}

std::vector<Curve> TechniqueTrial::framesByLights(const std::vector<std::size_t>& counts) {
  std::vector<std::vector<Light>> lights;
  for (const std::size_t count : counts) {
    lights.emplace_back();
    for (const glm::dvec3& place : lightsAround(scene_.scene.compiled, count)) {
      Light light;
      light.position = scene_.scene.compiled.origin + place;
      light.intensity = glm::vec3(static_cast<float>(curveIntensity / static_cast<double>(count)));
      lights.back().push_back(light);
    }
  }
  std::vector<Contender> contenders;
  for (const auto& entry : entries_)
    for (const std::vector<Light>& some : lights)
      contenders.push_back({entry->technique.name, [&](std::size_t) { entry->frame(some); }});
  takeTurns(contenders, 1, options_.techniqueFrames, progress_);
  std::vector<Curve> curves;
  constexpr std::array<const char*, 4> colors = {"#6b7178", "#2f6db5", "#d9822b", "#3a8f5c"};
  for (std::size_t e = 0; e < entries_.size(); ++e) {
    Curve curve{entries_[e]->technique.name, colors[e % colors.size()], CurveStyle::Strong, {}};
    for (std::size_t i = 0; i < counts.size(); ++i)
      curve.points.push_back(
          {static_cast<double>(counts[i]), 1.0 / leastSeconds(contenders[e * counts.size() + i].seconds, 1)});
    curves.push_back(std::move(curve));
  }
  return curves;
}

}  // namespace prelight::benchmarks
