#include "techniques/vector_occluders/occluder_column.h"

#include "cast/side_sums.h"
#include "occluders/occluder_vectors.h"
#include "techniques/vector_occluders/occluder_means.h"

namespace prelight {

using namespace device;

void OccluderColumn::allocate(const CastShape& shape) {
  const std::size_t rays = std::size_t{shape.blockSize} * shape.raysPerReceiver;
  DeviceContext& device = shape.tracer.context();
  raysPerReceiver_ = shape.raysPerReceiver;
  geometricNormals_ = shape.geometricNormals();
  spans_ = Buffer<RecordSpan>(device, 1 + std::size_t{shape.blockSize});
  sums_ = Buffer<OccluderSums>(device, rays);
  noWays_ = Buffer<OccluderWay>(device, 0);
  noHits_ = Buffer<Hit>(device, 0);
  scene_.emplace(shape.tracer.scene());
  scene_->setOccluders(occluderFlags(shape.scene), groups_.groupOfVertex);
  BuildOptions options = shape.tracer.surfaceOptions();
  if (prelight::hasGlass(shape.scene) || hasShine(shape.scene)) {
    ways_.emplace(shape.scene, *scene_, options, rays);
    options.defineIf(ways_->hasMirrors(), "PRELIGHT_OCCLUDER_MIRRORS");
    options.defineIf(ways_->hasGlass(), "PRELIGHT_OCCLUDER_WAYS_THROUGH");
  }
  waySums_ = Buffer<OccluderWaySums>(device, ways_ ? PRELIGHT_WAYS * rays : 0);
  kernel_ = {device, "techniques/vector_occluders/occluder_kernels.cl", options, "aggregateOccluders"};
}

void OccluderColumn::setAccessibility(const CompiledScene& scene, std::span<const float> accessibility) {
  std::vector<OccluderVertex> vertices;
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    const glm::vec3 n = scene.normals[v];
    vertices.push_back({{n.x, n.y, n.z}, accessibility[v]});
  }
  scene_->setOccluderVertices(vertices);
  knowsAccessibility_ = true;
}

void OccluderColumn::aggregate(const CastBlock& block) {
  spans_.fill({}, 1);
  kernel_.launch(block.receivers, block.buffers.parameters, scene_->layoutBuffer(), scene_->surface(),
                 scene_->occluders(), geometricNormals_, block.buffers.rays, block.buffers.hits,
                 ways_ ? ways_->ways() : noWays_, ways_ ? ways_->mirrorHits() : noHits_, spans_, sums_,
                 waySums_);
}

void OccluderColumn::finish(const CastBlock& block, ColumnRows& rows) {
  if (ways_) ways_->cast(block.buffers, std::size_t{block.receivers} * raysPerReceiver_, block.tracer);
  aggregate(block);
  RecordSpan all;
  spans_.read(std::span(&all, 1));
  ColumnRows::read(spans_, 1, block.receivers, rows.rows);
  rows.records.resize(ways_ ? 2 : 1);
  ColumnRows::read(sums_, 0, all.first, rows.records[sums]);
  if (ways_) ColumnRows::read(waySums_, 0, PRELIGHT_WAYS * std::size_t{all.first}, rows.records[ways]);
}

void OccluderColumn::saveBlock(StateWriter& state, const CastTask& /*task*/, std::uint32_t /*receivers*/) {
  state.value(toldRays_.growth(ways_ ? ways_->rays() : 0));
}

void OccluderColumn::loadBlock(StateReader& state, const CastTask& /*task*/, std::uint32_t receivers,
                               const ColumnRows& rows) {
  std::uint64_t ownRays = 0;
  state.value(ownRays);
  earlierRays_ += ownRays;
  state.require(rows.rows.size() == receivers * sizeof(RecordSpan) && rows.records.size() == (ways_ ? 2 : 1));
  const std::size_t records = rows.records[sums].size() / sizeof(OccluderSums);
  state.require(rows.records[sums].size() == records * sizeof(OccluderSums));
  state.require(!ways_ || rows.records[ways].size() == records * PRELIGHT_WAYS * sizeof(OccluderWaySums));
  for (const RecordSpan& span : rows.of<RecordSpan>())
    state.require(span.first <= records && span.count <= records - span.first);
  const auto seen = rows.recordsOf<OccluderSums>(sums);
  for (const OccluderSums& record : seen) state.require(record.group < groups_.names.size());
  state.requireFinite(numbersOf(seen));
  if (ways_) state.requireFinite(numbersOf(rows.recordsOf<OccluderWaySums>(ways)));
}

std::unique_ptr<ColumnSums> OccluderColumn::makeSums(const SideShape& side) {
  return std::make_unique<OccluderMeans>(side.mesh, *this);
}

const OccluderMeans& OccluderColumn::meansOn(const SideSums& side) const {
  return static_cast<const OccluderMeans&>(side.of(*this));
}

}  // namespace prelight
