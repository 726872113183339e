#include "cast/occluder_ways.h"

#include <algorithm>
#include <limits>

#include "gpu/surface_upload.h"
#include "occluders/occluder_vectors.h"
#include "scene/lobes.h"

namespace prelight {

namespace {

using namespace device;

constexpr std::size_t groupSize = 64;
constexpr int mostFaces = 16;  // of glass in a row; what is behind more is as good as blocked

}  // namespace

std::vector<std::uint32_t> occluderFlags(const CompiledScene& scene) {
  std::vector<std::uint32_t> flags;
  for (const CompiledMaterial& m : scene.materials)
    flags.push_back((m.doubleSided ? PRELIGHT_OCCLUDER_TWO_SIDED : 0u) |
                    (isShiny(m) ? PRELIGHT_OCCLUDER_SHINY : 0u) |
                    (isGlass(m) ? PRELIGHT_OCCLUDER_GLASS : 0u));
  return flags;
}

OccluderWays::OccluderWays(const CompiledScene& scene, Tracer& tracer, const Buffer<std::uint32_t>& flags,
                           std::size_t rays)
    : surface_(tracer),
      device_(tracer.context()),
      hasMirrors_(hasShine(scene)),
      hasGlass_(prelight::hasGlass(scene)),
      reach_(static_cast<float>(std::min(freeReach(scene), double(std::numeric_limits<float>::max())))),
      flags_(flags),
      bases_(device_, std::span<const DeviceMaterial>(makeBaseMaterials(scene))),
      vertices_(device_, std::span<const float>(interleaveVertices(scene))),
      flat_(device_, std::span<const std::uint8_t>(scene.triangleFlat)),
      materials_(device_, std::span<const ShadeMaterial>(makeShadeMaterials(scene))),
      counter_(device_, 1) {
  const cl::Program& program = device_.program("project/occluder_way_kernels.cl", surface_.surfaceOptions());
  if (hasMirrors_) {
    listMirrored_ = cl::Kernel(program, "listMirrored");
    mirrored_ = Buffer<OccluderWay>(device_, rays);
    mirrorRays_ = Buffer<Ray>(device_, rays);
    mirrorHits_ = Buffer<Hit>(device_, rays);
  }
  if (!hasGlass_) return;
  listGlass_ = cl::Kernel(program, "listGlass");
  followGlass_ = cl::Kernel(program, "followGlass");
  through_ = Buffer<OccluderWay>(device_, rays);
  pathHits_ = Buffer<Hit>(device_, rays);
  for (auto& buffer : pathRays_) buffer = Buffer<Ray>(device_, rays);
  for (auto& buffer : paths_) buffer = Buffer<GlassPath>(device_, rays);
}

/// Surface and materials as kernel arguments from `index` on.
void OccluderWays::setSurface(cl::Kernel& kernel, cl_uint index) const {
  surface_.setSurfaceArguments(kernel, index);
  kernel.setArg(index + 1, bases_.get());
  kernel.setArg(index + 5, vertices_.get());
  kernel.setArg(index + 6, flat_.get());
  kernel.setArg(index + 7, materials_.get());
}

void OccluderWays::cast(const CastBlockBuffers& block, std::size_t rays, Tracer& tracer) {
  if (hasMirrors_) castMirrored(block, rays, tracer);
  if (hasGlass_) castThrough(block, rays, tracer);
}

void OccluderWays::castMirrored(const CastBlockBuffers& block, std::size_t rays, Tracer& tracer) {
  counter_.fill(0);
  setArguments(listMirrored_, block.parameters.get(), block.rays.get(), block.hits.get(), flags_.get());
  setSurface(listMirrored_, 4);
  listMirrored_.setArg(12, reach_);
  listMirrored_.setArg(13, mirrored_.get());
  listMirrored_.setArg(14, mirrorRays_.get());
  listMirrored_.setArg(15, counter_.get());
  device_.launch(listMirrored_, rays, groupSize);
  const std::uint32_t count = counter_.read()[0];
  if (count > 0) tracer.traceAny(mirrorRays_, mirrorHits_, count);
  rays_ += count;
}

void OccluderWays::castThrough(const CastBlockBuffers& block, std::size_t rays, Tracer& tracer) {
  counter_.fill(0);
  setArguments(listGlass_, block.parameters.get(), block.rays.get(), block.hits.get(), flags_.get());
  listGlass_.setArg(4, surface_.surfaceTriangles().get());
  listGlass_.setArg(5, through_.get());
  listGlass_.setArg(6, paths_[0].get());
  listGlass_.setArg(7, pathRays_[0].get());
  listGlass_.setArg(8, pathHits_.get());
  listGlass_.setArg(9, counter_.get());
  device_.launch(listGlass_, rays, groupSize);
  std::uint32_t count = counter_.read()[0];
  for (std::size_t face = 0; face < mostFaces && count > 0; ++face) {
    const std::size_t at = face % 2, next = 1 - at;
    if (face > 0) {
      tracer.traceClosest(pathRays_[at], pathHits_, count);
      rays_ += count;
    }
    counter_.fill(0);
    setArguments(followGlass_, count, paths_[at].get(), pathRays_[at].get(), pathHits_.get(), flags_.get());
    setSurface(followGlass_, 5);
    followGlass_.setArg(13, reach_);
    followGlass_.setArg(14, through_.get());
    followGlass_.setArg(15, paths_[next].get());
    followGlass_.setArg(16, pathRays_[next].get());
    followGlass_.setArg(17, counter_.get());
    device_.launch(followGlass_, count, groupSize);
    count = counter_.read()[0];
  }
}

}  // namespace prelight
