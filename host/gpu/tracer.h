#pragma once

#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "bvh/builder.h"
#include "bvh/two_level.h"
#include "device/kernel.h"
#include "gpu/device_scene.h"
#include "prelight/compiled_scene.h"
#include "prelight/device.h"
#include "shared/bvh_types.h"
#include "shared/ray_types.h"
#include "shared/scene_types.h"

namespace prelight {

/// Which tree a device traverses. Automatic: wide on CPUs, narrow elsewhere.
enum class BvhLayout : std::uint8_t { Automatic, Wide, Narrow };

/// One: the scene's triangles are in one tree. Two: shapes that are drawn more than once have a tree each, in
/// spaces of their own, below one over their instances. Automatic: as chooseInstancing() finds.
enum class TreeLevels : std::uint8_t { Automatic, One, Two };

/// A scene on the device, ready to be hit by rays: the tree, and what the surface is like where it is hit.
/// Hits are those of the scene's triangles however the tree is made, with two levels up to the rounding of
/// taking a ray to a shape's space. Objects that move have a tree of their own, and rays go through both.
class Tracer {
 public:
  /// Builds the tree and uploads everything. The scene must have a triangle; it is not kept.
  Tracer(const CompiledScene& scene, const Device& device, BvhLayout layout = BvhLayout::Automatic,
         BuildQuality quality = BuildQuality::High, TreeLevels levels = TreeLevels::Automatic);

  /// Another tracer's surface with a tree over a part of its triangles, whose indices stay the scene's; none:
  /// every ray misses. `scene` is the one that `whole` was made of.
  Tracer(const Tracer& whole, const CompiledScene& scene, std::span<const std::uint32_t> triangles,
         BuildQuality quality = BuildQuality::High);

  /// Gives triangles a tree of their own, so that follow() builds no other when they move. `scene` is the one
  /// that this was made of. Replaces an earlier choice; none: all are in one tree again.
  void separate(const CompiledScene& scene, std::span<const std::uint32_t> moving);

  /// Takes separated triangles to where the scene has them now. No other may have moved.
  void follow(const CompiledScene& scene);

  /// Frees the tree where no ray will be traced any more; the surface stays.
  void dropTree();

  /// Closest hits on separated triangles alone.
  std::vector<device::Hit> traceSeparated(std::span<const device::Ray> rays);

  /// Closest hit of each of `count` rays from `first` on; hits start at 0. Where triangles are separated, two
  /// lanes must not be traced in at a time.
  void traceClosest(const Buffer<device::Ray>& rays, Buffer<device::Hit>& hits, std::size_t count,
                    std::size_t first = 0, DeviceLane lane = {});

  /// As traceClosest, but a hit carries no more than that there is one (triangle 0).
  void traceAny(const Buffer<device::Ray>& rays, Buffer<device::Hit>& hits, std::size_t count,
                std::size_t first = 0, DeviceLane lane = {});

  /// As traceAny, of rays towards lights: where some surface lets part of the light through, a hit tells how
  /// much of it arrives (kernels/core/shadow_share_funcs.cl).
  void traceShadows(const Buffer<device::Ray>& rays, Buffer<device::Hit>& hits, std::size_t count,
                    std::size_t first = 0, DeviceLane lane = {});

  /// For tests and tools: uploads, traces, downloads.
  std::vector<device::Hit> traceClosest(std::span<const device::Ray> rays);
  std::vector<device::Hit> traceAny(std::span<const device::Ray> rays);
  std::vector<device::Hit> traceShadows(std::span<const device::Ray> rays);

  /// Some surface lets part of the light of shadow rays through.
  bool dimsShadows() const { return dims_; }

  /// Takes what shadow rays ask of panes from a scene that has it, whose buffers follow what moves.
  void sharePanes(const DeviceScene& shaded);

  /// What the surface is like, for kernels that look at it.
  const DeviceScene& scene() const { return scene_; }

  /// Options that programs which look at the surface are built with.
  BuildOptions surfaceOptions() const;

