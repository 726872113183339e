#include "integrators/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "base/kept_work.h"
#include "base/spans.h"
#include "base/text.h"
#include "base/work_share.h"
#include "integrators/guide_tracer.h"
#include "integrators/path_tracer.h"
#include "prelight/error.h"
#include "scene/scene_hash.h"

namespace prelight::reference {

namespace {

constexpr std::uint32_t openEndedSamples = 8;        ///< per pass, if the number of samples is not known
constexpr std::uint32_t openEndedMovingSamples = 2;  ///< per pass while a shutter is open
constexpr std::uint32_t mostSamples = 64;
constexpr std::uint64_t leastPasses = 8;  ///< least passes of a picture with enough samples
/// Least passes while a shutter is open: each shows one moment, and few moments look like ghosts.
constexpr std::uint64_t leastMoments = 64;
/// The error estimate of fewer passes is too uncertain to stop by.
constexpr std::uint64_t passesBeforeError = 16;

constexpr std::uint64_t guideSamples = 16;  ///< more samples would not improve denoising

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class Goal {
 public:
  explicit Goal(const ReferenceRequest& request)
      : request_(request), passes_(std::max<std::uint64_t>(1, request.samples / samplesPerPass(request))) {}

  /// Number of passes, where neither an error nor a time is asked for.
  std::uint64_t passes() const { return passes_; }

  bool isMet(const Film& film, double seconds) const {
    if (request_.error) return film.passes >= passesBeforeError && film.relativeError() <= *request_.error;
    if (request_.seconds) return film.passes >= 1 && seconds >= *request_.seconds;
    return film.passes >= passes_;
  }

  /// Returns the share of the work that is done, in [0,1].
  double fraction(const Film& film, double seconds) const {
    const double within = static_cast<double>(film.blockPixels) / static_cast<double>(film.pixelCount());
    if (request_.seconds) return std::min(1.0, seconds / *request_.seconds);
    if (!request_.error) return (static_cast<double>(film.passes) + within) / static_cast<double>(passes_);
    if (film.passes < 2) return 0.0;
    const double ratio = *request_.error / film.relativeError();  // the error falls with the root of the work
    return std::min({1.0, ratio * ratio, static_cast<double>(film.passes) / passesBeforeError});
  }

 private:
  const ReferenceRequest& request_;
  std::uint64_t passes_;
};

}  // namespace

std::string_view integratorName(Integrator integrator) {
  switch (integrator) {
    case Integrator::Whitted:
      return "whitted";
    case Integrator::Distributed:
      return "distributed";
    case Integrator::Instant:
      return "instant";
    case Integrator::Path:
      break;
  }
  return "path";
}

std::uint32_t samplesPerPass(const ReferenceRequest& request) {
  if (request.integrator == Integrator::Instant) return 1;  // every pass has new virtual lights
  if (request.samplesPerPass > 0) return request.samplesPerPass;
  const bool moves = request.shutter > 0.0;
  if (request.error || request.seconds) return moves ? openEndedMovingSamples : openEndedSamples;
  const std::uint64_t most =
      std::clamp<std::uint64_t>(request.samples / (moves ? leastMoments : leastPasses), 1, mostSamples);
  for (std::uint64_t samples = most; samples > 1; --samples)
    if (request.samples % samples == 0) return static_cast<std::uint32_t>(samples);
  return 1;
}

namespace {

/// The scene and the paths of one pass, or of all passes if nothing moves.
struct PassTracer {
  TransportScene scene;
  PathTracer paths;

  PassTracer(const ReferenceInputs& inputs, const ReferenceRequest& request, const Device& device)
      : scene({inputs.scene, inputs.images, inputs.lights, inputs.sky, inputs.skyRotation}, device,
              request.integrator != Integrator::Whitted),
        paths(scene, inputs.scene, inputs.camera, request) {}
};

/// Makes the tracers of passes, one after another: a scene that moves has a hierarchy of its own per pass.
class PassTracers {
 public:
  /// The referents must outlive it.
  PassTracers(const ReferenceInputs& inputs, const ReferenceRequest& request, const Device& device)
      : inputs_(inputs), request_(request), device_(device) {}

