#include "benchmarks/suites/techniques/technique_trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numbers>
#include <optional>
#include <set>

#include "benchmarks/run/timing.h"
#include "benchmarks/scenes/compared_scenes.h"
#include "benchmarks/scenes/detailed_scene.h"
#include "benchmarks/scenes/probe_lights.h"
#include "benchmarks/truth/picture_error.h"
#include "gi/global_illumination.h"
#include "gpu/light_tables.h"
#include "integrators/live_virtual_lights.h"
#include "integrators/reference.h"
#include "io/baked_file.h"
#include "relight/object_light.h"
#include "relight/shadowed_transfer.h"
#include "scene/light_shape.h"
#include "techniques/light_map/light_map_file.h"
#include "viewer/frame/view.h"

namespace prelight::benchmarks {

namespace {

VertexRange behind(const CompiledScene& first, const CompiledScene& all) {
  return {first.vertexCount(), all.vertexCount() - first.vertexCount(), first.triangleCount(),
          all.triangleCount() - first.triangleCount()};
}

/// Bakes a scene without the object that was put into it, then appends the SH transfer of the object's
/// vertices, which the bake's volume lights, and adds the object's shadow. `request` has SH, a volume and
/// bounces; `scene.put` has a value.
TimedBake bakeAround(const ComparedScene& scene, const BakeRequest& request, const Device& device,
                     const Progress& progress) {
  const CompiledScene& whole = scene.scene.compiled;
  const CompiledScene& without = scene.put->without.compiled;
  TimedBake baked = timedBake(scene.put->without, request, device, progress);
  const VolumeTransfer volume = std::move(*baked.bake.volume);
  baked.bake.volume.reset();

  BakeRequest own;
  own.sh.order = VolumeReceiver::ownOrder(volume);
  own.effort.rays = request.effort.rays;
  VolumeObject object{behind(without, whole), *timedBake(scene.put->object, own, device, progress).bake.sh};

  HarmonicTransfer& sh = *baked.bake.sh;
  sh.coefficients.resize(std::size_t{whole.vertexCount()} * 3 * volume.columns(), 0.0f);
  ObjectLight light(whole, {without.triangleCount(), whole.triangleCount()}, volume, nullptr, device);
  const VertexRange rest{0, without.vertexCount(), 0, without.triangleCount()};
  ShadowedTransfer shadowed(whole, rest, baked.bake, light);
  baked.report.stageSeconds.emplace_back(
      "object", secondsOf([&] {
        const ObjectTransfer lit = light.transferOf(whole, object);
        std::copy(
            lit.sh.begin(), lit.sh.end(),
            sh.coefficients.begin() +
                static_cast<std::ptrdiff_t>(std::size_t{object.range.firstVertex} * 3 * volume.columns()));
        const std::array<VertexRange, 1> objects = {object.range};
        shadowed.writeTo(whole, objects, baked.bake);
      }));
  return baked;
}

constexpr double degree = std::numbers::pi / 180.0;
constexpr std::uint64_t warmingTriangles = 1000, warmingRays = 8;  // enough to compile all kernels
constexpr int pictureSamplesPerAxis = 3;
constexpr std::uint32_t fullMapTexels = 1u << 14;  // texels of the indirect light light of full shading
constexpr std::uint64_t virtualPaths = 256;        // paths of instant shading
constexpr double claimedShare = 0.1;               // share of a truth's seconds for each truth of less light
constexpr double leastTruthShare = 0.25;  // least share of a scene's seconds, however long its bakes took
constexpr double curveIntensity = 80.0;   // of all lights of the curve together, W/sr

std::size_t fileBytes(const ComparedScene& scene, const Bake& bake) {
  GltfDocument document = scene.document;
  embedBake(document, scene.scene.compiled, bake);
  std::size_t picture = 0;  // bytes before compression
  if (bake.lightMap) {
    embedLightMap(document, scene.scene.compiled, bake.lightMap->layout, "map.exr");
    picture = bake.lightMap->values.size() * sizeof(float);
  }
  return document.bin.size() - scene.document.bin.size() + picture;
}

/// A scene for path tracing, where area lights are surfaces.
class TracedScene {
 public:
  TracedScene(const ComparedScene& compared, std::vector<Light> lights)
      : compared_(compared), lights_(std::move(lights)), scene_(compared.scene.scene) {
    if (!makeSurfacesOf(lights_, scene_)) return;
    Warnings said;
    own_ = compileScene(scene_, said);
  }

