#include "techniques/radiosity/radiosity_technique.h"

#include <fmt/format.h>

#include "io/values/append_values.h"
#include "io/values/vertex_values.h"
#include "techniques/summary_text.h"

namespace prelight {

namespace {

using Json = Technique::Json;

std::size_t radiosityBytes(const Bake& bake) { return bake.irradiance ? bytesOf(*bake.irradiance) : 0; }

void writeRadiosityEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  if (output.bake.irradiance)
    entry["irradiance"] = appendVectors(output.document, *output.bake.irradiance, ranges);
}

class RadiosityReader final : public TechniqueReader {
 public:
  explicit RadiosityReader(const BakedInput& input) : input_(input), values_(input.document, input.root) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& bake) override {
    const auto json = entry.find("irradiance");
    if (!json) return;
    const std::vector<glm::vec3> vectors = readVectors(values_, *json, ranges);
    for (const glm::vec3& e : vectors)
      if (e.x < 0.0f || e.y < 0.0f || e.z < 0.0f)
        json->fail(fmt::format("irradiance of {}, {}, {}, expected none below 0", e.x, e.y, e.z), rebake);
    if (!bake.irradiance) bake.irradiance.emplace();
    placeVertices(vectors, ranges, 1, input_.scene, *bake.irradiance);
  }

 private:
  const BakedInput& input_;
  ValueReader values_;
};

void summarizeRadiosity(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (bake.irradiance)
    found.push_back({"irradiance", "irradiance of static lights", bytesOf(*bake.irradiance), true, true});
}

}  // namespace

Technique radiosityTechnique() {
  return {.name = "radiosity",
          .members = {"irradiance"},
          .use = {.lights = true},
          .accessors = {"irradiance"},
          .storedBytes = radiosityBytes,
          .writeEntry = writeRadiosityEntry,
          .makeReader = makeTechniqueReader<RadiosityReader>,
          .summarize = summarizeRadiosity};
}

}  // namespace prelight
