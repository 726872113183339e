#include "techniques/subsurface/subsurface.h"

#include <algorithm>
#include <span>
#include <vector>

#include "io/values/baked_ranges.h"
#include "io/values/value_reader.h"
#include "scene/lobes.h"
#include "techniques/haar/haar_file.h"
#include "techniques/haar/haar_transfer.h"
#include "techniques/receiver_cast.h"
#include "techniques/sh/harmonics.h"

namespace prelight {

namespace {

void addSubsurfaceToKey(const BakeRequest& request, StateHash& hash) {
  if (request.subsurface) hash.text("subsurface");
}

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

std::unique_ptr<Projector> makeSubsurfaceProjector(const BakeContext& context) {
  if (!context.request.subsurface) return nullptr;
  return std::make_unique<SubsurfaceProjector>(context);
}

using Json = Technique::Json;

std::size_t throughBytes(const Bake& bake) {
  if (!bake.through) return 0;
  const ThroughTransfer& through = *bake.through;
  return bytesOf(through.ao) + (through.sh ? bytesOf(through.sh->coefficients) : 0) +
         (through.ch ? bytesOf(through.ch->coefficients) : 0) +
         (through.haar ? storedBytes(*through.haar) : 0);
}

/// Whether light passes through one of a primitive's triangles diffusely.
bool letsThrough(const CompiledScene& scene, const PrimitiveRanges& ranges) {
  return std::any_of(ranges.begin(), ranges.end(), [&](const PrimitiveRange& range) {
    const auto first = scene.triangleMaterials.begin() + static_cast<std::ptrdiff_t>(range.firstTriangle);
    return std::any_of(first, first + static_cast<std::ptrdiff_t>(range.triangleCount),
                       [&](std::uint32_t material) { return isTranslucent(scene.materials[material]); });
  });
}

void writeThroughEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  if (!output.bake.through || !letsThrough(output.scene, ranges)) return;
  const ThroughTransfer& through = *output.bake.through;
  Json json = Json::object();
  if (!through.ao.empty())
    json["ao"] = output.column("ao that comes through", through.ao, ranges, 1, accessibilityForm);
  if (through.sh) json["sh"] = harmonicToJson(output, "SH that comes through", *through.sh, ranges);
  if (through.ch) json["ch"] = harmonicToJson(output, "CH that comes through", *through.ch, ranges);
  if (through.haar) json["haar"] = haarToJson(output, "Haar that comes through", *through.haar, ranges);
  entry["through"] = std::move(json);
}

class ThroughReader final : public TechniqueReader {
 public:
  explicit ThroughReader(const BakedInput& input)
      : input_(input), values_(input.document, input.root), haar_(input) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& bake) override {
    const auto json = entry.find("through");
    if (!json) return;
    if (!bake.through) bake.through.emplace();
    ThroughTransfer& through = *bake.through;
    if (const auto ao = json->find("ao"))
      placeVertices(values_.floats(*ao, "SCALAR", vertexCount(ranges)), ranges, 1, input_.scene, through.ao);
    if (const auto sh = json->find("sh")) readHarmonic(values_, *sh, ranges, input_.scene, through.sh);
    if (const auto ch = json->find("ch")) readHarmonic(values_, *ch, ranges, input_.scene, through.ch);
    if (const auto haar = json->find("haar")) haar_.read(*haar, ranges, through.haar);
  }

  void finish(Bake& bake) override {
    if (bake.through && bake.through->haar) haar_.finish(*bake.through->haar);
  }

 private:
  const BakedInput& input_;
  ValueReader values_;
  HaarRowsReader haar_;
};

void summarizeThrough(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (!bake.through) return;
  const ThroughTransfer& through = *bake.through;
  std::vector<std::string> names;
  if (!through.ao.empty()) names.emplace_back("ao");
  if (through.sh) names.emplace_back("sh");
  if (through.ch) names.emplace_back("ch");
  if (through.haar) names.emplace_back("haar");
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  const std::size_t bytes = throughBytes(bake);
  found.push_back({"through",
                   "light that passes through surfaces, for " + text,
                   bytes,
                   true,
                   {{"of", names}, {"bytes", bytes}}});
}

}  // namespace

Technique subsurfaceTechnique() {
  return {.name = "subsurface",
          .part = &otherSidesPart,
          .use = {.scattering = true},
          .plan = {.addToKey = addSubsurfaceToKey},
          .makeProjector = makeSubsurfaceProjector,
          .file = {.members = {"through"},
                   .everywhere = false,
                   .quantizable = true,
                   .accessors = {"ao", "coefficients", "offsets", "indices", "values"},
                   .storedBytes = throughBytes,
                   .writeEntry = writeThroughEntry,
                   .makeReader = makeTechniqueReader<ThroughReader>},
          .summarize = summarizeThrough};
}

}  // namespace prelight
