#pragma once

#include <optional>
#include <string>

#include "io/values/baked_ranges.h"
#include "io/values/value_reader.h"
#include "prelight/transfer.h"
#include "techniques/packed_values.h"
#include "techniques/projector.h"
#include "techniques/technique.h"

/// Diffuse transfer in a harmonic basis: what SH and CH share from plan to file.
namespace prelight {

/// Plans transfer of an order, 0: not asked for. `how` follows the text.
PlannedPass planHarmonics(Pass name, int order, bool colored, const std::string& how);

/// Returns SH transfer of the request's order: the first bands of `values`, those of one side of `transfer`.
HarmonicTransfer shTransfer(const BakeContext& context, const SlotTransfer& transfer,
                            const SlotValues& values);

/// Returns CH transfer of the request's order, from the same bands: coefficients, or, if the request says so,
/// the inner products that a projection onto non-orthogonal functions takes for them.
HarmonicTransfer chTransfer(const BakeContext& context, const SlotTransfer& transfer,
                            const SlotValues& values);

/// Returns the transfer of a primitive's vertices as it stands in members `sh`, `ch`, and `sh` of keys.
nlohmann::ordered_json harmonicToJson(GltfDocument& document, const HarmonicTransfer& transfer,
                                      const PrimitiveRanges& ranges);

/// Returns it as a column that may become bytes, with a scale per vertex and channel; `name` is for people.
nlohmann::ordered_json harmonicToJson(const BakedOutput& output, std::string_view name,
                                      const HarmonicTransfer& transfer, const PrimitiveRanges& ranges);

/// Reads it into `target`; the first primitive sets its order, channels and bounces.
void readHarmonic(const ValueReader& values, const JsonCursor& json, const PrimitiveRanges& ranges,
                  const CompiledScene& scene, std::optional<HarmonicTransfer>& target);

/// Describes the transfer in a line of `prelight info`; `name` is for people.
BakedSummary summaryOf(const HarmonicTransfer& transfer, const char* key, const char* name);

/// Returns the shape of a transfer's coefficients: "[vertex][channel 3][i] of order 4".
std::string layoutOf(const HarmonicTransfer& transfer);

/// Diffuse transfer at vertices in a harmonic basis. `Kind` has the member of Bake that holds it
/// (`transfer`), its member of a file's entry (`key`), its name for people (`title`), and whether its numbers
/// may become bytes as those of other columns do (`quantizable`).
template <class Kind>
struct Harmonic {
  static void writeEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Technique::Json& entry) {
    if (const auto& transfer = output.bake.*Kind::transfer)
      entry[Kind::key] = Kind::quantizable ? harmonicToJson(output, Kind::title, *transfer, ranges)
                                           : harmonicToJson(output.document, *transfer, ranges);
  }

  static std::size_t storedBytes(const Bake& bake) {
    const auto& transfer = bake.*Kind::transfer;
    return transfer ? bytesOf(transfer->coefficients) : 0;
  }

  static void summarize(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
    if (const auto& transfer = bake.*Kind::transfer)
      found.push_back(summaryOf(*transfer, Kind::key, Kind::title));
  }

  static void addArrays(const Bake& bake, std::vector<BakedArray>& arrays) {
    if (const auto& transfer = bake.*Kind::transfer)
      arrays.push_back({Kind::key, layoutOf(*transfer), {transfer->coefficients}});
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

  static TechniqueFile file() {
    return {.members = {Kind::key},
            .quantizable = Kind::quantizable,
            .accessors = {"coefficients"},
            .storedBytes = storedBytes,
            .writeEntry = writeEntry,
            .makeReader = makeTechniqueReader<Reader>};
  }
};

}  // namespace prelight
