#include "gpu/tracer.h"

#include <algorithm>

#include "base/spans.h"
#include "bvh/builder.h"
#include "bvh/layouts.h"
#include "gpu/surface_upload.h"
#include "gpu/transport_scene.h"
#include "scene/instancing.h"
#include "scene/lobes.h"

namespace prelight {

namespace {

using device::Hit;
using device::Ray;

constexpr std::size_t raysPerLaunch = std::size_t{1} << 20;  // keeps a launch well below a second on a CPU

/// Rounds a stack size up to one of few sizes, so that few kernel variants are built.
std::uint32_t stackBucket(std::uint32_t needed) {
  std::uint32_t size = 64;
  while (size < needed) size *= 2;
  return size;
}

Instancing instancingOf(const CompiledScene& scene, TreeLevels levels) {
  if (levels == TreeLevels::Two) return instanceAll(scene);
  return levels == TreeLevels::One ? Instancing{} : chooseInstancing(scene);
}

const std::vector<device::TriangleBlock>& leavesOf(const WideBvh& bvh) { return bvh.blocks; }
const std::vector<device::NarrowTriangle>& leavesOf(const NarrowBvh& bvh) { return bvh.triangles; }

}  // namespace

Tracer::Tracer(const CompiledScene& scene, const Device& device, BvhLayout layout, BuildQuality quality,
               TreeLevels levels, TreeStart start)
    : context_(&device.context()),
      layout_(layout != BvhLayout::Automatic          ? layout
              : device.info().kind == DeviceKind::Cpu ? BvhLayout::Wide
                                                      : BvhLayout::Narrow),
      alphaTest_(scene.hasAlphaMask()),
      vertexColors_(scene.hasVertexColors()),
      albedoShares_(albedoHasShares(scene)),
      dims_(anyTriangle(scene, prelight::dimsShadows)),
      unbuilt_(&scene),
      quality_(quality),
      scene_(*context_, scene, instancingOf(scene, levels).instances),
      instances_(*context_, 0) {
  if (layout_ == BvhLayout::Narrow) tree_.emplace<NarrowTree>();
  if (anyTriangle(scene, isPane)) {
    panes_.emplace(Panes{scene_, surfaceOptions(), false});
    panes_->scene.setPaneShading(scene);
    defineFeatures(findPaneFeatures(scene), panes_->options);
  }
  if (start == TreeStart::AtOnce) startTree();
}

void Tracer::startTree() {
  uploadTree(*unbuilt_, quality_);
  unbuilt_ = nullptr;
}

Tracer::Tracer(const Tracer& whole, const CompiledScene& scene, std::span<const std::uint32_t> triangles,
               BuildQuality quality)
    : context_(whole.context_),
      layout_(whole.layout_),
      alphaTest_(whole.alphaTest_),
      vertexColors_(whole.vertexColors_),
      albedoShares_(whole.albedoShares_),
      dims_(whole.dims_),
      treeless_(triangles.empty()),
      scene_(whole.scene_),
      panes_(whole.panes_),
      instances_(*context_, 0) {
  if (layout_ == BvhLayout::Narrow) tree_.emplace<NarrowTree>();
  if (!treeless_) uploadTree(scene, quality, triangles);
}

void Tracer::separate(const CompiledScene& scene, std::span<const std::uint32_t> moving) {
  unbuilt_ = nullptr;
  std::vector<std::uint8_t> moves(scene.triangleCount(), 0);
  for (const std::uint32_t t : moving) moves[t] = 1;
  std::vector<std::uint32_t> still;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    if (moves[t] == 0) still.push_back(t);
  treeless_ = still.empty();
  if (!treeless_) uploadTree(scene, BuildQuality::Balanced, still);
  dropKernels();  // the stack size may have changed
  separated_.reset();
  if (moving.empty()) return;
  separatedTriangles_.assign(moving.begin(), moving.end());
  separated_ = std::make_unique<Tracer>(*this, scene, moving, BuildQuality::Balanced);
  keepNearer_ = {*context_, "bvh/nearer_kernels.cl", {}, "keepNearer"};
  if (dims_) joinShadows_ = {*context_, "bvh/nearer_kernels.cl", {}, "joinShadows"};
}

void Tracer::sharePanes(const DeviceScene& shaded) {
  if (!panes_) return;
  panes_->scene = shaded;
  panes_->isShared = true;
  if (separated_) separated_->sharePanes(shaded);
}

void Tracer::follow(const CompiledScene& scene) {
  if (!separated_) return;
  if (panes_ && !panes_->isShared) panes_->scene.follow(scene);
  separated_->moveTree(scene, separatedTriangles_);
}

std::vector<Hit> Tracer::traceSeparated(std::span<const Ray> rays) {
  if (separated_) return separated_->traceClosest(rays);
  return std::vector<Hit>(rays.size(), Hit{0.0f, PRELIGHT_NO_TRIANGLE, 0.0f, 0.0f});
}

void Tracer::dropTree() {
  std::visit([](auto& tree) { tree = {}; }, tree_);
  separated_.reset();
  unbuilt_ = nullptr;
}

void Tracer::dropKernels() {
  std::visit(
      [](auto& tree) {
        tree.closest = tree.any = {};
        tree.shadows = {};
      },
      tree_);
}

BuildOptions Tracer::traceOptions(Query query) const {
  BuildOptions options = query == Query::Shadows && panes_ ? panes_->options : surfaceOptions();
  return options.defineIf(query == Query::Any, "PRELIGHT_ANY_HIT")
      .defineIf(!upper_.instances.empty(), "PRELIGHT_INSTANCES")
      .define("PRELIGHT_STACK_SIZE", static_cast<int>(stackBucket(stackSize_)));
}

BuildOptions Tracer::surfaceOptions() const {
  return BuildOptions()
      .defineIf(alphaTest_, "PRELIGHT_ALPHA_TEST")
      .defineIf(vertexColors_, "PRELIGHT_VERTEX_COLORS")
      .defineIf(albedoShares_, "PRELIGHT_ALBEDO_SHARES")
      .defineIf(dims_, "PRELIGHT_SHADOW_SHARES")
      .defineIf(!scene_.instances().empty(), "PRELIGHT_SHARED_SURFACE");
}

void Tracer::uploadTree(const CompiledScene& scene, BuildQuality quality,
                        std::span<const std::uint32_t> triangles) {
  if (layout_ == BvhLayout::Wide)
    uploadTree<WideBvh>(scene, quality, triangles, std::get<WideTree>(tree_));
  else
    uploadTree<NarrowBvh>(scene, quality, triangles, std::get<NarrowTree>(tree_));
}

template <typename Bvh, typename Kept>
void Tracer::uploadTree(const CompiledScene& scene, BuildQuality quality,
                        std::span<const std::uint32_t> triangles, Kept& kept) {
  const BvhTarget target = layout_ == BvhLayout::Wide ? BvhTarget::Wide : BvhTarget::Narrow;
  const BvhOptions options{.quality = quality, .target = target, .triangles = triangles};
  TreeContents contents;
  if (!scene_.instances().empty()) contents = divideContents(scene, scene_.instances(), triangles);
  TwoLevelBvh<Bvh> tree;
  if (!contents.instances.empty())
    tree = buildTwoLevel<Bvh>(scene, contents, options);
  else if constexpr (std::is_same_v<Bvh, WideBvh>)
    tree.bvh = makeWideBvh(buildBvh(scene, options), scene);
  else
    tree.bvh = makeNarrowBvh(buildBvh(scene, options), scene);
  kept.nodes = {*context_, spanOf(tree.bvh.nodes)};
  kept.leaves = {*context_, spanOf(leavesOf(tree.bvh))};
  instances_ = {*context_, spanOf(tree.instances)};
  upper_ = std::move(tree.upper);
  treeBytes_ = kept.nodes.bytes() + kept.leaves.bytes() + (tree.instances.empty() ? 0 : instances_.bytes());
  stackSize_ = tree.bvh.stackSize;
}

template <typename Bvh, typename Kept>
void Tracer::moveInstances(const CompiledScene& scene, Kept& kept) {
  const Bvh top = buildUpperLevel<Bvh>(scene, upper_);
  kept.nodes.write(spanOf(top.nodes));
  instances_.write(spanOf(instanceRecords(scene, upper_)));
  stackSize_ = top.stackSize;
}

/// Rebuilds the tree over `triangles`. If all triangles belong to instances, the shapes keep their trees.
void Tracer::moveTree(const CompiledScene& scene, std::span<const std::uint32_t> triangles) {
  const std::uint32_t before = stackBucket(stackSize_);
  if (upper_.instances.empty() || !upper_.others.empty())
    uploadTree(scene, BuildQuality::Balanced, triangles);
  else if (layout_ == BvhLayout::Wide)
    moveInstances<WideBvh>(scene, std::get<WideTree>(tree_));
  else
    moveInstances<NarrowBvh>(scene, std::get<NarrowTree>(tree_));
  if (stackBucket(stackSize_) != before) dropKernels();
}

void Tracer::trace(Query query, const Buffer<Ray>& rays, Buffer<Hit>& hits, std::size_t count,
                   std::size_t first, DeviceLane lane) {
  if (unbuilt_ != nullptr) startTree();
  traceTree(query, rays, hits, count, first, lane);
  if (!separated_ || count == 0) return;
  if (separatedHits_.size() < count) separatedHits_ = Buffer<Hit>(*context_, count);
  separated_->traceTree(query, rays, separatedHits_, count, first, lane);
  auto& join = query == Query::Shadows ? joinShadows_ : keepNearer_;
  join.launch({count, lane}, static_cast<std::uint32_t>(count), separatedHits_, hits);
}

void Tracer::traceTree(Query query, const Buffer<Ray>& rays, Buffer<Hit>& hits, std::size_t count,
                       std::size_t first, DeviceLane lane) {
  const float open = query == Query::Shadows ? 1.0f : 0.0f;
  if (treeless_) return hits.fill({open, PRELIGHT_NO_TRIANGLE, open, open});
  const bool wide = layout_ == BvhLayout::Wide;
  const WorkSize size =
      wide ? WorkSize((count + PRELIGHT_BATCH - 1) / PRELIGHT_BATCH, 1, lane) : WorkSize(count, lane);
  if (query == Query::Shadows)
    return traceShadowTree(rays, hits, static_cast<std::uint32_t>(count), static_cast<std::uint32_t>(first),
                           size);
  std::visit(
      [&](auto& tree) {
        auto& kernel = query == Query::Any ? tree.any : tree.closest;
        if (!kernel)
          kernel = {*context_, wide ? "bvh/wide_kernels.cl" : "bvh/narrow_kernels.cl", traceOptions(query),
                    "traceRays"};
        kernel.launch(size, tree.nodes, tree.leaves, instances_, scene_.layoutBuffer(), scene_.surface(),
                      rays, hits, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count));
      },
      tree_);
}

