#include "integrators/guide_tracer.h"

#include <algorithm>
#include <utility>

#include "base/kept_work.h"
#include "integrators/camera_rays.h"

namespace prelight::reference {

namespace {

using namespace device;

constexpr std::uint32_t guidesPerBlock = 1u << 16;
constexpr std::uint64_t leastCleanSamples = 4;  ///< guides of fewer samples have jagged edges

}  // namespace

GuideTracer::GuideTracer(TransportScene& scene, const CompiledScene& compiled, const Camera& camera,
                         const ReferenceRequest& request)
    : scene_(scene),
      request_(request),
      blockPixels_(std::clamp(guidesPerBlock / samplesPerPass(request), 1u,
                              static_cast<std::uint32_t>(request.width * request.height))),
      mostPaths_(blockPixels_ * samplesPerPass(request)),
      parameters_(scene.context(), 1),
      paths_(scene.context(), mostPaths_),
      rayBuffer_(scene.context(), 2 * std::size_t{mostPaths_}),
      numbers_(scene.context(), mostPaths_),
      nextNumbers_(scene.context(), mostPaths_),
      hits_(scene.context(), mostPaths_),
      marks_(scene.context(), mostPaths_),
      queue_(scene.context(), mostPaths_),
      meanBuffer_(scene.context(), 2 * std::size_t{blockPixels_}) {
  setPathParameters(request, scene, values_);
  setCamera(camera, compiled, request.width, request.height, values_);
  setLens(request.lens, values_);
  const char* file = "integrate/guide_kernels.cl";
  ReferenceRequest sharp;  // sharp reflections are followed for any integrator of the picture
  sharp.lens = request.lens;
  const BuildOptions options = buildOptions(sharp, std::nullopt, scene.options());
  generate_ = {scene.context(), file, options, "generatePaths"};
  follow_ = {scene.context(), file, options, "followGuides"};
  average_ = {scene.context(), file, options, "averageGuides"};
  if (scene.features().culled) culled_.emplace(scene, file, options, mostPaths_);
}

Guides GuideTracer::trace(std::uint64_t passes, const Progress& progress) {
  const auto pixels = static_cast<std::uint32_t>(request_.width * request_.height);
  Guides guides{std::vector<glm::vec3>(pixels, glm::vec3(0.0f)),
                std::vector<glm::vec3>(pixels, glm::vec3(0.0f))};
  const float share = 1.0f / static_cast<float>(passes);
  std::uint64_t pass = 0;
  std::uint32_t pixel = 0;
  WorkPart part(progress, "guides", [&](auto& state) {
    state.value(pass);
    state.value(pixel);
    state.value(rays_);
    state.sameSize(guides.albedo);
    state.sameSize(guides.normal);
    state.requireFinite(numbersOf(guides.albedo));
    state.requireFinite(numbersOf(guides.normal));
    state.require(pass <= passes && pixel < pixels);
  });
  while (pass < passes) {
    progress.check();
    const std::uint32_t count = std::min(blockPixels_, pixels - pixel);
    traceBlock(pass, pixel, count);
    for (std::uint32_t i = 0; i < count; ++i) {
      guides.albedo[pixel + i] += share * glm::vec3(means_[2 * i]);
      guides.normal[pixel + i] += share * glm::vec3(means_[2 * i + 1]);
    }
    pixel += count;
    if (pixel == pixels) ++pass;
    if (pixel == pixels) pixel = 0;
    part.advance();
  }
  part.finish();
  const std::uint64_t first = passes * values_.samplesPerPass * pixels;
  guides.noisy = passes * values_.samplesPerPass < leastCleanSamples || rays_ > first;
  return guides;
}

void GuideTracer::traceBlock(std::uint64_t pass, std::uint32_t first, std::uint32_t count) {
  values_.pass = static_cast<std::uint32_t>(pass);
  values_.firstPixel = first;
  values_.pathCount = count * values_.samplesPerPass;
  parameters_.write(std::span<const ReferenceParameters>(&values_, 1));
  std::uint32_t active = values_.pathCount;
  generate_.launch(active, parameters_, paths_, numbers_, rayBuffer_);
  const DeviceScene& scene = scene_.handle();
  for (std::uint32_t depth = 0; active > 0; ++depth) {
    scene_.tracer().traceClosest(rayBuffer_, hits_, active, 0);
    rays_ += active;
    if (culled_)
      culled_->lookThrough({parameters_, active, rayBuffer_, hits_, numbers_, paths_}, marks_, queue_);
    PathStep step{};
    step.count = active;
    step.depth = depth;
    step.next = mostPaths_;
    step.goesOn = depth + 1 < static_cast<std::uint32_t>(request_.depth) ? 1 : 0;
    follow_.launch(active, parameters_, step, scene.surface(), scene.shading(), scene.lights(), rayBuffer_,
                   hits_, numbers_, paths_, marks_);
    active = queue_.list(marks_, active)[PRELIGHT_PATH_NEXT];
    queue_.move(PRELIGHT_PATH_NEXT, active, QueuedItems<Ray>{rayBuffer_, mostPaths_, rayBuffer_, 0},
                QueuedItems<std::uint32_t>{numbers_, 0, nextNumbers_});
    std::swap(numbers_, nextNumbers_);
  }
  average_.launch(count, parameters_, paths_, meanBuffer_);
  means_.resize(2 * std::size_t{count});
  meanBuffer_.read(std::span(means_));
}

}  // namespace prelight::reference