  reference::ReferenceInputs inputs(const Camera& camera) const {
    return {own_ ? *own_ : compared_.scene.compiled,
            scene_.images,
            lights_,
            camera,
            compared_.sky ? &*compared_.sky : nullptr,
            0.0};
  }

  /// Returns the request for direct light. With lamps alone, every path asks all of them.
  reference::ReferenceRequest ofDirectLight(reference::ReferenceRequest request) const {
    request.depth = claims::directLight;
    const CompiledScene& scene = own_ ? *own_ : compared_.scene.compiled;
    const bool lampsAlone = !compared_.sky && makeLightTables(scene, {}, nullptr, true).groupCount == 0;
    if (lampsAlone) request.integrator = reference::Integrator::Whitted;
    return request;
  }

 private:
  const ComparedScene& compared_;
  std::vector<Light> lights_;
  Scene scene_;
  std::optional<CompiledScene> own_;
};

/// Returns the view with its lights and sky turned about the vertical through the middle of the scene.
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

void rank(std::vector<TechniqueResult>& techniques) {
  std::vector<TechniqueResult*> best;
  for (TechniqueResult& row : techniques) best.push_back(&row);
  std::sort(best.begin(), best.end(),
            [](const auto* a, const auto* b) { return a->error.rmse < b->error.rmse; });
  for (std::size_t i = 0; i < best.size(); ++i) {
    best[i]->rank = static_cast<int>(i) + 1;
    if (i > 0 && !differ(best[i]->error, best[i - 1]->error)) best[i]->rank = best[i - 1]->rank;
  }
}

TruthShare truthShare(const SceneComparison& scene) {
  const auto best =
      std::min_element(scene.techniques.begin(), scene.techniques.end(),
                       [](const auto& a, const auto& b) { return a.error.rmse < b.error.rmse; });
  const auto [rmse, doubt] = best->error;
  const double error = std::max({rmse, doubt, 1e-12});  // noise hides at most the doubt
  return {scene.truth.rmse / error, doubt / error};
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
  GlobalIllumination globalIllumination;           // light of full shading
  std::optional<LiveVirtualLights> virtualLights;  // paths of instant shading
  double firstPass = 0.0;
  double secondPass = 0.0;
  viewer::RenderInputs inputs;
  viewer::View view;
  std::unique_ptr<viewer::Renderer> renderer;
  std::unique_ptr<viewer::gl::Framebuffer> target;
  double angle = 0.0;  // angle of the last frame

  Entry(const Technique& t, const ComparedScene& scene, const Device& device)
      : technique(t),
        inputs{scene.scene.scene, scene.scene.compiled, &bake, scene.sky ? &*scene.sky : nullptr, &device} {}

  bool isFull() const { return technique.render.shading == viewer::Shading::GlobalIllumination; }
  bool isInstant() const { return technique.render.shading == viewer::Shading::Instant; }

  /// Returns the bytes of the data that a picture is drawn from, in a file, or in memory if files do not hold
  /// it.
  std::size_t bytes(const ComparedScene& scene) const {
    if (isInstant()) return virtualLights->lights().lights.size() * sizeof(device::VirtualLight);
    if (!isFull()) return fileBytes(scene, bake);
    return globalIllumination.indirect.values.size() * sizeof(float) +
           globalIllumination.photons.size() * sizeof(device::Photon);
  }

  /// Draws a frame with the light elsewhere than in the last one, and waits for it.
  void frame(const std::optional<std::vector<Light>>& lights) {
    viewer::View moved = view;
    if (lights) moved.lights = *lights;
    moved = turned(std::move(moved), inputs.compiled, angle += degree);
    renderer->draw(moved, {0, 0, view.width, view.height}, *target);
    viewer::gl::Framebuffer::finish();
  }
};

TechniqueTrial::TechniqueTrial(const ComparedScene& scene, const std::vector<Technique>& techniques,
                               std::uint64_t rays, const Device& device, const TechniquesOptions& options,
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
    TimedBake baked = request.volume.size > 0 && scene_.put
                          ? bakeAround(scene_, request, device_, progress_)
                          : timedBake(scene_.scene, request, device_, progress_);
    for (const auto& [stage, seconds] : baked.report.stageSeconds)
      (stage == "bounce" || stage == "glossy" ? entry->secondPass : entry->firstPass) += seconds;
    if (!canShow(technique, baked.bake)) return;
    entry->bake = std::move(baked.bake);
  }
  if (technique.render.shading == viewer::Shading::Vo) {  // AO is only a by-product here
    entry->bake.ao.clear();
    entry->bake.bentNormals.clear();
  }
  if (entry->isFull()) lightFully(*entry);
  if (entry->isInstant()) makeVirtualLights(*entry);
  viewer::RenderOptions render = technique.render;
  render.width = options_.width;
  render.height = options_.height;
  if (!scene_.lamps.empty()) render.lights = scene_.lamps;
  entry->view = viewer::makeView(entry->inputs, render);
  entry->renderer = std::make_unique<viewer::Renderer>(entry->inputs);
  entry->target = std::make_unique<viewer::gl::Framebuffer>(render.width, render.height);
  entries_.push_back(std::move(entry));
}

void TechniqueTrial::lightFully(Entry& entry) {
  const Scene& scene = scene_.scene.scene;
  const LitScene lit{scene_.scene.compiled, scene.images, scene.lights, entry.inputs.environment, 0.0};
  GlobalIlluminationRequest request;
  request.indirect.directByPhotons = true;  // as when a window opens
  StopOnly quiet(progress_);
  entry.globalIllumination = computeGlobalIllumination(scene, lit, request, fullMapTexels, device_, quiet);
  for (const auto& [stage, seconds] : entry.globalIllumination.stageSeconds) entry.firstPass += seconds;
  entry.inputs.globalIllumination = &entry.globalIllumination;
}

void TechniqueTrial::makeVirtualLights(Entry& entry) {
  StopOnly quiet(progress_);
  const auto start = std::chrono::steady_clock::now();
  entry.virtualLights.emplace(scene_.scene.scene, scene_.scene.compiled, entry.inputs.environment, 0.0,
                              InstantOptions{.paths = virtualPaths}, device_, quiet);
  entry.firstPass = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  entry.inputs.virtualLights = &entry.virtualLights->lights();
}

TechniqueResult TechniqueTrial::draw(Entry& entry) const {
  TechniqueResult row;
  row.name = entry.technique.name;
  row.thesis = entry.technique.thesis;
  row.claim = entry.technique.claim;
  row.firstPass = entry.firstPass;
  row.secondPass = entry.secondPass;
  row.bytes = entry.bytes(scene_);
  row.picture = viewer::renderView(*entry.renderer, entry.view, pictureSamplesPerAxis);
  row.displayed = displayed(row.picture);
  return row;
}

SceneComparison TechniqueTrial::compare(const Deadline& end, double seconds) {
  const CompiledScene& compiled = scene_.scene.compiled;
  SceneComparison result{scene_.scene.name,
                         scene_.light(),
                         compiled.vertexCount(),
                         compiled.triangleCount(),
                         options_.width,
                         options_.height,
                         {}};
  for (const auto& entry : entries_) result.techniques.push_back(draw(*entry));
  measureFrames(result.techniques);
  compareWithTruths(result, std::max(end.left(), leastTruthShare * seconds));
  return result;
}

void TechniqueTrial::compareWithTruths(SceneComparison& result, double seconds) const {
  const viewer::View& view = entries_.front()->view;
  const TracedScene traced(scene_, view.lights);
  const reference::ReferenceInputs inputs = traced.inputs(view.camera);
  reference::ReferenceRequest request;
  request.width = result.width;
  request.height = result.height;
  request.samples = std::max<std::uint64_t>(options_.samples / 2, 1);
  // Light of paths of two segments, of three, and of more.
  TracedLight direct(inputs, traced.ofDirectLight(request), device_, progress_);
  const auto ofLengths = [&](int least, int most) {
    request.leastDepth = least;
    request.depth = most;
    return request;
  };
  TracedLight bounce(inputs, ofLengths(claims::directLight + 1, claims::oneBounce), device_, progress_);
  TracedLight rest(inputs, ofLengths(claims::oneBounce + 1, claims::allLight), device_, progress_);
  const std::array<TracedLight*, 3> parts = {&direct, &bounce, &rest};
  if (!options_.truths.empty())
    for (TracedLight* part : parts) part->restore(options_.truths);
  // The truth of all light comes first; the truths of less light reuse its parts.
  const auto trace = [&](int claim, double most, MeasuredError TechniqueResult::*error) {
    const std::size_t count = claim == claims::directLight ? 1 : claim == claims::oneBounce ? 2 : 3;
    Truth found =
        traceTruth(std::span(parts).first(count), {options_.samples, most}, [&](const Truth& truth) {
          double best = std::numeric_limits<double>::infinity();
          for (TechniqueResult& row : result.techniques) {
            if (claim != claims::allLight && row.claim != claim) continue;
            row.*error = errorBetween(row.picture, truth.first, truth.second);
            best = std::min(best, (row.*error).rmse);
          }
          return truth.rmse <= wantedShare * best;
        });
    found.depth = claim;
    return found;
  };
  result.truth = trace(claims::allLight, seconds, &TechniqueResult::error);
  std::set<int> claimed;
  for (TechniqueResult& row : result.techniques) {
    row.ofClaim = row.error;
    if (row.claim != claims::allLight) claimed.insert(row.claim);
  }
  for (const int claim : claimed)
    result.claimed.push_back(trace(claim, claimedShare * seconds, &TechniqueResult::ofClaim));
  if (!options_.truths.empty())
    for (const TracedLight* part : parts) part->save(options_.truths);
  rank(result.techniques);
  measureFlips(result);
}

void TechniqueTrial::measureFlips(SceneComparison& result) {
  const std::vector<glm::vec3> first = displayed(result.truth.first), second = displayed(result.truth.second);
  std::vector<DisplayedPair> pairs = {{first, second}};
  for (const TechniqueResult& row : result.techniques)
    pairs.push_back({result.truth.displayed, row.displayed});
  const std::vector<double> flips = measureFlip(pairs, result.width, result.height);
  if (flips.empty()) return;
  result.truthFlip = flips.at(0);
  for (std::size_t i = 0; i < result.techniques.size(); ++i) result.techniques[i].flip = flips.at(i + 1);
}

void TechniqueTrial::measureFrames(std::vector<TechniqueResult>& results) {
  std::vector<Contender> contenders;
  for (const auto& entry : entries_)
    contenders.push_back({entry->technique.name, [&](std::size_t) { entry->frame(std::nullopt); }});
  takeTurns(contenders, 1, options_.frames, progress_);
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    results[i].frameSeconds = medianSeconds(contenders[i].seconds, 1);
    results[i].frameProcessorSeconds = medianSeconds(contenders[i].cpuSeconds, 1);
  }
}

std::vector<FrameCurve> TechniqueTrial::framesByLights(const std::vector<std::size_t>& counts) {
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
  takeTurns(contenders, 1, options_.frames, progress_);
  std::vector<FrameCurve> curves;
  for (std::size_t e = 0; e < entries_.size(); ++e) {
    FrameCurve curve{entries_[e]->technique.name, {}};
    for (std::size_t i = 0; i < counts.size(); ++i)
      curve.points.push_back(
          {static_cast<double>(counts[i]), 1.0 / leastSeconds(contenders[e * counts.size() + i].seconds, 1)});
    curves.push_back(std::move(curve));
  }
  return curves;
}

}  // namespace prelight::benchmarks
