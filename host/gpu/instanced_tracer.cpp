#include "gpu/instanced_tracer.h"

#include <algorithm>
#include <string>
#include <utility>

#include "prelight/error.h"

namespace prelight {

namespace {

using device::Hit;
using device::Ray;

/// Keeps a launch well below a second on a CPU.
constexpr std::size_t instancedRaysPerLaunch = std::size_t{1} << 19;

/// Few sizes, so that few variants of the kernels are built.
int instancedStackBucket(std::uint32_t needed) {
  int size = 64;
  while (static_cast<std::uint32_t>(size) < needed) size *= 2;
  return size;
}

void checkShapes(std::span<const CompiledScene> shapes) {
  for (std::size_t i = 0; i < shapes.size(); ++i)
    if (shapes[i].hasAlphaMask())
      throw Error(ExitCode::RuntimeFailure, "shape " + std::to_string(i), "has an alpha mask",
                  "trace scenes with masks through Tracer");
}

}  // namespace

InstancedTracer::InstancedTracer(std::span<const CompiledScene> shapes, std::vector<Instance> instances,
                                 const Device& device)
    : context_(&device.context()), instances_(std::move(instances)) {
  checkShapes(shapes);
  shapes_ = buildShapeTrees(shapes);
  nodes_ = Buffer<device::NarrowNode>(*context_, std::exchange(shapes_.nodes, {}));
  triangles_ = Buffer<device::NarrowTriangle>(*context_, std::exchange(shapes_.triangles, {}));
  uploadTop();
}

void InstancedTracer::uploadTop() {
  const InstanceTree tree = buildInstanceTree(shapes_, instances_);
  top_ = Buffer<device::NarrowNode>(*context_, tree.nodes);
  records_ = Buffer<device::DeviceInstance>(*context_, tree.instances);
  if (instancedStackBucket(tree.stackSize) == instancedStackBucket(topStackSize_)) return;
  topStackSize_ = tree.stackSize;
  closest_ = {};
  any_ = {};
}

void InstancedTracer::update(std::size_t instance, const glm::mat4& toWorld) {
  instances_.at(instance).toWorld = toWorld;
  uploadTop();
}

void InstancedTracer::update(std::span<const glm::mat4> toWorld) {
  for (std::size_t i = 0; i < std::min(toWorld.size(), instances_.size()); ++i)
    instances_[i].toWorld = toWorld[i];
  uploadTop();
}

std::size_t InstancedTracer::shapeBytes() const { return nodes_.bytes() + triangles_.bytes(); }
std::size_t InstancedTracer::topBytes() const { return top_.bytes() + records_.bytes(); }

InstancedTracer::Trace& InstancedTracer::kernel(bool any) {
  Trace& kernel = any ? any_ : closest_;
  if (!kernel) {
    const BuildOptions options = BuildOptions()
                                     .defineIf(any, "PRELIGHT_ANY_HIT")
                                     .define("PRELIGHT_STACK_SIZE", instancedStackBucket(shapes_.stackSize))
                                     .define("PRELIGHT_TOP_STACK_SIZE", instancedStackBucket(topStackSize_));
    kernel = {*context_, "bvh/two_level_kernels.cl", options, "traceRays"};
  }
  return kernel;
}

void InstancedTracer::trace(bool any, const Buffer<Ray>& rays, Buffer<Hit>& hits, std::size_t count) {
  kernel(any).launch(count, top_, records_, nodes_, triangles_, rays, hits,
                     static_cast<std::uint32_t>(count));
}

void InstancedTracer::traceClosest(const Buffer<Ray>& rays, Buffer<Hit>& hits, std::size_t count) {
  trace(false, rays, hits, count);
}

void InstancedTracer::traceAny(const Buffer<Ray>& rays, Buffer<Hit>& hits, std::size_t count) {
  trace(true, rays, hits, count);
}

std::vector<Hit> InstancedTracer::traceFromHost(bool any, std::span<const Ray> rays) {
  std::vector<Hit> all(rays.size());
  const std::size_t block = std::min(rays.size(), instancedRaysPerLaunch);
  Buffer<Ray> rayBuffer(*context_, block);
  Buffer<Hit> hitBuffer(*context_, block);
  for (std::size_t first = 0; first < rays.size(); first += block) {
    const std::size_t count = std::min(block, rays.size() - first);
    rayBuffer.write(rays.subspan(first, count));
    trace(any, rayBuffer, hitBuffer, count);
    hitBuffer.read(std::span(all).subspan(first, count));
  }
  return all;
}

std::vector<Hit> InstancedTracer::traceClosest(std::span<const Ray> rays) {
  return traceFromHost(false, rays);
}
std::vector<Hit> InstancedTracer::traceAny(std::span<const Ray> rays) { return traceFromHost(true, rays); }

}  // namespace prelight
