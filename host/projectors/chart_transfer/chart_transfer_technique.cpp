#include "projectors/chart_transfer/chart_transfer_technique.h"

#include <fmt/format.h>

#include <algorithm>

#include "projectors/chart_transfer/chart_file.h"
#include "projectors/summary_text.h"

namespace prelight {

namespace {

using Json = Technique::Json;

void writeChartTransferEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  if (!output.bake.chartTransfer) return;
  Json texels = chartsToJson(output.document, *output.bake.chartTransfer, output.scene, ranges);
  if (!texels.is_null()) entry["texels"] = std::move(texels);
}

class ChartTransferReader final : public TechniqueReader {
 public:
  explicit ChartTransferReader(const BakedInput& input) : input_(input) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& bake) override {
    if (const auto texels = entry.find("texels"))
      readCharts(input_.document, input_.root, *texels, input_.scene, ranges, bake.chartTransfer);
  }

  void finish(Bake& bake) override {
    if (bake.chartTransfer) sortMaps(*bake.chartTransfer);
  }

 private:
  const BakedInput& input_;
};

void summarizeChartTransfer(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (!bake.chartTransfer) return;
  const ChartTransfer& transfer = *bake.chartTransfer;
  std::size_t bytes = 0, texels = 0;
  int most = 0;
  for (const ChartTransfer::Map& map : transfer.maps) {
    bytes += bytesOf(map.coefficients);
    texels += static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
    most = std::max({most, map.width, map.height});
  }
  found.push_back({"texels",
                   fmt::format("{} of at most {} texels a side, {} texels in all; SH of order {}, {}",
                               counted(transfer.maps.size(), "light map"), most, texels, transfer.order,
                               channelsText(transfer.channels, transfer.bounces)),
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
          .accessors = {"texCoord", "coefficients"},
          .writeEntry = writeChartTransferEntry,
          .makeReader = makeTechniqueReader<ChartTransferReader>,
          .summarize = summarizeChartTransfer};
}

}  // namespace prelight