void Tracer::traceShadowTree(const Buffer<Ray>& rays, Buffer<Hit>& hits, std::uint32_t count,
                             std::uint32_t first, WorkSize size) {
  const char* file =
      layout_ == BvhLayout::Wide ? "bvh/wide_shadow_kernels.cl" : "bvh/narrow_shadow_kernels.cl";
  const DeviceScene& scene = panes_ ? panes_->scene : scene_;
  const Buffer<device::ShadingLine> none(*context_, 0);
  std::visit(
      [&](auto& tree) {
        if (!tree.shadows) tree.shadows = {*context_, file, traceOptions(Query::Shadows), "traceShadows"};
        tree.shadows.launch(size, tree.nodes, tree.leaves, instances_, scene.layoutBuffer(), scene.surface(),
                            panes_ ? scene.shading() : none, rays, hits, first, count);
      },
      tree_);
}

void Tracer::traceShadows(const Buffer<Ray>& rays, Buffer<Hit>& hits, std::size_t count, std::size_t first,
                          DeviceLane lane) {
  trace(dims_ ? Query::Shadows : Query::Any, rays, hits, count, first, lane);
}

void Tracer::traceClosest(const Buffer<Ray>& rays, Buffer<Hit>& hits, std::size_t count, std::size_t first,
                          DeviceLane lane) {
  trace(Query::Closest, rays, hits, count, first, lane);
}

