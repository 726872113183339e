#include "techniques/occlusion_cones/occlusion_cones_technique.h"

#include "io/values/append_values.h"
#include "io/values/vertex_values.h"
#include "techniques/summary_text.h"

namespace prelight {

namespace {

using Json = Technique::Json;

std::size_t occlusionConesBytes(const Bake& bake) { return bytesOf(bake.apertures); }

void writeOcclusionConesEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  if (!output.bake.apertures.empty())
    entry["aperture"] = appendVertices(output.document, output.bake.apertures, ranges, 1);
}

class OcclusionConesReader final : public TechniqueReader {
 public:
  explicit OcclusionConesReader(const BakedInput& input)
      : input_(input), values_(input.document, input.root) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& bake) override {
    if (const auto aperture = entry.find("aperture"))
      placeVertices(values_.floats(*aperture, "SCALAR", vertexCount(ranges)), ranges, 1, input_.scene,
                    bake.apertures);
  }

 private:
  const BakedInput& input_;
  ValueReader values_;
};

void summarizeOcclusionCones(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (!bake.apertures.empty())
    found.push_back({"aperture", "occlusion cones", bytesOf(bake.apertures), true, true});
}

}  // namespace

Technique occlusionConesTechnique() {
  return {.name = "occlusion_cones",
          .members = {"aperture"},
          .use = {.bounces = false},
          .accessors = {"aperture"},
          .storedBytes = occlusionConesBytes,
          .writeEntry = writeOcclusionConesEntry,
          .makeReader = makeTechniqueReader<OcclusionConesReader>,
          .summarize = summarizeOcclusionCones};
}

}  // namespace prelight
