#include "techniques/glossy/glossy.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "compress/compress.h"
#include "io/values/baked_ranges.h"
#include "io/values/value_reader.h"
#include "options/rows.h"
#include "techniques/compressed_rows.h"
#include "techniques/glossy/glossy_transfer.h"
#include "techniques/packed_values.h"
#include "techniques/receiver_cast.h"

namespace prelight {

namespace {

/// Entries of a matrix.
template <typename T>
T entriesOf(T order) {
  return order * order * order * order;
}

std::vector<PlannedPass> glossyPasses(const PlanInput& input) {
  const int order = input.request.glossy.order;
  if (order == 0) return {{Pass::GlossyTransfer, false, "not asked for"}};
  return {{Pass::GlossyTransfer, true,
           fmt::format("order {}, {} entries per matrix, {}; from SH transfer of order {}", order,
                       entriesOf(order), plannedChannels(input.colored()), 2 * order - 1)}};
}

void addGlossyMemory(const PlanInput& input, Plan& plan) {
  plan.hostBytes += input.scene.vertexCount() *
                    entriesOf(static_cast<std::uint64_t>(input.request.glossy.order)) * 4 *
                    (input.bounces ? 6 : 2);
}

void addGlossyToKey(const BakeRequest& request, StateHash& hash) { hash.value(request.glossy.order); }

class GlossyProjector final : public Projector {
 public:
  explicit GlossyProjector(const BakeContext& context) : context_(context) {}

  std::string_view stage() const override { return "glossy"; }
  bool readsReflected() const override { return true; }
  void addColumns(const HemisphereColumn& /*hemisphere*/, std::vector<Column*>& columns) override {
    columns.push_back(&receivers_);
  }

  void run(ReceiverCast* cast, Bake& bake, Progress& progress) override {
    const SlotTransfer& transfer = cast->transfer(progress);
    bake.glossy =
        pack(transfer, makeGlossyMatrices(context_.scene, context_.mesh,
                                          {cast->caster(), cast->transport(), cast->scene().front(),
                                           cast->hemisphere().baselineOf(Side::Front), receivers_},
                                          cast->fitted(), transfer, context_.request.glossy.order, progress));
  }

 private:
  /// `matrices` are [slot][channel][i][j].
  GlossyTransfer pack(const SlotTransfer& transfer, const std::vector<float>& matrices) const {
    const int order = context_.request.glossy.order;
    const auto width = static_cast<std::size_t>(transfer.channels() * order * order * order * order);
    GlossyTransfer glossy{order, transfer.channels(), transfer.bounces, {}};
    glossy.matrices.reserve(context_.scene.vertexCount() * width);
    for (std::uint32_t v = 0; v < context_.scene.vertexCount(); ++v)
      for (std::size_t i = 0; i < width; ++i)
        glossy.matrices.push_back(finiteOr(matrices[context_.mesh.slotOfVertex[v] * width + i], 0.0f));
    return glossy;
  }

  const BakeContext& context_;
  StoredReceivers receivers_;
};

std::unique_ptr<Projector> makeGlossyProjector(const BakeContext& context) {
  if (context.request.glossy.order == 0) return nullptr;
  return std::make_unique<GlossyProjector>(context);
}

using Json = Technique::Json;

std::size_t glossyBytes(const Bake& bake) { return bake.glossy ? bytesOf(bake.glossy->matrices) : 0; }

std::size_t entriesOf(const GlossyTransfer& glossy) {
  const auto n = static_cast<std::size_t>(glossy.order * glossy.order);
  return n * n * static_cast<std::size_t>(glossy.channels);
}

constexpr double matrixError = 0.02;  // RMS, relative; docs/notes/compression.md has errors of pictures
constexpr int mostComponents = 192;
constexpr std::size_t mostEntries = 2048;  // of a matrix; the covariance of longer ones takes minutes
constexpr int mostBands = BakeRequest::maxGlossyOrder * BakeRequest::maxGlossyOrder;  // of its row

/// Returns the principal components of matrices; nothing if that many do not keep the error.
std::optional<BoundedCompression> componentsOf(GlossyTransfer& glossy, const BakeToCompress& from) {
  HarmonicTransfer rows{glossy.order * glossy.order, glossy.channels, glossy.bounces, {}};
  std::swap(rows.coefficients, glossy.matrices);  // for as long as this takes, because they are large
  try {
    auto found = compressToError(rows, matrixError, mostComponents, from.surface, from.progress);
    std::swap(rows.coefficients, glossy.matrices);
    return found;
  } catch (...) {
    std::swap(rows.coefficients, glossy.matrices);
    throw;
  }
}

/// Adds the principal components of matrices if they take less than a byte per entry.
void addComponents(const BakeToCompress& from, StoredForms& forms, std::vector<std::string>& notes) {
  if (!from.bake.glossy) return;
  GlossyTransfer& glossy = *from.bake.glossy;
  const std::size_t entries = entriesOf(glossy);
  if (entries > mostEntries) return;
  // The writer of the file says where a number is not finite.
  if (!std::ranges::all_of(glossy.matrices, [](float entry) { return std::isfinite(entry); })) return;
  std::optional<BoundedCompression> found = componentsOf(glossy, from);
  if (!found || found->transfer.byteCount() >= glossy.matrices.size()) return;
  forms.matrices = std::move(found->transfer);
  notes.push_back(fmt::format(
      "compression of glossy matrices: {} principal components, {:.1f} bytes per vertex instead "
      "of {}, error {:.2g} rms",
      forms.matrices->components, double(forms.matrices->byteCount()) / forms.matrices->vertexCount,
      entries * sizeof(float), found->error));
}

/// Returns whether matrices are stored by their principal components.
bool hasComponents(const BakedOutput& output) {
  return output.bake.glossy && output.forms != nullptr && output.forms->matrices;
}

void writeGlossyEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  if (!output.bake.glossy) return;
  const GlossyTransfer& glossy = *output.bake.glossy;
  Json json = {{"order", glossy.order}, {"channels", glossy.channels}, {"bounces", glossy.bounces}};
  if (hasComponents(output))
    json["compressed"] = rowsToJson(output.document, *output.forms->matrices, rowsOf(ranges));
  else
    json["matrices"] =
        output.column("glossy matrices", glossy.matrices, ranges, entriesOf(glossy),
                      {.square = true, .group = static_cast<std::size_t>(glossy.order * glossy.order)});
  entry["glossy"] = std::move(json);
}

void writeGlossyRoot(const BakedOutput& output, Json& root) {
  if (hasComponents(output))
    root["glossyCompressed"] = sharedToJson(output.document, *output.forms->matrices);
}

class GlossyReader final : public TechniqueReader {
 public:
  explicit GlossyReader(const BakedInput& input) : input_(input), values_(input.document, input.root) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& bake) override {
    const auto json = entry.find("glossy");
    if (!json) return;
    GlossyTransfer header;
    header.order = readNumber(json->at("order"), 1, maxStoredOrder);
    header.channels = readChannels(*json);
    header.bounces = readBounces(*json);
    if (!bake.glossy) bake.glossy = header;
    expectSame(*json,
               header.order == bake.glossy->order && header.channels == bake.glossy->channels &&
                   header.bounces == bake.glossy->bounces,
               "order, channels and bounces");
    const auto rows = json->find("compressed");
    if (!compressed_ && rows && !bake.glossy->matrices.empty())
      rows->fail("other primitives have matrices", rebake);
    if (compressed_ && !rows) json->fail("expected compressed matrices as on the other primitives", rebake);
    if (rows) {
      readCompressed(*rows, ranges, header);
      return;
    }
    const std::size_t width = entriesOf(header);
    placeVertices(values_.floats(json->at("matrices"), "SCALAR", vertexCount(ranges) * width), ranges, width,
                  input_.scene, bake.glossy->matrices);
  }