void Tracer::traceAny(const Buffer<Ray>& rays, Buffer<Hit>& hits, std::size_t count, std::size_t first,
                      DeviceLane lane) {
  trace(Query::Any, rays, hits, count, first, lane);
}

std::vector<Hit> Tracer::traceFromHost(Query query, std::span<const Ray> rays) {
  std::vector<Hit> all(rays.size());
  const std::size_t block = std::min(rays.size(), raysPerLaunch);
  Buffer<Ray> rayBuffer(*context_, block);
  Buffer<Hit> hitBuffer(*context_, block);
  for (std::size_t first = 0; first < rays.size(); first += block) {
    const std::size_t count = std::min(block, rays.size() - first);
    rayBuffer.write(rays.subspan(first, count));
    trace(query, rayBuffer, hitBuffer, count, 0, {});
    hitBuffer.read(std::span(all).subspan(first, count));
  }
  return all;
}

std::vector<Hit> Tracer::traceClosest(std::span<const Ray> rays) {
  return traceFromHost(Query::Closest, rays);
}
std::vector<Hit> Tracer::traceAny(std::span<const Ray> rays) { return traceFromHost(Query::Any, rays); }

std::vector<Hit> Tracer::traceShadows(std::span<const Ray> rays) {
  std::vector<Hit> hits = traceFromHost(dims_ ? Query::Shadows : Query::Any, rays);
  if (dims_) return hits;
  for (Hit& hit : hits)
    if (hit.triangle == PRELIGHT_NO_TRIANGLE) hit.t = hit.u = hit.v = 1.0f;
  return hits;
}

}  // namespace prelight
