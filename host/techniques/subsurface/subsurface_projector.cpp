#include "techniques/subsurface/subsurface_projector.h"

#include <algorithm>
#include <span>
#include <vector>

#include "techniques/haar/haar_transfer.h"
#include "techniques/harmonic_rows.h"
#include "techniques/receiver_cast.h"
#include "scene/lobes.h"

namespace prelight {

namespace {

/// [slot], 1 where light passes through a surface diffusely.
std::vector<std::uint8_t> translucentSlots(const CompiledScene& scene, const FitMesh& mesh) {
  const std::vector<std::uint8_t> triangles = translucentTriangles(scene);
  std::vector<std::uint8_t> slots(mesh.slotCount(), 0);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const std::uint32_t slot : mesh.triangles[t]) slots[slot] |= triangles[t];
  return slots;
}

class SubsurfaceProjector final : public Projector {
 public:
  explicit SubsurfaceProjector(const BakeContext& context)
      : context_(context), slots_(translucentSlots(context.scene, context.mesh)) {}

  std::string_view stage() const override { return "through"; }

  void run(ReceiverCast* cast, Bake& bake, Progress& progress) override {
    const BakeRequest& request = context_.request;
    ThroughTransfer through;
    if (request.ao) through.ao = accessibility(*cast, progress);
    if (request.sh.order > 0 || request.ch.order > 0 || request.haar.size > 0)
      addLight(cast->transfer(progress), through, progress);
    bake.through = std::move(through);
  }

 private:
  /// [vertex], of the backs.
  std::vector<float> accessibility(const ReceiverCast& cast, const Progress& progress) const {
    const SideSums& back = cast.scene().back()->sums();
    const std::vector<float> fitted = back.fit().solve(defaultSmoothing, {.progress = &progress});
    std::vector<float> open;
    for (const std::uint32_t slot : context_.mesh.slotOfVertex) {
      const double value = 1.0 + double(fitted[slot * cast.hemisphere().fitWidth()]);
      open.push_back(slots_[slot] != 0 ? finiteOr(std::clamp(value, 0.0, 1.0), 1.0f) : 0.0f);
    }
    return open;
  }

  void addLight(const SlotTransfer& transfer, ThroughTransfer& through, Progress& progress) const {
    const BakeRequest& request = context_.request;
    const std::vector<float> rows = throughRows(transfer);
    const SlotValues values{rows, transfer.columns()};
    if (request.sh.order > 0) through.sh = shTransfer(context_, transfer, values);
    if (request.ch.order > 0) through.ch = chTransfer(context_, transfer, values);
    if (request.haar.size > 0)
      through.haar = makeThroughHaar(context_.mesh, transfer, rows, request.haar, progress);
  }

  /// SlotTransfer::through, without what arrives behind surfaces that let nothing through.
  std::vector<float> throughRows(const SlotTransfer& transfer) const {
    std::vector<float> rows = transfer.through;
    const std::size_t width = 3 * transfer.columns();
    for (std::size_t slot = 0; slot < slots_.size(); ++slot)
      if (slots_[slot] == 0)
        std::fill_n(rows.begin() + static_cast<std::ptrdiff_t>(slot * width), width, 0.0f);
    return rows;
  }

  const BakeContext& context_;
  std::vector<std::uint8_t> slots_;  ///< [slot], 1: light comes through
};

}  // namespace

std::unique_ptr<Projector> subsurfaceProjector(const BakeContext& context) {
  if (!context.request.subsurface) return nullptr;
  return std::make_unique<SubsurfaceProjector>(context);
}

}  // namespace prelight
