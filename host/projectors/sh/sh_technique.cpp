#include "projectors/sh/sh_technique.h"

#include "projectors/sh/harmonic_file.h"
#include "projectors/summary_text.h"

namespace prelight {

namespace {

using Json = Technique::Json;

std::size_t storedBytes(const Bake& bake) { return bake.sh ? bytesOf(bake.sh->coefficients) : 0; }

void writeEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  if (output.bake.sh) entry["sh"] = harmonicToJson(output.document, *output.bake.sh, ranges);
}

class Reader final : public TechniqueReader {
 public:
  explicit Reader(const BakedInput& input) : input_(input), values_(input.document, input.root) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& bake) override {
    if (const auto sh = entry.find("sh")) readHarmonic(values_, *sh, ranges, input_.scene, bake.sh);
  }

 private:
  const BakedInput& input_;
  ValueReader values_;
};

void summarize(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (bake.sh) found.push_back(summaryOf(*bake.sh, "sh", "SH"));
}

}  // namespace

Technique shTechnique() {
  return {.name = "sh",
          .members = {"sh"},
          .accessors = {"coefficients"},
          .storedBytes = storedBytes,
          .writeEntry = writeEntry,
          .makeReader = makeTechniqueReader<Reader>,
          .summarize = summarize};
}

}  // namespace prelight
