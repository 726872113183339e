#include "techniques/occlusion_cones/occlusion_cones.h"

#include <array>

#include "base/parallel.h"
#include "io/values/baked_ranges.h"
#include "io/values/value_reader.h"
#include "options/rows.h"
#include "prelight/error.h"
#include "techniques/occlusion_cones/cone_aperture.h"
#include "techniques/projector.h"

namespace prelight {

namespace {

std::vector<PlannedPass> occlusionConesPasses(const PlanInput& input) {
  if (!input.request.cones) return {};
  return {{Pass::OcclusionCones, true, "from ambient occlusion and bent normal, without further rays"}};
}

void addOcclusionConesToKey(const BakeRequest& request, StateHash& hash) {
  if (request.cones) hash.value(request.cones);
}

constexpr std::size_t grain = 4096;  // vertices that a thread takes at once

class OcclusionConesProjector final : public Projector {
 public:
  explicit OcclusionConesProjector(const BakeContext& context) : context_(context) {
    if (!context.request.ao)
      throw UsageError("occlusion cones", "they are computed from ambient occlusion, which is not asked for",
                       "ask for ambient occlusion, too");
  }

  std::string_view stage() const override { return "cones"; }

  void run(ReceiverCast* /*cast*/, Bake& bake, Progress& /*progress*/) override {
    bake.apertures.resize(bake.ao.size());
    parallelRanges(bake.ao.size(), grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const glm::dvec3 normal = glm::normalize(glm::dvec3(context_.scene.normals[v]));
        const double cosine = glm::dot(normal, glm::dvec3(bake.bentNormals[v]));
        bake.apertures[v] = static_cast<float>(coneAperture(bake.ao[v], cosine));
      }
    });
  }

 private:
  const BakeContext& context_;
};

/// Throws UsageError without ambient occlusion, which they are made of.
std::unique_ptr<Projector> makeOcclusionConesProjector(const BakeContext& context) {
  if (!context.request.cones) return nullptr;
  return std::make_unique<OcclusionConesProjector>(context);
}

using Json = Technique::Json;

std::size_t occlusionConesBytes(const Bake& bake) { return bytesOf(bake.apertures); }

void writeOcclusionConesEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  if (!output.bake.apertures.empty())
    entry["aperture"] = output.column("apertures", output.bake.apertures, ranges, 1, {.isSigned = false});
}

class OcclusionConesReader final : public TechniqueReader {
 public:
  explicit OcclusionConesReader(const BakedInput& input)
      : input_(input), values_(input.document, input.root) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& bake) override {
    if (const auto aperture = entry.find("aperture"))
      placeVertices(values_.floats(*aperture, "SCALAR", vertexCount(ranges)), ranges, 1, input_.scene,
                    bake.apertures);
  }

 private:
  const BakedInput& input_;
  ValueReader values_;
};

void summarizeOcclusionCones(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (!bake.apertures.empty())
    found.push_back({"aperture", "occlusion cones", bytesOf(bake.apertures), true, true});
}

void addOcclusionConesArrays(const Bake& bake, std::vector<BakedArray>& arrays) {
  if (!bake.apertures.empty()) arrays.push_back({"aperture", "[vertex]", {bake.apertures}});
}

constexpr auto occlusionConesOptions = std::to_array<Option<BakeRequest>>({
    options::BakeRow::flagWith<&BakeRequest::cones, &BakeRequest::ao>(
        {.field = "BakeRequest::cones",
         .name = "cones",
         .help = "ambient occlusion and bent normal with the angle of the open cone about the bent normal, "
                 "which shadows sky, lights and reflections"}),
});

}  // namespace

Technique occlusionConesTechnique() {
  return {.name = "occlusion_cones",
          .options = {.rows = occlusionConesOptions, .behind = "ao"},
          .shading = &conesShading,
          .use = {.bounces = false},
          .plan = {.drawable = true, .passes = occlusionConesPasses, .addToKey = addOcclusionConesToKey},
          .makeProjector = makeOcclusionConesProjector,
          .file = {.members = {"aperture"},
                   .quantizable = true,
                   .accessors = {"aperture"},
                   .storedBytes = occlusionConesBytes,
                   .writeEntry = writeOcclusionConesEntry,
                   .makeReader = makeTechniqueReader<OcclusionConesReader>},
          .summarize = summarizeOcclusionCones,
          .addArrays = addOcclusionConesArrays};
}

}  // namespace prelight