  PassTracer& of(std::uint64_t pass) {
    if (now_ && (pass_ == pass || !inputs_.ofPass)) return *now_;
    if (now_) raysBefore_ += now_->paths.rays();
    now_.reset();  // before the inputs that it refers to
    now_ = std::make_unique<PassTracer>(inputs_.ofPass ? inputs_.ofPass(pass) : inputs_, request_, device_);
    pass_ = pass;
    return *now_;
  }

  std::uint64_t rays() const { return raysBefore_ + (now_ ? now_->paths.rays() : 0); }

 private:
  const ReferenceInputs& inputs_;
  const ReferenceRequest& request_;
  const Device& device_;
  std::unique_ptr<PassTracer> now_;
  std::uint64_t pass_ = 0;
  std::uint64_t raysBefore_ = 0;  ///< of earlier tracers
};

/// Focuses the lens as the request says, and notes what was chosen.
Lens focusedLens(const ReferenceInputs& inputs, const ReferenceRequest& request, ReferenceReport& report) {
  const Lens lens = focused(request.lens, inputs.camera, inputs.scene);
  if (lens.isPinhole() || request.lens.focus) return lens;
  report.notes.push_back(
      *lens.focus < infiniteFocus
          ? fmt::format("in focus at {:.4g} m, where the middle of the picture meets the scene", *lens.focus)
          : "in focus at infinity, because the middle of the picture meets nothing");
  return lens;
}

}  // namespace

namespace {

/// Traces a film block by block. Processes may divide the blocks.
class FilmBlocks {
 public:
  FilmBlocks(WorkPart& part, Film& film, std::uint64_t passes)
      : film_(film),
        loop_(part, "film"),
        piece_(SharedLoop::pieceSize(passes * film.pixelCount(), leastPiece, film.pixelCount())) {}

  /// Adds the next block of the film's current pass.
  void addNext(PathTracer& tracer) {
    const std::uint64_t most =
        loop_.divided() ? std::min<std::uint64_t>(piece_, tracer.blockPixels()) : tracer.blockPixels();
    const std::uint64_t count = std::min(most, film_.pixelCount() - film_.blockPixels);
    means_.assign(count, glm::vec4(0.0f));
    parts_.assign(film_.parts.empty() ? 0 : tracedParts * count, glm::vec4(0.0f));
    const auto trace = [&] {
      means_ = tracer.trace(film_.passes, static_cast<std::uint32_t>(film_.blockPixels),
                            static_cast<std::uint32_t>(count));
      parts_ = tracer.parts();
    };
    loop_.run({film_.passes * film_.pixelCount() + film_.blockPixels, count}, trace, [&](auto& state) {
      for (std::vector<glm::vec4>* values : {&means_, &parts_}) {
        state.sameSize(*values);
        state.requireFinite(numbersOf(*values));
      }
    });
    film_.add(means_, parts_);
  }

  void end() { loop_.end(); }

 private:
  static constexpr std::uint64_t leastPiece = 1u << 12;  // pixels

