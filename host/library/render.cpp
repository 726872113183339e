#include "prelight/render.h"

#include <memory>
#include <utility>

#include "denoise/denoiser.h"
#include "integrators/global_illumination_renderer.h"
#include "integrators/reference.h"
#include "library/library_call.h"
#include "library/open_scene.h"
#include "prelight/options.h"
#include "scene/camera.h"

namespace prelight {

namespace {

constexpr NumberRange gatheredSamples{NumberKind::Whole, 1.0, 64.0};

Camera cameraOf(const LoadedScene& scene, const RenderOptions& options) {
  if (options.camera) return *options.camera;
  return scene.scene.cameras.empty() ? frameCamera(scene.compiled) : scene.scene.cameras.front();
}

void check(const RenderOptions& options) {
  requireRanges(options);
  if (options.method == RenderMethod::GlobalIllumination && !gatheredSamples.allows(options.samples))
    refuseNumber("RenderOptions::samples", options.samples, gatheredSamples);
}

reference::Integrator integratorOf(RenderMethod method) {
  if (method == RenderMethod::Distributed) return reference::Integrator::Distributed;
  return method == RenderMethod::Whitted ? reference::Integrator::Whitted : reference::Integrator::Path;
}

/// Loads the denoiser before the picture is rendered, as it may be missing.
std::unique_ptr<Denoiser> denoiserOf(const RenderOptions& options) {
  return options.denoise ? std::make_unique<Denoiser>() : nullptr;
}

Picture finished(Picture picture, const Guides& guides, Denoiser* denoiser, DenoiseEffort effort,
                 LibraryCall& call) {
  return denoiser != nullptr ? denoiser->denoise(picture, guides, effort, call.progress())
                             : std::move(picture);
}

ReferencePicture tracePaths(const LitScene& lit, const Camera& camera, const RenderOptions& options,
                            const ReferenceGoal& goal, LibraryCall& call) {
  reference::ReferenceRequest request;
  request.error = goal.error;
  request.seconds = goal.seconds;
  request.integrator = integratorOf(options.method);
  request.depth = options.depth;
  request.samples = options.samples;
  request.seed = options.seed;
  request.width = options.width;
  request.height = options.height;
  request.guides = options.denoise;
  const std::unique_ptr<Denoiser> denoiser = denoiserOf(options);
  const reference::ReferenceInputs inputs{lit.scene, lit.images, lit.lights,
                                          camera,    lit.sky,    lit.skyRotation};
  reference::Film film(request.width, request.height);
  reference::ReferenceReport report;
  reference::renderReference(inputs, request, call.device(), call.progress(), film, report);
  const std::uint64_t samples = film.passes * reference::samplesPerPass(request);
  return {finished(film.picture(), report.guides, denoiser.get(), DenoiseEffort::Full, call),
          film.variance(),
          film.relativeError(),
          samples,
          report.rays,
          report.seconds};
}

Picture illuminate(const Scene& scene, const LitScene& lit, const Camera& camera,
                   const RenderOptions& options, LibraryCall& call) {
  GlobalIlluminationPictureRequest request;
  request.width = options.width;
  request.height = options.height;
  request.samples = options.samples;
  request.depth = options.depth;
  request.seed = request.indirect.seed = options.seed;
  request.guides = options.denoise;
  const std::unique_ptr<Denoiser> denoiser = denoiserOf(options);
  GlobalIlluminationPictureReport report;
  Picture picture =
      renderGlobalIllumination(scene, lit, camera, request, call.device(), call.progress(), report);
  return finished(std::move(picture), report.guides, denoiser.get(), DenoiseEffort::Quick, call);
}

/// The checked input of a picture.
struct Drawing {
  Camera camera;
  RenderOptions options;  ///< with the final width
  LibraryCall call;
  LitScene lit;

  Drawing(const LoadedScene& scene, const RenderOptions& wanted)
      : camera(cameraOf(scene, wanted)),
        options(wanted),
        call(wanted.device, wanted.progress),
        lit(litScene(scene, wanted.lights, wanted.sky, wanted.skyRotation)) {
    requireTriangles(scene.path, scene.compiled, "to draw");
    if (options.width == 0) options.width = pictureWidth(camera, wanted.height);
    requireRanges(options);  // again, because extreme aspect ratios give widths out of range
  }
};

}  // namespace

Picture render(const LoadedScene& scene, const RenderOptions& options) {
  check(options);
  Drawing drawing(scene, options);
  if (options.method == RenderMethod::GlobalIllumination)
    return illuminate(scene.scene, drawing.lit, drawing.camera, drawing.options, drawing.call);
  return tracePaths(drawing.lit, drawing.camera, drawing.options, {}, drawing.call).picture;
}

ReferencePicture drawReference(const LoadedScene& scene, const RenderOptions& options,
                               const ReferenceGoal& goal) {
  if (options.method == RenderMethod::GlobalIllumination)
    throw UsageError("RenderOptions::method",
                     "got GlobalIllumination, whose bias no number of samples removes",
                     "choose Path, Distributed or Whitted");
  requireRanges(goal);
  check(options);
  Drawing drawing(scene, options);
  return tracePaths(drawing.lit, drawing.camera, drawing.options, goal, drawing.call);
}

}  // namespace prelight
