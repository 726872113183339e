#include "techniques/glossy/glossy_projector.h"

#include "techniques/glossy/glossy_transfer.h"
#include "techniques/packed_values.h"
#include "techniques/receiver_cast.h"

namespace prelight {

namespace {

class GlossyProjector final : public Projector {
 public:
  explicit GlossyProjector(const BakeContext& context) : context_(context) {}

  std::string_view stage() const override { return "glossy"; }
  bool readsReflected() const override { return true; }
  void addColumns(const HemisphereColumn& /*hemisphere*/, std::vector<Column*>& columns) override {
    columns.push_back(&receivers_);
  }

  void run(ReceiverCast* cast, Bake& bake, Progress& progress) override {
    const SlotTransfer& transfer = cast->transfer(progress);
    bake.glossy =
        pack(transfer, makeGlossyMatrices(context_.scene, context_.mesh,
                                          {cast->caster(), cast->transport(), cast->scene().front(),
                                           cast->hemisphere().baselineOf(Side::Front), receivers_},
                                          cast->fitted(), transfer, context_.request.glossy.order, progress));
  }

 private:
  /// `matrices` are [slot][channel][i][j].
  GlossyTransfer pack(const SlotTransfer& transfer, const std::vector<float>& matrices) const {
    const int order = context_.request.glossy.order;
    const auto width = static_cast<std::size_t>(transfer.channels() * order * order * order * order);
    GlossyTransfer glossy{order, transfer.channels(), transfer.bounces, {}};
    glossy.matrices.reserve(context_.scene.vertexCount() * width);
    for (std::uint32_t v = 0; v < context_.scene.vertexCount(); ++v)
      for (std::size_t i = 0; i < width; ++i)
        glossy.matrices.push_back(finiteOr(matrices[context_.mesh.slotOfVertex[v] * width + i], 0.0f));
    return glossy;
  }

  const BakeContext& context_;
  StoredReceivers receivers_;
};

}  // namespace

std::unique_ptr<Projector> glossyProjector(const BakeContext& context) {
  if (context.request.glossy.order == 0) return nullptr;
  return std::make_unique<GlossyProjector>(context);
}

}  // namespace prelight