  Film& film_;
  SharedLoop loop_;
  std::uint64_t piece_;
  std::vector<glm::vec4> means_;  ///< of the block, [pixel], as PathTracer::trace() returns them
  std::vector<glm::vec4> parts_;  ///< as PathTracer::parts()
};

}  // namespace

void renderReference(const ReferenceInputs& inputs, const ReferenceRequest& asked, const Device& device,
                     Progress& progress, Film& film, ReferenceReport& report) {
  if (asked.guides && inputs.ofPass)
    throw UsageError("ReferenceRequest::guides",
                     "a denoiser's guides show one moment, and the shutter is open for longer",
                     "leave out the denoising or the shutter");
  ReferenceRequest request = asked;
  request.lens = focusedLens(inputs, asked, report);
  PassTracers tracers(inputs, request, device);
  report.plan = explainFeatures(tracers.of(film.passes).scene.features(), request);
  const Goal goal(request);
  const Clock::time_point start = Clock::now();
  WorkPart part(progress, "film", [&](auto& state) { exchangeFilm(state, film); });
  const auto account = [&] {
    report.rays = tracers.rays();
    report.seconds = secondsSince(start);
  };
  const auto met = [&] { return goal.isMet(film, secondsSince(start)); };
  if (!met()) {
    FilmBlocks blocks(part, film, goal.passes());
    do {
      PathTracer& tracer = tracers.of(film.passes).paths;
      do {
        progress.report("reference", goal.fraction(film, secondsSince(start)));
        account();
        progress.check();
        blocks.addNext(tracer);
        part.advance();
      } while (film.blockPixels != 0);
    } while (!met());
    blocks.end();
  }
  part.finish(request.seconds.has_value());
  account();
  if (!request.guides) return;
  GuideTracer guides(tracers.of(0).scene, inputs.scene, inputs.camera, request);
  report.guides = guides.trace(
      std::clamp<std::uint64_t>(guideSamples / samplesPerPass(request), 1, film.passes), progress);
  report.rays += guides.rays();
  report.seconds = secondsSince(start);
}

namespace {

void addVector(StateHash& hash, const glm::dvec3& v) { hash.value(v.x).value(v.y).value(v.z); }

std::uint64_t sceneHash(const ReferenceInputs& inputs) {
  const CompiledScene& s = inputs.scene;
  StateHash hash;
  addVector(hash, s.origin);
  hash.values(s.positions).values(s.normals).values(s.colors).values(s.triangles);
  hash.values(s.texCoords).values(s.texCoords1).values(s.tangents);
  hash.values(s.triangleMaterials).values(s.triangleFlat);
  for (const CompiledMaterial& m : s.materials) addMaterial(m, hash);
  for (const Image& image : inputs.images) hash.value(image.width).value(image.height).values(image.rgba);
  return hash.result();
}

std::uint64_t lightsHash(const std::vector<Light>& lights) {
  StateHash hash;
  for (const Light& light : lights) addLight(light, hash);
  return hash.result();
}

std::uint64_t cameraHash(const Camera& camera) {
  StateHash hash;
  for (int column = 0; column < 4; ++column) addVector(hash, glm::dvec3(camera.world[column]));
  hash.value(camera.perspective ? 1 : 0);
  for (const double v : {camera.yFov, camera.zNear, camera.zFar, camera.xMag, camera.yMag}) hash.value(v);
  return hash.result();
}

std::uint64_t skyHash(const ReferenceInputs& inputs) {
  StateHash hash;
  hash.value(inputs.skyRotation);
  if (inputs.sky != nullptr)
    hash.value(inputs.sky->width).value(inputs.sky->height).values(inputs.sky->radiance);
  return hash.result();
}

std::uint64_t lensHash(const Lens& lens) {
  return StateHash()
      .value(lens.aperture)
      .value(lens.fNumber)
      .value(lens.focus.has_value() ? 1 : 0)
      .value(lens.focus.value_or(0.0))
      .result();
}

std::uint64_t effortHash(const ReferenceRequest& request) {
  return StateHash()
      .value(request.samples)
      .value(request.error.value_or(0.0))
      .value(request.seconds.value_or(0.0))
      .result();
}

}  // namespace

StateKey filmKey(const ReferenceInputs& inputs, const ReferenceRequest& request, const DeviceInfo& device) {
  const auto number = [](auto value) { return StateHash().value(value).result(); };
  return {
      {"scene", sceneHash(inputs)},
      {"lights", lightsHash(inputs.lights)},
      {"camera", cameraHash(inputs.camera)},
      {"sky or rotation of it", skyHash(inputs)},
      {"size", StateHash().value(request.width).value(request.height).result()},
      {"integrator", number(static_cast<int>(request.integrator) + 4 * static_cast<int>(request.estimator))},
      {"number of light paths", number(request.lightPaths)},
      {"depth", number(request.depth + 65536 * request.rouletteDepth)},
      {"effort (samples, error or time)", effortHash(request)},
      {"seed", number(request.seed)},
      {"lens", lensHash(request.lens)},
      {"shutter", number(request.shutter)},
      {"animation or moment", number(inputs.motion)},
      {"parts of the picture", number(request.parts ? 1 : 0)},
      {"device", StateHash().text(device.name).text(device.driverVersion).result()},
      {"version of Prelight", StateHash().text(PRELIGHT_VERSION).result()}};
}

}  // namespace prelight::reference
