#include "techniques/vector_occluders/vector_occluders.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "occluders/occluder_cut.h"
#include "occluders/occluder_tree.h"
#include "occluders/occluder_vectors.h"
#include "options/rows.h"
#include "scene/deform.h"
#include "techniques/receiver_cast.h"
#include "techniques/vector_occluders/occluder_column.h"
#include "techniques/vector_occluders/occluder_file.h"
#include "techniques/vector_occluders/occluder_transfer.h"

namespace prelight {

namespace {

constexpr std::uint64_t seenBytes = 72;  // what a vertex keeps of an occluder until its record is made
constexpr std::uint64_t wayBytes = 56;   // the same of what is mirrored or comes through it

PlannedPass planOccluders(const BakeRequest& request) {
  if (!request.occluders) return {Pass::VectorOccluders, false, "not asked for"};
  return {Pass::VectorOccluders, true,
          "position, occlusion, diffuse normal and diffuse colour, from the rays of the same cast"};
}

/// Vectors that only some scenes need.
PlannedPass planVectors(const BakeRequest& request, Pass name, bool needed, const std::string& reason,
                        const std::string& lack) {
  if (!request.occluders) return {name, false, "vector occluders are not asked for"};
  return {name, needed, needed ? reason : lack};
}

std::vector<PlannedPass> vectorOccludersPasses(const PlanInput& input) {
  const BakeRequest& request = input.request;
  const double reach = freeReach(input.scene);
  const std::string free =
      std::isinf(reach) ? "nothing is in the way, because light comes from outside"
                        : fmt::format("nothing is in the way for {:.3g} m, because lights lie inside", reach);
  return {planOccluders(request),
          planVectors(request, Pass::CausticVectors, hasGlass(input.scene),
                      "rays that meet glass are refracted until " + free,
                      "no material lets light through by refraction"),
          planVectors(request, Pass::SpecularVectors, hasShine(input.scene),
                      "rays are mirrored by shiny surfaces, and count where " + free,
                      "no material mirrors light or is glossy")};
}

/// While they are aggregated: objects that a vertex sees, or parts of them (measured, 3 to 8 and 30 to 60).
void addVectorOccludersMemory(const PlanInput& input, Plan& plan) {
  if (!input.request.occluders) return;
  const std::uint64_t seen = input.request.occluders.kind == OccluderKind::Auto ? 48 : 8;
  const bool ways = hasGlass(input.scene) || hasShine(input.scene);
  plan.hostBytes += std::uint64_t{input.scene.vertexCount()} * seen * (seenBytes + (ways ? wayBytes : 0));
}

const char* closestHits(const BakeRequest& request) {
  return request.occluders ? "closest hits, because occluders are told apart by what was hit" : nullptr;
}

const char* specularLight(const BakeRequest& request) {
  return request.occluders ? "only vector occluders carry" : nullptr;
}

void addVectorOccludersToKey(const BakeRequest& request, StateHash& hash) {
  hash.value(request.occluders.wanted).value(request.occluders.kind);
  hash.value(request.occluders.records).value(request.occluders.leastFormFactor);
}

constexpr std::size_t occluderLeaves =
    128;  // of all nodes; twice as many gain 0.002 to 0.007 of shadow error

class VectorOccludersProjector final : public Projector {
 public:
  explicit VectorOccludersProjector(const BakeContext& context) : context_(context), column_(groups_) {
    const OccluderKind kind = context.request.occluders.kind;
    if (kind == OccluderKind::Auto) tree_ = makeOccluderTree(context.scene, occluderLeaves);
    groups_ = tree_ ? leavesOf(*tree_) : makeOccluderGroups(context.scene, kind);
  }

  std::string_view stage() const override { return "occluders"; }
  void addColumns(const HemisphereColumn& /*hemisphere*/, std::vector<Column*>& columns) override {
    columns.push_back(&column_);
  }

  void run(ReceiverCast* cast, Bake& bake, Progress& /*progress*/) override {
    OccluderTransfer transfer =
        makeOccluderTransfer(context_.scene, context_.mesh, column_.meansOn(cast->front()),
                             cast->accessibility(), groups_, neededVectors(context_.scene));
    if (tree_) transfer = cutThroughTree(std::move(transfer));
    const DroppedOccluders dropped = dropOccluders(transfer, context_.request.occluders.leastFormFactor);
    addNote(transfer, dropped);
    bake.occluders = std::move(transfer);
  }

