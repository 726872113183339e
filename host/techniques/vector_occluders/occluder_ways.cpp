#include "techniques/vector_occluders/occluder_ways.h"

#include <algorithm>
#include <limits>

#include "gpu/surface_upload.h"
#include "occluders/occluder_vectors.h"
#include "scene/lobes.h"

namespace prelight {

namespace {

using namespace device;

constexpr std::uint32_t mostFaces = 16;  // of glass in a row; what is behind more is as good as blocked

}  // namespace

std::vector<std::uint32_t> occluderFlags(const CompiledScene& scene) {
  std::vector<std::uint32_t> flags;
  for (const CompiledMaterial& m : scene.materials)
    flags.push_back((m.doubleSided ? PRELIGHT_OCCLUDER_TWO_SIDED : 0u) |
                    (isShiny(m) ? PRELIGHT_OCCLUDER_SHINY : 0u) |
                    (isGlass(m) ? PRELIGHT_OCCLUDER_GLASS : 0u));
  return flags;
}

OccluderWays::OccluderWays(const CompiledScene& scene, const DeviceScene& told,
                           const BuildOptions& surfaceOptions, std::size_t rays)
    : scene_(told),
      hasMirrors_(hasShine(scene)),
      hasGlass_(prelight::hasGlass(scene)),
      reach_(static_cast<float>(std::min(freeReach(scene), double(std::numeric_limits<float>::max())))),
      mostRays_(static_cast<std::uint32_t>(rays)),
      marks_(told.context(), rays),
      ways_(told.context(), PRELIGHT_WAYS * rays),
      mirrorHits_(told.context(), hasMirrors_ ? rays : 0) {
  DeviceContext& device = told.context();
  const char* file = "techniques/vector_occluders/occluder_way_kernels.cl";
  scene_.setPlainShading(scene);
  queue_.emplace(device, mostRays_);
  if (hasMirrors_) {
    listMirrored_ = {device, file, surfaceOptions, "listMirrored"};
    numberMirrored_ = {device, file, surfaceOptions, "numberMirrored"};
    mirrorRays_ = Buffer<Ray>(device, 2 * rays);
  }
  if (!hasGlass_) return;
  listGlass_ = {device, file, surfaceOptions, "listGlass"};
  startGlass_ = {device, file, surfaceOptions, "startGlass"};
  followGlass_ = {device, file, surfaceOptions, "followGlass"};
  pathHits_ = Buffer<Hit>(device, rays);
  pathRays_ = Buffer<Ray>(device, 2 * rays);
  paths_ = Buffer<GlassPath>(device, 2 * rays);
}

void OccluderWays::cast(const CastBlockBuffers& block, std::size_t rays, Tracer& tracer) {
  if (hasMirrors_) castMirrored(block, rays, tracer);
  if (hasGlass_) castThrough(block, rays, tracer);
}

void OccluderWays::castMirrored(const CastBlockBuffers& block, std::size_t rays, Tracer& tracer) {
  listMirrored_.launch(rays, block.parameters, scene_.layoutBuffer(), scene_.surface(), scene_.shading(),
                       scene_.occluders(), block.rays, block.hits, reach_, ways_, mirrorRays_, marks_);
  const std::uint32_t count = queue_->list(marks_, static_cast<std::uint32_t>(rays))[0];
  if (count == 0) return;
  numberMirrored_.launch(count, count, queue_->first(0), queue_->lists(), ways_);
  queue_->move(0, count, QueuedItems<Ray>{mirrorRays_, 0, mirrorRays_, mostRays_});
  tracer.traceAny(mirrorRays_, mirrorHits_, count, mostRays_);
  rays_ += count;
}

void OccluderWays::castThrough(const CastBlockBuffers& block, std::size_t rays, Tracer& tracer) {
  listGlass_.launch(rays, block.parameters, scene_.layoutBuffer(), scene_.surface(), scene_.occluders(),
                    block.hits, ways_, marks_);
  std::uint32_t count = queue_->list(marks_, static_cast<std::uint32_t>(rays))[0];
  if (count > 0)
    startGlass_.launch(count, count, queue_->first(0), queue_->lists(), block.rays, block.hits, paths_,
                       pathRays_, pathHits_);
  for (std::uint32_t face = 0; face < mostFaces && count > 0; ++face) {
    if (face > 0) {
      tracer.traceClosest(pathRays_, pathHits_, count);
      rays_ += count;
    }
    followGlass_.launch(count, scene_.layoutBuffer(), GlassStep{count, mostRays_, reach_}, scene_.surface(),
                        scene_.shading(), scene_.occluders(), paths_, pathRays_, pathHits_, ways_, marks_);
    count = queue_->list(marks_, count)[0];
    queue_->move(0, count, QueuedItems<Ray>{pathRays_, mostRays_, pathRays_},
                 QueuedItems<GlassPath>{paths_, mostRays_, paths_});
  }
}

}  // namespace prelight