  /// Of the trees on the device.
  std::size_t bvhBytes() const { return treeBytes_ + (separated_ ? separated_->bvhBytes() : 0); }

  BvhLayout layout() const { return layout_; }

  /// In the tree, of shapes that have a tree of their own.
  std::size_t instanceCount() const { return upper_.instances.size(); }
  DeviceContext& context() const { return *context_; }

 private:
  enum class Query : std::uint8_t { Closest, Any, Shadows };

  /// What shadow rays ask of panes, and how their kernel is built.
  struct Panes {
    DeviceScene scene;
    BuildOptions options;
    bool isShared = false;  ///< somebody else takes it to where its vertices are
  };

  /// A tree and the kernels that take rays through it, each built when first asked for.
  template <typename Node, typename Leaf>
  struct Tree {
    using Trace = Kernel<Buffer<Node>, Buffer<Leaf>, Buffer<device::DeviceInstance>,
                         Buffer<device::SceneLayout>, Buffer<device::SurfaceLine>, Buffer<device::Ray>,
                         Buffer<device::Hit>, std::uint32_t, std::uint32_t>;
    using TraceShadows =
        Kernel<Buffer<Node>, Buffer<Leaf>, Buffer<device::DeviceInstance>, Buffer<device::SceneLayout>,
               Buffer<device::SurfaceLine>, Buffer<device::ShadingLine>, Buffer<device::Ray>,
               Buffer<device::Hit>, std::uint32_t, std::uint32_t>;
    Buffer<Node> nodes;
    Buffer<Leaf> leaves;
    Trace closest, any;
    TraceShadows shadows;
  };
  using WideTree = Tree<device::WideNode, device::TriangleBlock>;
  using NarrowTree = Tree<device::NarrowNode, device::NarrowTriangle>;

  void uploadTree(const CompiledScene& scene, BuildQuality quality,
                  std::span<const std::uint32_t> triangles = {});
  template <typename Bvh, typename Kept>
  void uploadTree(const CompiledScene& scene, BuildQuality quality, std::span<const std::uint32_t> triangles,
                  Kept& kept);
  template <typename Bvh, typename Kept>
  void moveInstances(const CompiledScene& scene, Kept& kept);
  void moveTree(const CompiledScene& scene, std::span<const std::uint32_t> triangles);
  void dropKernels();
  BuildOptions traceOptions(Query query) const;
  void traceShadowTree(const Buffer<device::Ray>& rays, Buffer<device::Hit>& hits, std::uint32_t count,
                       std::uint32_t first, WorkSize size);
  void trace(Query query, const Buffer<device::Ray>& rays, Buffer<device::Hit>& hits, std::size_t count,
             std::size_t first, DeviceLane lane);
  void traceTree(Query query, const Buffer<device::Ray>& rays, Buffer<device::Hit>& hits, std::size_t count,
                 std::size_t first, DeviceLane lane);
  std::vector<device::Hit> traceFromHost(Query query, std::span<const device::Ray> rays);

  DeviceContext* context_;
  BvhLayout layout_;
  bool alphaTest_ = false;
  bool vertexColors_ = false;
  bool albedoShares_ = false;
  bool dims_ = false;
  bool treeless_ = false;
  std::uint32_t stackSize_ = 0;
  std::size_t treeBytes_ = 0;
  DeviceScene scene_;
  std::optional<Panes> panes_;  ///< none: no surface is a pane
  UpperLevel upper_;            ///< of a tree with instances
  Buffer<device::DeviceInstance> instances_;
  std::variant<WideTree, NarrowTree> tree_;
  std::vector<std::uint32_t> separatedTriangles_;
  std::unique_ptr<Tracer> separated_;  ///< the tree over them; none: there are none
  Buffer<device::Hit> separatedHits_;
  Kernel<std::uint32_t, Buffer<device::Hit>, Buffer<device::Hit>> keepNearer_, joinShadows_;
};

}  // namespace prelight