 private:
  /// Clusters of every node's vertices, joined again for each vertex as its records allow.
  OccluderTransfer cutThroughTree(OccluderTransfer leaves) const {
    const std::vector<std::uint32_t> nodes = leafNodes(*tree_);
    for (std::uint32_t& occluder : leaves.occluders) occluder = nodes[occluder];
    return cutOccluders(leaves, *tree_, surfaceOfVertices(context_.scene),
                        context_.request.occluders.records);
  }

  void addNote(const OccluderTransfer& transfer, const DroppedOccluders& dropped) {
    std::string text =
        fmt::format("vector occluders: {} of them, {:.1f} records per vertex, {} vectors per record",
                    transfer.names.size(), double(transfer.recordCount()) / context_.scene.vertexCount(),
                    transfer.stored.size());
    if (context_.request.occluders.leastFormFactor > 0.0)
      text += fmt::format("; the dropped ones hide {:.2g} of the sky on average, {:.2g} at most",
                          dropped.mean, dropped.most);
    context_.report.notes.push_back(text);
  }

  const BakeContext& context_;
  std::optional<OccluderTree> tree_;  ///< whose leaves they are
  OccluderGroups groups_;
  OccluderColumn column_;
};

std::unique_ptr<Projector> makeVectorOccludersProjector(const BakeContext& context) {
  if (!context.request.occluders) return nullptr;
  return std::make_unique<VectorOccludersProjector>(context);
}

using Json = Technique::Json;

void writeVectorOccludersEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  if (output.forms != nullptr && output.forms->occluders)
    entry["vo"] = occludersToJson(output.document, *output.forms->occluders, ranges);
  else if (output.bake.occluders)
    entry["vo"] = occludersToJson(output.document, *output.bake.occluders, ranges);
}

void writeVectorOccludersRoot(const BakedOutput& output, Json& root) {
  if (output.forms != nullptr && output.forms->occluders)
    root["vo"] = occluderNames(*output.forms->occluders);
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

constexpr std::array<Choice, 4> occluderKinds = {{{"node"}, {"mesh"}, {"material"}, {"auto"}}};

constexpr auto vectorOccludersOptions = std::to_array<Option<BakeRequest>>({
    options::BakeRow::flag<&BakeRequest::occluders, &OccluderRequest::wanted>(
        {.field = "BakeRequest::occluders",
         .name = "vo",
         .help = "vector occluders: what every vertex sees of each object, for shadows and colour bleeding"}),
    options::BakeRow::choice<&BakeRequest::occluders, &OccluderRequest::kind>(
        occluderKinds,
        {.field = "OccluderRequest::kind",
         .name = "vo-kind",
         .help = "what forms one occluder: node (default), mesh, material, or auto:N, parts of nodes, chosen "
                 "for every vertex so that there are N records per vertex on average",
         .commandLine = "occluders",
         .example = "auto:8"}),
    options::BakeRow::number<&BakeRequest::occluders, &OccluderRequest::records>(
        options::real(1, 256),
        {.field = "OccluderRequest::records",
         .name = "vo-records",
         .help = "average records per vertex if parts of nodes are chosen as occluders",
         .commandLine = "occluders auto:N"}),
    options::BakeRow::number<&BakeRequest::occluders, &OccluderRequest::leastFormFactor>(
        options::real(0, 1), {.field = "OccluderRequest::leastFormFactor",
                              .name = "vo-min-form-factor",
                              .help = "drop occluders of a vertex that hide less of its sky than this"}),
});

}  // namespace

Technique vectorOccludersTechnique() {
  return {.name = "vector_occluders",
          .options = {.rows = vectorOccludersOptions},
          .shading = &occluderShading,
          .use = {.scattering = true},
          .plan = {.passes = vectorOccludersPasses,
                   .addMemory = addVectorOccludersMemory,
                   .closestHits = closestHits,
                   .specularLight = specularLight,
                   .addToKey = addVectorOccludersToKey},
          .makeProjector = makeVectorOccludersProjector,
          .file = {.members = {"vo"},
                   .accessors = {"offsets", "occluders", "vectors", "bytes"},
                   .writeEntry = writeVectorOccludersEntry,
                   .writeRoot = writeVectorOccludersRoot,
                   .makeReader = makeTechniqueReader<VectorOccludersReader>},
          .summarize = summarizeVectorOccluders,
          .relighting = &vectorOccludersRelighting,
          .exports = {.asNumbers = true}};
}

}  // namespace prelight
