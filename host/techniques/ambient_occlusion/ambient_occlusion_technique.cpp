#include "techniques/ambient_occlusion/ambient_occlusion_technique.h"

#include "io/values/append_values.h"
#include "io/values/vertex_values.h"
#include "techniques/summary_text.h"

namespace prelight {

namespace {

using Json = Technique::Json;

std::size_t ambientOcclusionBytes(const Bake& bake) { return bytesOf(bake.ao) + bytesOf(bake.bentNormals); }

void writeAmbientOcclusionEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  const Bake& bake = output.bake;
  if (!bake.ao.empty()) entry["ao"] = appendVertices(output.document, bake.ao, ranges, 1);
  if (!bake.bentNormals.empty())
    entry["bentNormal"] = appendVectors(output.document, bake.bentNormals, ranges);
}

class AmbientOcclusionReader final : public TechniqueReader {
 public:
  explicit AmbientOcclusionReader(const BakedInput& input)
      : input_(input), values_(input.document, input.root) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& bake) override {
    if (const auto ao = entry.find("ao"))
      placeVertices(values_.floats(*ao, "SCALAR", vertexCount(ranges)), ranges, 1, input_.scene, bake.ao);
    if (const auto bent = entry.find("bentNormal"))
      placeVertices(readVectors(values_, *bent, ranges), ranges, 1, input_.scene, bake.bentNormals);
  }

 private:
  const BakedInput& input_;
  ValueReader values_;
};

void summarizeAmbientOcclusion(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (!bake.ao.empty()) found.push_back({"ao", "AO", bytesOf(bake.ao), true, true});
  if (!bake.bentNormals.empty())
    found.push_back({"bentNormal", "bent normals", bytesOf(bake.bentNormals), true, true});
}

}  // namespace

Technique ambientOcclusionTechnique() {
  return {.name = "ambient_occlusion",
          .members = {"ao", "bentNormal"},
          .use = {.bounces = false},
          .accessors = {"ao", "bentNormal"},
          .storedBytes = ambientOcclusionBytes,
          .writeEntry = writeAmbientOcclusionEntry,
          .makeReader = makeTechniqueReader<AmbientOcclusionReader>,
          .summarize = summarizeAmbientOcclusion};
}

}  // namespace prelight
