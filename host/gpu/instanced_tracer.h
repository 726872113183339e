#pragma once

#include <span>
#include <vector>

#include "bvh/two_level.h"
#include "device/kernel.h"
#include "prelight/device.h"
#include "shared/ray_types.h"

namespace prelight {

/// Shapes on the device, each once, and instances of them that can be moved without building their trees
/// again: only the tree over the instances is. Hits are those of the flattened scene up to the rounding of
/// taking a ray to a shape's space. The shapes' trees are narrow ones on any device.
class InstancedTracer {
 public:
  /// Builds the shapes' trees and uploads everything. Each shape must have a triangle and there must be an
  /// instance. Throws Error for shapes with alpha masks, and as buildInstanceTree.
  InstancedTracer(std::span<const CompiledScene> shapes, std::vector<Instance> instances,
                  const Device& device);

  /// Moves an instance.
  void update(std::size_t instance, const glm::mat4& toWorld);

  /// Moves all instances, in their order.
  void update(std::span<const glm::mat4> toWorld);

  /// Closest hits; `triangle` is the instance's first triangle plus the one of its shape.
  std::vector<device::Hit> traceClosest(std::span<const device::Ray> rays);

  /// Traces as traceClosest, but a hit says no more than that there is one (triangle 0).
  std::vector<device::Hit> traceAny(std::span<const device::Ray> rays);

  /// Trace the first `count` of rays that are on the device; the hits stay there.
  void traceClosest(const Buffer<device::Ray>& rays, Buffer<device::Hit>& hits, std::size_t count);
  void traceAny(const Buffer<device::Ray>& rays, Buffer<device::Hit>& hits, std::size_t count);

  const std::vector<Instance>& instances() const { return instances_; }
  std::size_t shapeBytes() const;  ///< on the device, shared by all instances
  std::size_t topBytes() const;    ///< what an update uploads

 private:
  using Trace =
      Kernel<Buffer<device::NarrowNode>, Buffer<device::DeviceInstance>, Buffer<device::NarrowNode>,
             Buffer<device::NarrowTriangle>, Buffer<device::Ray>, Buffer<device::Hit>, std::uint32_t>;

  void uploadTop();
  Trace& kernel(bool any);
  void trace(bool any, const Buffer<device::Ray>& rays, Buffer<device::Hit>& hits, std::size_t count);
  std::vector<device::Hit> traceFromHost(bool any, std::span<const device::Ray> rays);

  DeviceContext* context_;
  ShapeTrees shapes_;  ///< without nodes and triangles, which are on the device
  std::vector<Instance> instances_;
  std::uint32_t topStackSize_ = 0;
  Buffer<device::NarrowNode> nodes_;
  Buffer<device::NarrowTriangle> triangles_;
  Buffer<device::NarrowNode> top_;
  Buffer<device::DeviceInstance> records_;
  Trace closest_, any_;
};

}  // namespace prelight
