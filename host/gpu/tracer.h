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

/// The tree that a device traverses. Automatic chooses wide on CPUs and narrow elsewhere.
enum class BvhLayout : std::uint8_t { Automatic, Wide, Narrow };

/// Levels of the tree. One: all triangles are in one tree. Two: shapes with several instances have a tree
/// each, in their own space, below a tree over the instances. Automatic: as chooseInstancing() decides.
enum class TreeLevels : std::uint8_t { Automatic, One, Two };

/// When a tree is built. AtFirstRay: never, if none is traced.
enum class TreeStart : std::uint8_t { AtOnce, AtFirstRay };

/// A scene on the device that rays can be traced in: the tree, and the surface data at hits. Hits refer to
/// the scene's triangles for any kind of tree; with two levels they differ by the rounding of transforming
/// rays. Moving objects have a separate tree, and rays traverse both.
class Tracer {
 public:
  /// Builds the tree and uploads everything. The scene must have a triangle; it must outlive the tracer if
  /// the tree starts at the first ray, and is not kept otherwise.
  Tracer(const CompiledScene& scene, const Device& device, BvhLayout layout = BvhLayout::Automatic,
         BuildQuality quality = BuildQuality::High, TreeLevels levels = TreeLevels::Automatic,
         TreeStart start = TreeStart::AtOnce);

  /// Shares another tracer's surface, with a tree over a part of its triangles, which keep the scene's
  /// indices. If `triangles` is empty, every ray misses. `scene` is the one that `whole` was made of.
  Tracer(const Tracer& whole, const CompiledScene& scene, std::span<const std::uint32_t> triangles,
         BuildQuality quality = BuildQuality::High);

  /// Puts triangles into a separate tree, the only one that follow() rebuilds when they move. `scene` is the
  /// one that this was made of. Replaces an earlier choice; if empty, all triangles are in one tree again.
  void separate(const CompiledScene& scene, std::span<const std::uint32_t> moving);

  /// Updates separated triangles to the scene's present positions. No others may have moved.
  void follow(const CompiledScene& scene);

  /// Frees the tree when no more rays will be traced; the surface stays.
  void dropTree();

  /// Returns the closest hits on separated triangles only.
  std::vector<device::Hit> traceSeparated(std::span<const device::Ray> rays);

  /// Finds the closest hit of each of `count` rays from `first` on; hits start at 0. If triangles are
  /// separated, only one lane may trace at a time.
  void traceClosest(const Buffer<device::Ray>& rays, Buffer<device::Hit>& hits, std::size_t count,
                    std::size_t first = 0, DeviceLane lane = {});

  /// Finds any hit. A hit only says that there is one (triangle 0).
  void traceAny(const Buffer<device::Ray>& rays, Buffer<device::Hit>& hits, std::size_t count,
                std::size_t first = 0, DeviceLane lane = {});

  /// Finds hits of rays towards lights. Where surfaces let part of the light through, a hit holds the share
  /// that arrives (kernels/core/shadow_share_funcs.cl).
  void traceShadows(const Buffer<device::Ray>& rays, Buffer<device::Hit>& hits, std::size_t count,
                    std::size_t first = 0, DeviceLane lane = {});

  /// Upload rays, trace them and return the hits, for tests and tools.
  std::vector<device::Hit> traceClosest(std::span<const device::Ray> rays);
  std::vector<device::Hit> traceAny(std::span<const device::Ray> rays);
  std::vector<device::Hit> traceShadows(std::span<const device::Ray> rays);

  /// Returns whether some surface lets part of the light of shadow rays through.
  bool dimsShadows() const { return dims_; }

  /// Uses the pane data of a scene that has it, whose buffers follow moving vertices.
  void sharePanes(const DeviceScene& shaded);

  /// Returns the surface data for kernels.
  const DeviceScene& scene() const { return scene_; }

  /// Returns the options for programs that access the surface.
  BuildOptions surfaceOptions() const;

  /// Returns the bytes of the trees on the device, as far as they have been built.
  std::size_t bvhBytes() const { return treeBytes_ + (separated_ ? separated_->bvhBytes() : 0); }

  BvhLayout layout() const { return layout_; }

  /// Returns the number of instances in a tree of two levels that has been built.
  std::size_t instanceCount() const { return upper_.instances.size(); }
  DeviceContext& context() const { return *context_; }

 private:
  enum class Query : std::uint8_t { Closest, Any, Shadows };

  /// Pane data for shadow rays, and the options of their kernel.
  struct Panes {
    DeviceScene scene;
    BuildOptions options;
    bool isShared = false;  ///< the owner of the scene updates its vertices
  };

  /// A tree with its traversal kernels, each built at its first use.
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

  void startTree();
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
  const CompiledScene* unbuilt_ = nullptr;     ///< whose tree starts at the first ray; nullptr: it is built
  BuildQuality quality_ = BuildQuality::High;  ///< of that tree
  std::uint32_t stackSize_ = 0;
  std::size_t treeBytes_ = 0;
  DeviceScene scene_;
  std::optional<Panes> panes_;  ///< none if no surface is a pane
  UpperLevel upper_;            ///< upper level of a tree with instances
  Buffer<device::DeviceInstance> instances_;
  std::variant<WideTree, NarrowTree> tree_;
  std::vector<std::uint32_t> separatedTriangles_;
  std::unique_ptr<Tracer> separated_;  ///< tree over them; nullptr if there are none
  Buffer<device::Hit> separatedHits_;
  Kernel<std::uint32_t, Buffer<device::Hit>, Buffer<device::Hit>> keepNearer_, joinShadows_;
};

}  // namespace prelight
