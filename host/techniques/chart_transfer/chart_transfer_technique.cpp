#include "techniques/chart_transfer/chart_transfer_technique.h"

#include <fmt/format.h>

#include <algorithm>

#include "techniques/chart_transfer/chart_file.h"
#include "techniques/summary_text.h"

namespace prelight {

namespace {

using Json = Technique::Json;

void writeChartTransferEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  if (!output.bake.chartTransfer) return;
  Json texels = chartsToJson(output.document, *output.bake.chartTransfer, output.bake.compressedParts.texels,
                             output.scene, ranges);
  if (!texels.is_null()) entry["texels"] = std::move(texels);
}

void writeChartTransferRoot(const BakedOutput& output, Json& root) {
  if (output.bake.compressedParts.texels)
    root["texelsCompressed"] = sharedToJson(output.document, *output.bake.compressedParts.texels);
}

class ChartTransferReader final : public TechniqueReader {
 public:
  explicit ChartTransferReader(const BakedInput& input) : charts_(input) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& /*bake*/) override {
    if (const auto texels = entry.find("texels")) charts_.read(*texels, ranges);
  }

  void finish(Bake& bake) override { charts_.finish(bake.chartTransfer, bake.compressedParts.texels); }

 private:
  ChartReader charts_;
};

void summarizeChartTransfer(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (!bake.chartTransfer) return;
  const ChartTransfer& transfer = *bake.chartTransfer;
  std::size_t bytes = 0, texels = 0;
  int most = 0;
  for (const ChartTransfer::Map& map : transfer.maps) {
    bytes += bytesOf(map.coefficients);
    texels += map.texels();
    most = std::max({most, map.width, map.height});
  }
  const std::optional<CompressedTransfer>& compressed = bake.compressedParts.texels;
  if (compressed) bytes = compressed->byteCount();
  found.push_back(
      {"texels",
       fmt::format("{} of at most {} texels a side, {} texels in all; SH of order {}, {}{}",
                   counted(transfer.maps.size(), "light map"), most, texels, transfer.order,
                   channelsText(transfer.channels, transfer.bounces), compressionText(compressed)),
       bytes,
       false,
       {{"maps", transfer.maps.size()},
        {"largestSide", most},
        {"texels", texels},
        {"order", transfer.order},
        {"channels", transfer.channels},
        {"bounces", transfer.bounces},
        {"bytes", bytes}}});
}

}  // namespace

Technique chartTransferTechnique() {
  return {.name = "texels",
          .members = {"texels"},
          .everywhere = false,
          .use = {.scattering = true},
          .accessors = compressedAccessors({"texCoord", "coefficients"}),
          .writeEntry = writeChartTransferEntry,
          .writeRoot = writeChartTransferRoot,
          .makeReader = makeTechniqueReader<ChartTransferReader>,
          .summarize = summarizeChartTransfer};
}

}  // namespace prelight
