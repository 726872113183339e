#include "techniques/vector_occluders/vector_occluders_projector.h"

#include <fmt/format.h>

#include <optional>

#include "occluders/occluder_cut.h"
#include "occluders/occluder_threshold.h"
#include "occluders/occluder_tree.h"
#include "occluders/occluder_vectors.h"
#include "techniques/receiver_cast.h"
#include "techniques/vector_occluders/occluder_column.h"
#include "techniques/vector_occluders/occluder_transfer.h"
#include "scene/vertex_surface.h"

namespace prelight {

namespace {

constexpr std::size_t occluderLeaves =
    128;  // of all nodes; twice as many gain 0.002 to 0.007 of shadow error

class VectorOccludersProjector final : public Projector {
 public:
  explicit VectorOccludersProjector(const BakeContext& context) : context_(context), column_(groups_) {
    const OccluderKind kind = context.request.occluders.kind;
    if (kind == OccluderKind::Auto) tree_ = makeOccluderTree(context.scene, occluderLeaves);
    groups_ = tree_ ? leavesOf(*tree_) : makeOccluderGroups(context.scene, kind);
  }

  std::string_view stage() const override { return "occluders"; }
  void addColumns(const HemisphereColumn& /*hemisphere*/, std::vector<Column*>& columns) override {
    columns.push_back(&column_);
  }

  void run(ReceiverCast* cast, Bake& bake, Progress& /*progress*/) override {
    OccluderTransfer transfer =
        makeOccluderTransfer(context_.scene, context_.mesh, column_.meansOn(cast->front()),
                             cast->accessibility(), groups_, neededVectors(context_.scene));
    if (tree_) transfer = cutThroughTree(std::move(transfer));
    const DroppedOccluders dropped = dropOccluders(transfer, context_.request.occluders.leastFormFactor);
    addNote(transfer, dropped);
    bake.occluders = std::move(transfer);
  }

 private:
  /// Clusters of every node's vertices, joined again for each vertex as its records allow.
  OccluderTransfer cutThroughTree(OccluderTransfer leaves) const {
    const std::vector<std::uint32_t> nodes = leafNodes(*tree_);
    for (std::uint32_t& occluder : leaves.occluders) occluder = nodes[occluder];
    return cutOccluders(leaves, *tree_, surfaceOfVertices(context_.scene),
                        context_.request.occluders.records);
  }

  void addNote(const OccluderTransfer& transfer, const DroppedOccluders& dropped) {
    std::string text =
        fmt::format("vector occluders: {} of them, {:.1f} records per vertex, {} vectors per record",
                    transfer.names.size(), double(transfer.recordCount()) / context_.scene.vertexCount(),
                    transfer.stored.size());
    if (context_.request.occluders.leastFormFactor > 0.0)
      text += fmt::format("; the dropped ones hide {:.2g} of the sky on average, {:.2g} at most",
                          dropped.mean, dropped.most);
    context_.report.notes.push_back(text);
  }

  const BakeContext& context_;
  std::optional<OccluderTree> tree_;  ///< whose leaves they are
  OccluderGroups groups_;
  OccluderColumn column_;
};

}  // namespace

std::unique_ptr<Projector> vectorOccludersProjector(const BakeContext& context) {
  if (!context.request.occluders) return nullptr;
  return std::make_unique<VectorOccludersProjector>(context);
}

}  // namespace prelight
