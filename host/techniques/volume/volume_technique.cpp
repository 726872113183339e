#include "techniques/volume/volume_technique.h"

#include <fmt/format.h>

#include <algorithm>

#include "techniques/compressed_rows.h"
#include "techniques/summary_text.h"
#include "techniques/volume/volume_file.h"

namespace prelight {

namespace {

using Json = Technique::Json;

void writeVolumeRoot(const BakedOutput& output, Json& root) {
  if (output.bake.volume)
    root["volume"] = volumeToJson(output.document, *output.bake.volume, output.bake.compressedParts);
}

class VolumeReader final : public TechniqueReader {
 public:
  explicit VolumeReader(const BakedInput& input) : input_(input) {}

  void finish(Bake& bake) override {
    if (!input_.extension) return;
    if (const auto volume = input_.extension->find("volume"))
      bake.volume = readVolume(input_.document, input_.root, *volume, bake.compressedParts);
  }

 private:
  const BakedInput& input_;
};

void summarizeVolume(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (!bake.volume) return;
  const VolumeTransfer& transfer = *bake.volume;
  const VolumeGrid& grid = transfer.grid;
  const CompressedParts& parts = bake.compressedParts;
  const auto stored = [](const std::optional<CompressedTransfer>& compressed,
                         const std::vector<float>& floats) {
    return compressed ? compressed->byteCount() : bytesOf(floats);
  };
  const std::size_t bytes = stored(parts.volume, transfer.coefficients) +
                            stored(parts.volumeDirect, transfer.direct) + bytesOf(transfer.air) +
                            stored(parts.volumeSent, transfer.sent) + bytesOf(transfer.lights);
  const auto inside = static_cast<std::size_t>(
      std::count(transfer.air.begin(), transfer.air.end(), static_cast<std::uint8_t>(0)));
  found.push_back(
      {"volume",
       fmt::format(
           "volume of {} x {} x {} cells, {:.3g} wide, {} of them inside objects; SH of order {}, {}{}{}",
           grid.size.x, grid.size.y, grid.size.z, grid.cell(), inside, transfer.order,
           channelsText(transfer.channels, transfer.bounces),
           transfer.groups() == 0 ? "" : ", with " + counted(transfer.groups(), "light group"),
           compressionText(parts.volume)),
       bytes,
       false,
       {{"size", {grid.size.x, grid.size.y, grid.size.z}},
        {"min", {grid.min.x, grid.min.y, grid.min.z}},
        {"max", {grid.max.x, grid.max.y, grid.max.z}},
        {"insideCells", inside},
        {"order", transfer.order},
        {"channels", transfer.channels},
        {"bounces", transfer.bounces},
        {"lightGroups", transfer.groups()},
        {"bytes", bytes}}});
}

}  // namespace

Technique volumeTechnique() {
  return {.name = "volume",
          .accessors = compressedAccessors({"coefficients", "direct", "air", "sent", "lights"}),
          .writeRoot = writeVolumeRoot,
          .makeReader = makeTechniqueReader<VolumeReader>,
          .summarize = summarizeVolume};
}

}  // namespace prelight
