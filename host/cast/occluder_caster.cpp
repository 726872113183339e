#include "cast/occluder_caster.h"

#include "occluders/occluder_vectors.h"

namespace prelight {

namespace {

using namespace device;

template <typename T>
void readRecords(const Buffer<T>& buffer, std::size_t count, std::vector<T>& records, std::size_t first = 0) {
  records.resize(count);
  buffer.read(std::span(records), first);
}

/// Every PRELIGHT_WAYS-th of the records' sums, from `way` on.
std::vector<OccluderWaySums> sumsOfWay(const std::vector<OccluderWaySums>& all, std::size_t way) {
  std::vector<OccluderWaySums> sums;
  sums.reserve(all.size() / PRELIGHT_WAYS);
  for (std::size_t i = way; i < all.size(); i += PRELIGHT_WAYS) sums.push_back(all[i]);
  return sums;
}

}  // namespace

OccluderCaster::OccluderCaster(const CompiledScene& scene, const OccluderGroups& groups, Tracer& tracer,
                               const Buffer<float>& geometricNormals, std::uint32_t blockSize,
                               std::uint32_t raysPerReceiver)
    : scene_(tracer.scene()),
      device_(tracer.context()),
      raysPerReceiver_(raysPerReceiver),
      geometricNormals_(geometricNormals),
      spans_(device_, 1 + std::size_t{blockSize}),
      sums_(device_, std::size_t{blockSize} * raysPerReceiver),
      noWays_(device_, 0),
      noHits_(device_, 0),
      waySums_(device_, 0) {
  scene_.setOccluders(occluderFlags(scene), groups.groupOfVertex);
  BuildOptions options = tracer.surfaceOptions();
  if (hasGlass(scene) || hasShine(scene)) {
    ways_.emplace(scene, scene_, options, sums_.size());
    waySums_ = Buffer<OccluderWaySums>(device_, PRELIGHT_WAYS * sums_.size());
    options.defineIf(ways_->hasMirrors(), "PRELIGHT_OCCLUDER_MIRRORS");
    options.defineIf(ways_->hasGlass(), "PRELIGHT_OCCLUDER_WAYS_THROUGH");
  }
  kernel_ = {device_, "project/occluder_kernels.cl", options, "aggregateOccluders"};
}

void OccluderCaster::setAccessibility(const CompiledScene& scene, std::span<const float> accessibility) {
  std::vector<OccluderVertex> vertices;
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    const glm::vec3 n = scene.normals[v];
    vertices.push_back({{n.x, n.y, n.z}, accessibility[v]});
  }
  scene_.setOccluderVertices(vertices);
}

void OccluderCaster::aggregate(const CastBlockBuffers& block, std::uint32_t receivers) {
  spans_.fill({}, 1);
  kernel_.launch(receivers, block.parameters, scene_.layoutBuffer(), scene_.surface(), scene_.occluders(),
                 geometricNormals_, block.rays, block.hits, ways_ ? ways_->ways() : noWays_,
                 ways_ ? ways_->mirrorHits() : noHits_, spans_, sums_, waySums_);
}

void OccluderCaster::cast(const CastBlockBuffers& block, std::uint32_t receivers, Tracer& tracer,
                          OccluderValues& values) {
  if (ways_) ways_->cast(block, std::size_t{receivers} * raysPerReceiver_, tracer);
  aggregate(block, receivers);
  OccluderValues::Span all;
  spans_.read(std::span(&all, 1));
  const std::size_t records = all.first;
  readRecords(spans_, receivers, values.spans, 1);
  readRecords(sums_, records, values.sums);
  if (!ways_) return;
  std::vector<OccluderWaySums> ways;
  readRecords(waySums_, PRELIGHT_WAYS * records, ways);
  if (ways_->hasMirrors()) values.mirrored = sumsOfWay(ways, PRELIGHT_WAY_MIRRORED);
  if (ways_->hasGlass()) values.through = sumsOfWay(ways, PRELIGHT_WAY_THROUGH);
}

}  // namespace prelight
