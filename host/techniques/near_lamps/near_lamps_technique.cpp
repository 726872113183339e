#include "techniques/near_lamps/near_lamps_technique.h"

#include <fmt/format.h>

#include <cmath>

#include "compress/half_float.h"
#include "io/values/append_values.h"
#include "io/values/value_reader.h"
#include "io/values/vertex_values.h"
#include "techniques/summary_text.h"

namespace prelight {

namespace {

using Json = Technique::Json;

std::size_t widthOf(const NearLampTransfer& transfer) {
  return transfer.columns() * static_cast<std::size_t>(transfer.shells);
}

std::size_t nearLampsBytes(const Bake& bake) { return bake.nearLamps ? bytesOf(bake.nearLamps->halves) : 0; }

void writeNearLampsEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  if (!output.bake.nearLamps) return;
  const NearLampTransfer& transfer = *output.bake.nearLamps;
  entry["nearLamps"] = {
      {"order", transfer.order},
      {"shells", transfer.shells},
      {"nearest", transfer.nearest},
      {"farthest", transfer.farthest},
      {"halves", appendVertices(output.document, transfer.halves, ranges, widthOf(transfer))}};
}

class NearLampsReader final : public TechniqueReader {
 public:
  explicit NearLampsReader(const BakedInput& input) : input_(input), values_(input.document, input.root) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& bake) override {
    const auto json = entry.find("nearLamps");
    if (!json) return;
    const NearLampTransfer header = readHeader(*json);
    if (!bake.nearLamps) bake.nearLamps = header;
    NearLampTransfer& transfer = *bake.nearLamps;
    expectSame(*json,
               header.order == transfer.order && header.shells == transfer.shells &&
                   header.nearest == transfer.nearest && header.farthest == transfer.farthest,
               "order, shells, nearest and farthest");
    const JsonCursor halves = json->at("halves");
    const auto values = values_.integers<std::uint16_t>(halves, vertexCount(ranges) * widthOf(transfer));
    for (const std::uint16_t value : values)
      if (!std::isfinite(fromHalf(value)))
        halves.fail("expected finite numbers, got one that is not", rebake);
    placeVertices(values, ranges, widthOf(transfer), input_.scene, transfer.halves);
  }

 private:
  static NearLampTransfer readHeader(const JsonCursor& json) {
    NearLampTransfer header;
    header.order = readNumber(json.at("order"), 1, maxStoredOrder);
    header.shells = readNumber(json.at("shells"), 2, BakeRequest::maxShells);
    header.nearest = json.at("nearest").asNumber();
    header.farthest = json.at("farthest").asNumber();
    if (!(header.nearest > 0.0 && header.farthest > header.nearest && std::isfinite(header.farthest)))
      json.fail(fmt::format("expected 0 < nearest < farthest, in metres, got {:g} and {:g}", header.nearest,
                            header.farthest),
                rebake);
    return header;
  }

  const BakedInput& input_;
  ValueReader values_;
};

void summarizeNearLamps(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (!bake.nearLamps) return;
  const NearLampTransfer& transfer = *bake.nearLamps;
  const std::size_t bytes = nearLampsBytes(bake);
  found.push_back({"nearLamps",
                   fmt::format("shadows of near lamps in {} shells from {:.3g} to {:.3g} m, order {}",
                               transfer.shells, transfer.nearest, transfer.farthest, transfer.order),
                   bytes,
                   true,
                   {{"order", transfer.order},
                    {"shells", transfer.shells},
                    {"nearest", transfer.nearest},
                    {"farthest", transfer.farthest},
                    {"bytes", bytes}}});
}

}  // namespace

Technique nearLampsTechnique() {
  return {.name = "near_lamps",
          .members = {"nearLamps"},
          .use = {.bounces = false},
          .accessors = {"halves"},
          .storedBytes = nearLampsBytes,
          .writeEntry = writeNearLampsEntry,
          .makeReader = makeTechniqueReader<NearLampsReader>,
          .summarize = summarizeNearLamps};
}

}  // namespace prelight
