#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>

#include "io/values/baked_ranges.h"
#include "io/values/value_reader.h"
#include "prelight/transfer.h"
#include "techniques/technique.h"

namespace prelight {

/// Harmonic transfer of a primitive's vertices: members `sh`, `ch`, and `sh` of keys.
nlohmann::ordered_json harmonicToJson(GltfDocument& document, const HarmonicTransfer& transfer,
                                      const PrimitiveRanges& ranges);

/// Reads it into `target`; the first primitive sets its order, channels and bounces.
void readHarmonic(const ValueReader& values, const JsonCursor& json, const PrimitiveRanges& ranges,
                  const CompiledScene& scene, std::optional<HarmonicTransfer>& target);

/// What `info` says of it; `name` is for people.
BakedSummary summaryOf(const HarmonicTransfer& transfer, const char* key, const char* name);

}  // namespace prelight
