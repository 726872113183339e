#include "techniques/ambient_occlusion/ambient_occlusion.h"

#include <algorithm>
#include <array>
#include <optional>

#include "base/spans.h"
#include "io/values/baked_ranges.h"
#include "io/values/value_reader.h"
#include "options/rows.h"
#include "techniques/ambient_occlusion/bent_normal_column.h"
#include "techniques/packed_values.h"
#include "techniques/receiver_cast.h"

namespace prelight {

namespace {

std::vector<PlannedPass> ambientOcclusionPasses(const PlanInput& input) {
  const bool asked = input.request.ao;
  return {{Pass::AmbientOcclusion, asked, asked ? "with bent normal, from the same cast" : "not asked for"}};
}

void addAmbientOcclusionToKey(const BakeRequest& request, StateHash& hash) { hash.value(request.ao); }

/// [vertex], unit. The mean of directions above the surface is above it too, whatever the fit overshoots.
/// `fitted`: relative to normals, [slot][3].
std::vector<glm::vec3> bentNormals(const std::vector<float>& fitted, const FitMesh& mesh,
                                   const CompiledScene& scene) {
  std::vector<glm::vec3> normals;
  normals.reserve(scene.vertexCount());
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    const std::size_t slot = mesh.slotOfVertex[v];
    const glm::dvec3 n = glm::normalize(glm::dvec3(scene.normals[v]));
    glm::dvec3 bent = n + glm::dvec3(fitted[3 * slot], fitted[3 * slot + 1], fitted[3 * slot + 2]);
    bent -= std::min(0.0, glm::dot(bent, n)) * n;
    const double length = glm::length(bent);
    // Where nothing is open there is no mean direction; the normal is as good as any.
    normals.push_back(length > 1e-5 ? glm::vec3(bent / length) : glm::vec3(n));
  }
  return normals;
}

class AmbientOcclusionProjector final : public Projector {
 public:
  explicit AmbientOcclusionProjector(const BakeContext& context) : context_(context) {}

  std::string_view stage() const override { return "fit"; }
  void addColumns(const HemisphereColumn& hemisphere, std::vector<Column*>& columns) override {
    columns.push_back(&bentNormals_.emplace(context_.scene, hemisphere));
  }

  void run(ReceiverCast* cast, Bake& bake, Progress& progress) override {
    bake.bentNormals =
        bentNormals(bentNormals_->solve(cast->front(), progress), context_.mesh, context_.scene);
    for (std::uint32_t v = 0; v < context_.scene.vertexCount(); ++v)
      bake.ao.push_back(finiteOr(cast->accessibility()[context_.mesh.slotOfVertex[v]], 1.0f));
  }

 private:
  const BakeContext& context_;
  std::optional<BentNormalColumn> bentNormals_;
};

std::unique_ptr<Projector> makeAmbientOcclusionProjector(const BakeContext& context) {
  if (!context.request.ao) return nullptr;
  return std::make_unique<AmbientOcclusionProjector>(context);
}

using Json = Technique::Json;

std::size_t ambientOcclusionBytes(const Bake& bake) { return bytesOf(bake.ao) + bytesOf(bake.bentNormals); }

void writeAmbientOcclusionEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  const Bake& bake = output.bake;
  if (!bake.ao.empty()) entry["ao"] = output.column("ao", bake.ao, ranges, 1, accessibilityForm);
  if (!bake.bentNormals.empty())
    entry["bentNormal"] = output.column("bent normals", numbersOf(bake.bentNormals), ranges, 3, {}, "VEC3");
}

class AmbientOcclusionReader final : public TechniqueReader {
 public:
  explicit AmbientOcclusionReader(const BakedInput& input)
      : input_(input), values_(input.document, input.root) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& bake) override {
    if (const auto ao = entry.find("ao"))
      placeVertices(values_.floats(*ao, "SCALAR", vertexCount(ranges)), ranges, 1, input_.scene, bake.ao);
    const auto bent = entry.find("bentNormal");
    if (!bent) return;
    std::vector<glm::vec3> normals = readVectors(values_, *bent, ranges);
    if (bent->value().is_object())  // bytes round away from the unit sphere
      for (glm::vec3& normal : normals)
        if (const float length = glm::length(normal); length > 0.0f) normal /= length;
    placeVertices(normals, ranges, 1, input_.scene, bake.bentNormals);
  }

 private:
  const BakedInput& input_;
  ValueReader values_;
};

void summarizeAmbientOcclusion(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (!bake.ao.empty()) found.push_back({"ao", "AO", bytesOf(bake.ao), true, true});
  if (!bake.bentNormals.empty())
    found.push_back({"bentNormal", "bent normals", bytesOf(bake.bentNormals), true, true});
}

void addAmbientOcclusionArrays(const Bake& bake, std::vector<BakedArray>& arrays) {
  if (bake.ao.empty()) return;
  arrays.push_back({"ao", "[vertex]", {bake.ao}});
  arrays.push_back({"bentNormal", "[vertex][3]", {numbersOf(bake.bentNormals)}});
}

constexpr auto ambientOcclusionOptions = std::to_array<Option<BakeRequest>>({
    options::BakeRow::flag<&BakeRequest::ao>(
        {.field = "BakeRequest::ao", .name = "ao", .help = "ambient occlusion and bent normal"}),
});

}  // namespace

Technique ambientOcclusionTechnique() {
  return {.name = "ambient_occlusion",
          .options = {.rows = ambientOcclusionOptions},
          .shading = &aoShading,
          .use = {.bounces = false},
          .plan = {.drawable = true, .passes = ambientOcclusionPasses, .addToKey = addAmbientOcclusionToKey},
          .makeProjector = makeAmbientOcclusionProjector,
          .file = {.members = {"ao", "bentNormal"},
                   .quantizable = true,
                   .accessors = {"ao", "bentNormal"},
                   .storedBytes = ambientOcclusionBytes,
                   .writeEntry = writeAmbientOcclusionEntry,
                   .makeReader = makeTechniqueReader<AmbientOcclusionReader>},
          .summarize = summarizeAmbientOcclusion,
          .addArrays = addAmbientOcclusionArrays,
          .exports = {.forms = {"occlusion", "vertex-occlusion"}, .formsKey = "ao", .asNumbers = true}};
}

}  // namespace prelight
