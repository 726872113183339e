#include "techniques/radiosity/radiosity.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "base/spans.h"
#include "io/values/baked_ranges.h"
#include "io/values/value_reader.h"
#include "options/rows.h"
#include "radiosity/radiosity_bake.h"
#include "techniques/projector.h"

namespace prelight {

namespace {

std::vector<PlannedPass> radiosityPasses(const PlanInput& input) {
  return planRadiosity(input.scene, input.request);
}

void addRadiosityMemory(const PlanInput& input, Plan& plan) {
  if (!plan.runs(Pass::Radiosity)) return;
  constexpr std::uint64_t blockBytes = std::uint64_t{40} << 20;  // direct light's rays, and the kernels
  constexpr std::uint64_t bytesPerElement = 700;  // its place, points of direct light and light on its way
  const RadiosityScale scale = radiosityScale(input.scene, input.request);
  const std::uint64_t bytes = std::min(input.request.memory(), scale.bytes());
  plan.hostBytes += bytes + bytesPerElement * scale.elements;
  plan.deviceBytes += bytes / 3 + blockBytes;
}

void addRadiosityToKey(const BakeRequest& request, StateHash& hash) { hash.value(request.radiosity.wanted); }

class RadiosityProjector final : public Projector {
 public:
  explicit RadiosityProjector(const BakeContext& context) : context_(context) {
    if (context.plan.runs(Pass::Radiosity))
      radiosity_.emplace(context.scene, context.request, context.tracer);
  }

  std::string_view stage() const override { return {}; }

  /// Without light that the plan could solve for, all is dark.
  void run(ReceiverCast* /*cast*/, Bake& bake, Progress& progress) override {
    if (radiosity_)
      bake.irradiance = radiosity_->run(context_.mesh, progress, context_.report);
    else
      bake.irradiance.emplace(context_.scene.vertexCount(), glm::vec3(0.0f));
  }

 private:
  const BakeContext& context_;
  std::optional<RadiosityBake> radiosity_;
};

std::unique_ptr<Projector> makeRadiosityProjector(const BakeContext& context) {
  if (!context.request.radiosity) return nullptr;
  return std::make_unique<RadiosityProjector>(context);
}

using Json = Technique::Json;

std::size_t radiosityBytes(const Bake& bake) { return bake.irradiance ? bytesOf(*bake.irradiance) : 0; }

void writeRadiosityEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  if (output.bake.irradiance)
    entry["irradiance"] = appendVectors(output.document, *output.bake.irradiance, ranges);
}

class RadiosityReader final : public TechniqueReader {
 public:
  explicit RadiosityReader(const BakedInput& input) : input_(input), values_(input.document, input.root) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& bake) override {
    const auto json = entry.find("irradiance");
    if (!json) return;
    const std::vector<glm::vec3> vectors = readVectors(values_, *json, ranges);
    for (const glm::vec3& e : vectors)
      if (e.x < 0.0f || e.y < 0.0f || e.z < 0.0f)
        json->fail(fmt::format("irradiance of {}, {}, {}, expected none below 0", e.x, e.y, e.z), rebake);
    if (!bake.irradiance) bake.irradiance.emplace();
    placeVertices(vectors, ranges, 1, input_.scene, *bake.irradiance);
  }

 private:
  const BakedInput& input_;
  ValueReader values_;
};

void summarizeRadiosity(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (bake.irradiance)
    found.push_back({"irradiance", "irradiance of static lights", bytesOf(*bake.irradiance), true, true});
}

void addRadiosityArrays(const Bake& bake, std::vector<BakedArray>& arrays) {
  if (bake.irradiance) arrays.push_back({"irradiance", "[vertex][rgb]", {numbersOf(*bake.irradiance)}});
}

constexpr std::array<Choice, 4> solvers = {{{"jacobi"}, {"chebyshev"}, {"gauss-seidel"}, {"southwell"}}};

constexpr auto radiosityBakeOptions = std::to_array<Option<BakeRequest>>({
    options::BakeRow::flag<&BakeRequest::radiosity, &RadiosityRequest::wanted>(
        {.field = "BakeRequest::radiosity",
         .name = "radiosity",
         .help = "irradiance of the scene's own lights at every vertex, direct and through all diffuse "
                 "bounces"}),
    options::BakeRow::number<&BakeRequest::radiosity, &RadiosityRequest::patchSize>(
        options::edge("chosen by the scene"),
        {.field = "RadiosityRequest::patchSize",
         .name = "patch-size",
         .help = "radiosity: longest edge of an element, metres; larger triangles are cut (default: "
                 "thousands of elements)",
         .unit = "m"}),
    options::BakeRow::choice<&BakeRequest::radiosity, &RadiosityRequest::method>(
        solvers, {.field = "RadiosityRequest::method",
                  .name = "solver",
                  .help = "radiosity: method that solves for the light of all elements"}),
    options::BakeRow::number<&BakeRequest::radiosity, &RadiosityRequest::tolerance>(
        options::real(1e-7, 0.5),
        {.field = "RadiosityRequest::tolerance",
         .name = "tolerance",
         .help = "radiosity: stop solving at this residual, a share of the direct light's power"}),
    options::BakeRow::number<&BakeRequest::radiosity, &RadiosityRequest::skyRotation>(
        options::real(-1e4, 1e4), {.field = "RadiosityRequest::skyRotation",
                                   .name = "sky-rotation",
                                   .help = "turn of the sky, counter-clockwise seen from above",
                                   .unit = "rad",
                                   .commandLine = "rotate-env"}),
    options::BakeRow::own(
        {.field = "RadiosityRequest::environment",
         .name = "sky",
         .help = "sky for radiosity and light maps; ignored with a warning for transfer, which does not "
                 "depend on it",
         .commandLine = "env"}),
});

}  // namespace

Technique radiosityTechnique() {
  return {.name = "radiosity",
          .options = {.rows = radiosityBakeOptions, .behind = "vo-min-form-factor"},
          .shading = &radiosityShading,
          .use = {.lights = true},
          .plan = {.staticLight = true,
                   .passes = radiosityPasses,
                   .addMemory = addRadiosityMemory,
                   .addToKey = addRadiosityToKey},
          .makeProjector = makeRadiosityProjector,
          .file = {.members = {"irradiance"},
                   .accessors = {"irradiance"},
                   .storedBytes = radiosityBytes,
                   .writeEntry = writeRadiosityEntry,
                   .makeReader = makeTechniqueReader<RadiosityReader>},
          .summarize = summarizeRadiosity,
          .addArrays = addRadiosityArrays,
          .exports = {.forms = {"vertex-light"}, .asNumbers = true}};
}

}  // namespace prelight
