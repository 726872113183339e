#include "techniques/vector_occluders/vector_occluders_technique.h"

#include <fmt/format.h>

#include "techniques/summary_text.h"
#include "techniques/vector_occluders/occluder_file.h"

namespace prelight {

namespace {

using Json = Technique::Json;

void writeVectorOccludersEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  if (output.occluders != nullptr)
    entry["vo"] = occludersToJson(output.document, *output.occluders, ranges);
  else if (output.bake.occluders)
    entry["vo"] = occludersToJson(output.document, *output.bake.occluders, ranges);
}

void writeVectorOccludersRoot(const BakedOutput& output, Json& root) {
  if (output.occluders != nullptr)
    root["vo"] = occluderNames(*output.occluders);
  else if (output.bake.occluders)
    root["vo"] = occluderNames(*output.bake.occluders);
}

class VectorOccludersReader final : public TechniqueReader {
 public:
  explicit VectorOccludersReader(const BakedInput& input) : input_(input) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& /*bake*/) override {
    const auto vo = entry.find("vo");
    if (!vo) return;
    if (!rows_) rows_.emplace(input_.document, input_.root, input_.scene);
    rows_->read(*vo, ranges, input_.extension ? input_.extension->find("vo") : std::nullopt);
  }

  void finish(Bake& bake) override {
    if (rows_) bake.occluders = rows_->finish(input_.scene.vertexCount());
  }

 private:
  const BakedInput& input_;
  std::optional<OccluderRows> rows_;
};

void summarizeVectorOccluders(const Bake& bake, std::size_t vertices, std::vector<BakedSummary>& found) {
  if (!bake.occluders) return;
  const OccluderTransfer& transfer = *bake.occluders;
  const std::size_t bytes =
      bytesOf(transfer.offsets) + bytesOf(transfer.occluders) + bytesOf(transfer.vectors);
  const double records =
      vertices == 0 ? 0.0 : static_cast<double>(transfer.recordCount()) / static_cast<double>(vertices);
  Json stored = Json::array();
  std::string names;
  for (const OccluderVector vector : transfer.stored) {
    const std::string_view name = occluderVectorNames[static_cast<std::size_t>(vector)];
    stored.push_back(name);
    names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
  }
  found.push_back({"vo",
                   fmt::format("{}, {:.1f} records per vertex of {}",
                               counted(transfer.names.size(), "vector occluder"), records, names),
                   bytes,
                   true,
                   {{"occluders", transfer.names.size()},
                    {"recordsPerVertex", records},
                    {"stored", std::move(stored)},
                    {"bytes", bytes}}});
}

}  // namespace

Technique vectorOccludersTechnique() {
  return {.name = "vector_occluders",
          .members = {"vo"},
          .use = {.scattering = true},
          .accessors = {"offsets", "occluders", "vectors", "bytes"},
          .writeEntry = writeVectorOccludersEntry,
          .writeRoot = writeVectorOccludersRoot,
          .makeReader = makeTechniqueReader<VectorOccludersReader>,
          .summarize = summarizeVectorOccluders};
}

}  // namespace prelight
