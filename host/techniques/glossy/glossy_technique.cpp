#include "techniques/glossy/glossy_technique.h"

#include <fmt/format.h>

#include "io/values/append_values.h"
#include "io/values/vertex_values.h"
#include "techniques/summary_text.h"

namespace prelight {

namespace {

using Json = Technique::Json;

std::size_t glossyBytes(const Bake& bake) { return bake.glossy ? bytesOf(bake.glossy->matrices) : 0; }

std::size_t entriesOf(const GlossyTransfer& glossy) {
  const auto n = static_cast<std::size_t>(glossy.order * glossy.order);
  return n * n * static_cast<std::size_t>(glossy.channels);
}

void writeGlossyEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  if (!output.bake.glossy) return;
  const GlossyTransfer& glossy = *output.bake.glossy;
  Json json = {{"order", glossy.order}, {"channels", glossy.channels}, {"bounces", glossy.bounces}};
  json["matrices"] = appendVertices(output.document, glossy.matrices, ranges, entriesOf(glossy));
  entry["glossy"] = std::move(json);
}

class GlossyReader final : public TechniqueReader {
 public:
  explicit GlossyReader(const BakedInput& input) : input_(input), values_(input.document, input.root) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& bake) override {
    const auto json = entry.find("glossy");
    if (!json) return;
    GlossyTransfer header;
    header.order = readNumber(json->at("order"), 1, maxStoredOrder);
    header.channels = readChannels(*json);
    header.bounces = readBounces(*json);
    if (!bake.glossy) bake.glossy = header;
    expectSame(*json,
               header.order == bake.glossy->order && header.channels == bake.glossy->channels &&
                   header.bounces == bake.glossy->bounces,
               "order, channels and bounces");
    const std::size_t width = entriesOf(header);
    placeVertices(values_.floats(json->at("matrices"), "SCALAR", vertexCount(ranges) * width), ranges, width,
                  input_.scene, bake.glossy->matrices);
  }

 private:
  const BakedInput& input_;
  ValueReader values_;
};

void summarizeGlossy(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (!bake.glossy) return;
  const GlossyTransfer& transfer = *bake.glossy;
  const std::size_t bytes = bytesOf(transfer.matrices);
  found.push_back({"glossy",
                   fmt::format("glossy matrices of order {}, {}", transfer.order,
                               channelsText(transfer.channels, transfer.bounces)),
                   bytes,
                   true,
                   {{"order", transfer.order},
                    {"channels", transfer.channels},
                    {"bounces", transfer.bounces},
                    {"bytes", bytes}}});
}

}  // namespace

Technique glossyTechnique() {
  return {.name = "glossy",
          .members = {"glossy"},
          .accessors = {"matrices"},
          .storedBytes = glossyBytes,
          .writeEntry = writeGlossyEntry,
          .makeReader = makeTechniqueReader<GlossyReader>,
          .summarize = summarizeGlossy};
}

}  // namespace prelight
