#include "cast/occluder_caster.h"

#include "occluders/occluder_vectors.h"

namespace prelight {

namespace {

using namespace device;

constexpr std::size_t groupSize = 64;

template <typename T>
void readRecords(const Buffer<T>& buffer, std::size_t count, std::vector<T>& records) {
  records.resize(count);
  buffer.read(std::span(records));
}

}  // namespace

OccluderCaster::OccluderCaster(const CompiledScene& scene, const OccluderGroups& groups, Tracer& tracer,
                               const Buffer<float>& geometricNormals, std::uint32_t blockSize,
                               std::uint32_t raysPerReceiver)
    : surface_(tracer),
      device_(tracer.context()),
      raysPerReceiver_(raysPerReceiver),
      geometricNormals_(geometricNormals),
      flags_(device_, std::span<const std::uint32_t>(occluderFlags(scene))),
      groups_(device_, std::span<const std::uint32_t>(groups.groupOfVertex)),
      vertices_(device_, scene.vertexCount()),
      counter_(device_, 1),
      spans_(device_, blockSize),
      sums_(device_, std::size_t{blockSize} * raysPerReceiver) {
  if (hasGlass(scene) || hasShine(scene)) ways_.emplace(scene, tracer, flags_, sums_.size());
  BuildOptions options = tracer.surfaceOptions();
  if (ways_ && ways_->hasMirrors()) {
    options.define("PRELIGHT_OCCLUDER_MIRRORS", 1);
    mirrorSums_ = Buffer<OccluderWaySums>(device_, sums_.size());
  }
  if (ways_ && ways_->hasGlass()) {
    options.define("PRELIGHT_OCCLUDER_WAYS_THROUGH", 1);
    throughSums_ = Buffer<OccluderWaySums>(device_, sums_.size());
  }
  kernel_ = cl::Kernel(device_.program("project/occluder_kernels.cl", options), "aggregateOccluders");
}

void OccluderCaster::setAccessibility(const CompiledScene& scene, std::span<const float> accessibility) {
  std::vector<OccluderVertex> vertices;
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    const glm::vec3 n = scene.normals[v];
    vertices.push_back({{n.x, n.y, n.z}, accessibility[v]});
  }
  vertices_.write(std::span<const OccluderVertex>(vertices));
}

void OccluderCaster::aggregate(const CastBlockBuffers& block, std::uint32_t receivers) {
  counter_.fill(0);
  setArguments(kernel_, block.parameters.get(), block.rays.get(), block.hits.get());
  surface_.setSurfaceArguments(kernel_, 3);
  kernel_.setArg(8, geometricNormals_.get());
  kernel_.setArg(9, flags_.get());
  kernel_.setArg(10, vertices_.get());
  kernel_.setArg(11, groups_.get());
  kernel_.setArg(12, counter_.get());
  kernel_.setArg(13, spans_.get());
  kernel_.setArg(14, sums_.get());
  cl_uint index = 15;
  if (ways_ && ways_->hasMirrors()) {
    kernel_.setArg(index++, ways_->mirrored().get());
    kernel_.setArg(index++, ways_->mirrorHits().get());
    kernel_.setArg(index++, mirrorSums_.get());
  }
  if (ways_ && ways_->hasGlass()) {
    kernel_.setArg(index++, ways_->through().get());
    kernel_.setArg(index++, throughSums_.get());
  }
  device_.launch(kernel_, receivers, groupSize);
}

void OccluderCaster::cast(const CastBlockBuffers& block, std::uint32_t receivers, Tracer& tracer,
                          OccluderValues& values) {
  if (ways_) ways_->cast(block, std::size_t{receivers} * raysPerReceiver_, tracer);
  aggregate(block, receivers);
  readRecords(spans_, receivers, values.spans);
  const std::size_t records = counter_.read()[0];
  readRecords(sums_, records, values.sums);
  if (ways_ && ways_->hasMirrors()) readRecords(mirrorSums_, records, values.mirrored);
  if (ways_ && ways_->hasGlass()) readRecords(throughSums_, records, values.through);
}

}  // namespace prelight