  void finish(Bake& bake) override {
    if (compressed_) bake.glossy->matrices = decompress(*compressed_).coefficients;
  }

 private:
  /// Reads rows of principal components; the root has what they share.
  void readCompressed(const JsonCursor& json, const PrimitiveRanges& ranges, const GlossyTransfer& header) {
    if (!compressed_) {
      const JsonCursor shared = sharedAt(input_.extension, "glossyCompressed", json);
      if (shared.at("method").asString() != "pca")
        shared.at("method").fail("expected pca, got " + shared.at("method").asString(), rebake);
      if (entriesOf(header) > mostEntries)
        json.fail(fmt::format("{} entries of a matrix, expected at most {}", entriesOf(header), mostEntries),
                  rebake);
      compressed_ = readShared(values_, shared, 3, mostBands);
      if (compressed_->order != header.order * header.order || compressed_->channels != header.channels)
        shared.fail(fmt::format("order {} and {} do not fit matrices of order {} and {}", compressed_->order,
                                channelsText(compressed_->channels, 0), header.order,
                                channelsText(header.channels, 0)),
                    rebake);
      compressed_->vertexCount = input_.scene.vertexCount();
    }
    readRows(values_, json, rowsOf(ranges), *compressed_);
  }

  const BakedInput& input_;
  ValueReader values_;
  std::optional<CompressedTransfer> compressed_;
};

void summarizeGlossy(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (!bake.glossy) return;
  const GlossyTransfer& transfer = *bake.glossy;
  const std::size_t bytes = bytesOf(transfer.matrices);
  found.push_back({"glossy",
                   fmt::format("glossy matrices of order {}, {}", transfer.order,
                               channelsText(transfer.channels, transfer.bounces)),
                   bytes,
                   true,
                   {{"order", transfer.order},
                    {"channels", transfer.channels},
                    {"bounces", transfer.bounces},
                    {"bytes", bytes}}});
}

void addGlossyArrays(const Bake& bake, std::vector<BakedArray>& arrays) {
  if (bake.glossy)
    arrays.push_back(
        {"glossy",
         fmt::format("[vertex][channel {}][i][j] of order {}", bake.glossy->channels, bake.glossy->order),
         {bake.glossy->matrices}});
}

constexpr auto glossyOptions = std::to_array<Option<BakeRequest>>({
    options::BakeRow::number<&BakeRequest::glossy, &GlossyRequest::order>(
        options::whole(1, BakeRequest::maxGlossyOrder, "none"),
        {.field = "GlossyRequest::order",
         .name = "glossy",
         .help = "transfer matrices of glossy surfaces, of this order (with its fourth power of entries)"}),
});

}  // namespace

Technique glossyTechnique() {
  return {.name = "glossy",
          .options = {.rows = glossyOptions, .behind = "haar-error"},
          .shading = &glossyShading,
          .plan = {.passes = glossyPasses, .addMemory = addGlossyMemory, .addToKey = addGlossyToKey},
          .makeProjector = makeGlossyProjector,
          .file = {.members = {"glossy"},
                   .quantizable = true,
                   .accessors = compressedAccessors({"matrices"}),
                   .storedBytes = glossyBytes,
                   .addForms = addComponents,
                   .writeEntry = writeGlossyEntry,
                   .writeRoot = writeGlossyRoot,
                   .makeReader = makeTechniqueReader<GlossyReader>},
          .summarize = summarizeGlossy,
          .addArrays = addGlossyArrays};
}

}  // namespace prelight
