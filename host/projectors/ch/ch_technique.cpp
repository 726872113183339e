#include "projectors/ch/ch_technique.h"

#include "projectors/sh/harmonic_file.h"
#include "projectors/summary_text.h"

namespace prelight {

namespace {

using Json = Technique::Json;

std::size_t storedBytes(const Bake& bake) { return bake.ch ? bytesOf(bake.ch->coefficients) : 0; }

void writeEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  if (output.bake.ch) entry["ch"] = harmonicToJson(output.document, *output.bake.ch, ranges);
}

class Reader final : public TechniqueReader {
 public:
  explicit Reader(const BakedInput& input) : input_(input), values_(input.document, input.root) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& bake) override {
    if (const auto ch = entry.find("ch")) readHarmonic(values_, *ch, ranges, input_.scene, bake.ch);
  }

 private:
  const BakedInput& input_;
  ValueReader values_;
};

void summarize(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (bake.ch) found.push_back(summaryOf(*bake.ch, "ch", "CH"));
}

}  // namespace

Technique chTechnique() {
  return {.name = "ch",
          .members = {"ch"},
          .accessors = {"coefficients"},
          .storedBytes = storedBytes,
          .writeEntry = writeEntry,
          .makeReader = makeTechniqueReader<Reader>,
          .summarize = summarize};
}

}  // namespace prelight
