#include "techniques/subsurface/subsurface_technique.h"

#include <algorithm>

#include "io/values/append_values.h"
#include "io/values/vertex_values.h"
#include "techniques/haar/haar_file.h"
#include "techniques/sh/harmonic_file.h"
#include "techniques/summary_text.h"
#include "scene/lobes.h"

namespace prelight {

namespace {

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
  GltfDocument& document = output.document;
  Json json = Json::object();
  if (!through.ao.empty()) json["ao"] = appendVertices(document, through.ao, ranges, 1);
  if (through.sh) json["sh"] = harmonicToJson(document, *through.sh, ranges);
  if (through.ch) json["ch"] = harmonicToJson(document, *through.ch, ranges);
  if (through.haar) json["haar"] = haarToJson(document, *through.haar, ranges);
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
          .members = {"through"},
          .everywhere = false,
          .use = {.scattering = true},
          .accessors = {"ao", "coefficients", "offsets", "indices", "values"},
          .storedBytes = throughBytes,
          .writeEntry = writeThroughEntry,
          .makeReader = makeTechniqueReader<ThroughReader>,
          .summarize = summarizeThrough};
}

}  // namespace prelight
