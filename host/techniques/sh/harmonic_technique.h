#pragma once

#include "techniques/sh/harmonic_file.h"
#include "techniques/summary_text.h"

namespace prelight {

/// Diffuse transfer at vertices in a harmonic basis. `Kind` has the member of Bake that holds it
/// (`transfer`), its member of a file's entry (`key`) and its name for people (`title`).
template <class Kind>
struct Harmonic {
  static void writeEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Technique::Json& entry) {
    if (const auto& transfer = output.bake.*Kind::transfer)
      entry[Kind::key] = harmonicToJson(output.document, *transfer, ranges);
  }

  static std::size_t storedBytes(const Bake& bake) {
    const auto& transfer = bake.*Kind::transfer;
    return transfer ? bytesOf(transfer->coefficients) : 0;
  }

  static void summarize(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
    if (const auto& transfer = bake.*Kind::transfer)
      found.push_back(summaryOf(*transfer, Kind::key, Kind::title));
  }

  class Reader final : public TechniqueReader {
   public:
    explicit Reader(const BakedInput& input) : input_(input), values_(input.document, input.root) {}

    void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& bake) override {
      if (const auto json = entry.find(Kind::key))
        readHarmonic(values_, *json, ranges, input_.scene, bake.*Kind::transfer);
    }

   private:
    const BakedInput& input_;
    ValueReader values_;
  };

  static Technique technique() {
    return {.name = Kind::key,
            .members = {Kind::key},
            .accessors = {"coefficients"},
            .storedBytes = storedBytes,
            .writeEntry = writeEntry,
            .makeReader = makeTechniqueReader<Reader>,
            .summarize = summarize};
  }
};

}  // namespace prelight
