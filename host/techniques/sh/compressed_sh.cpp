#include <fmt/format.h>

#include "techniques/compressed_rows.h"
#include "techniques/sh/sh.h"

namespace prelight {

namespace {

using Json = Technique::Json;

void writeCompressedEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  if (output.bake.compressedSh)
    entry["shCompressed"] = rowsToJson(output.document, *output.bake.compressedSh, rowsOf(ranges));
}

void writeCompressedRoot(const BakedOutput& output, Json& root) {
  if (output.bake.compressedSh)
    root["shCompressed"] = sharedToJson(output.document, *output.bake.compressedSh);
}

class CompressedReader final : public TechniqueReader {
 public:
  explicit CompressedReader(const BakedInput& input) : input_(input), values_(input.document, input.root) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& bake) override {
    const auto json = entry.find("shCompressed");
    if (!json) return;
    if (!bake.compressedSh) {
      bake.compressedSh = readShared(values_, sharedAt(input_.extension, "shCompressed", *json));
      bake.compressedSh->vertexCount = input_.scene.vertexCount();
    }
    readRows(values_, *json, rowsOf(ranges), *bake.compressedSh);
  }

 private:
  const BakedInput& input_;
  ValueReader values_;
};

void summarizeCompressed(const Bake& bake, std::size_t vertices, std::vector<BakedSummary>& found) {
  if (!bake.compressedSh) return;
  const CompressedTransfer& transfer = *bake.compressedSh;
  const std::string method = methodOf(transfer);
  const std::size_t bytes = transfer.byteCount();
  found.push_back({"shCompressed",
                   fmt::format("SH of order {} as {}, {}", transfer.order, method,
                               channelsText(transfer.channels, transfer.bounces)),
                   bytes,
                   true,
                   {{"method", method},
                    {"order", transfer.order},
                    {"channels", transfer.channels},
                    {"bounces", transfer.bounces},
                    {"bytes", bytes},
                    {"bytesPerVertex",
                     vertices == 0 ? 0.0 : static_cast<double>(bytes) / static_cast<double>(vertices)}}});
}

}  // namespace

Technique compressedShTechnique() {
  return {.name = "compressed_sh",
          .file = {.members = {"shCompressed"},
                   .accessors = compressedAccessors(),
                   .writeEntry = writeCompressedEntry,
                   .writeRoot = writeCompressedRoot,
                   .makeReader = makeTechniqueReader<CompressedReader>},
          .summarize = summarizeCompressed,
          .exports = {
              .asNumbers = true, .relitAlone = true, .copyRelit = copyPart<&TechniqueParts::compressedSh>}};
}

}  // namespace prelight
