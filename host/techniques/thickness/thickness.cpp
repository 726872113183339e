#include "techniques/thickness/thickness.h"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "cast/fitted_column.h"
#include "cast/side_sums.h"
#include "device/kernel.h"
#include "io/values/baked_ranges.h"
#include "io/values/value_reader.h"
#include "options/rows.h"
#include "techniques/packed_values.h"
#include "techniques/receiver_cast.h"

namespace prelight {

namespace {

constexpr Pass thicknessPass{"thickness"};

std::vector<PlannedPass> thicknessPasses(const PlanInput& input) {
  if (!input.request.thickness) return {};
  return {{thicknessPass, true, "by inward rays from the receivers of the same cast"}};
}

/// Adds the fit's sums, its solution, and the stored numbers.
void addThicknessMemory(const PlanInput& input, Plan& plan) {
  if (input.request.thickness) plan.hostBytes += std::uint64_t{input.scene.vertexCount()} * (8 + 4 + 4);
}

void addThicknessToKey(const BakeRequest& request, StateHash& hash) {
  if (request.thickness) hash.text("thickness");
}

/// Mean length of receivers' inward rays until they leave the surface, m. It casts rays of its own, from
/// fronts alone.
class ThicknessColumn final : public FittedColumn {
 public:
  ThicknessColumn() : FittedColumn(1, 1) {}

  /// Returns the fitted thickness, [slot], m; noise may take it below 0.
  std::vector<float> solve(const SideSums& side, const Progress& progress) const {
    return fitOn(side).solve(side.fit().equations(defaultSmoothing), {.progress = &progress});
  }

  ColumnNeeds needs() const override { return {.ownRays = true}; }
  bool castFrom(Side side) const override { return side == Side::Front; }

  void finish(const CastBlock& block, ColumnRows& rows) override {
    const auto& [parameters, receivers, rays, hits] = block.buffers;
    const std::size_t count = std::size_t{block.receivers} * raysPerReceiver_;
    turn_.launch({count, block.lane}, parameters, receivers, rays, inward_);
    block.tracer.traceClosest(inward_, hits_, count, 0, block.lane);
    measure_.launch({block.receivers, block.lane}, parameters, inward_, hits_, geometricNormals_,
                    valuesOf(block));
    rays_ += count;
    FittedColumn::finish(block, rows);
  }

  std::uint64_t rays() const override { return rays_; }
  void save(StateWriter& state) const override { state.value(rays_); }
  void load(StateReader& state) override { state.value(rays_); }
  void loadBlock(StateReader& state, const CastTask& task, std::uint32_t receivers,
                 const ColumnRows& rows) override {
    FittedColumn::loadBlock(state, task, receivers, rows);
    rays_ += std::uint64_t{receivers} * raysPerReceiver_;
  }

 private:
  void allocate(const CastShape& shape) override {
    FittedColumn::allocate(shape);
    DeviceContext& device = shape.tracer.context();
    raysPerReceiver_ = shape.raysPerReceiver;
    const std::size_t rays = std::size_t{shape.blockSize} * raysPerReceiver_;
    inward_ = Buffer<device::Ray>(device, rays);
    hits_ = Buffer<device::Hit>(device, rays);
    geometricNormals_ = shape.geometricNormals();
    turn_ = {device, "techniques/thickness/thickness_kernels.cl", {}, "turnInward"};
    measure_ = {device, "techniques/thickness/thickness_kernels.cl", {}, "measureThickness"};
  }

  using Parameters = Buffer<device::CastParameters>;
  Buffer<device::Ray> inward_;
  Buffer<device::Hit> hits_;
  Buffer<float> geometricNormals_;
  Kernel<Parameters, Buffer<device::Receiver>, Buffer<device::Ray>, Buffer<device::Ray>> turn_;
  Kernel<Parameters, Buffer<device::Ray>, Buffer<device::Hit>, Buffer<float>, Buffer<float>> measure_;
  std::uint32_t raysPerReceiver_ = 0;
  std::uint64_t rays_ = 0;  ///< cast so far, those of earlier runs included
};

class ThicknessProjector final : public Projector {
 public:
  explicit ThicknessProjector(const BakeContext& context) : context_(context) {}

  std::string_view stage() const override { return "thickness"; }

  void addColumns(const HemisphereColumn& /*hemisphere*/, std::vector<Column*>& columns) override {
    columns.push_back(&column_);
  }

  void run(ReceiverCast* cast, Bake& bake, Progress& progress) override {
    const std::vector<float> fitted = column_.solve(cast->front(), progress);
    for (std::uint32_t v = 0; v < context_.scene.vertexCount(); ++v)
      bake.thickness.push_back(std::max(0.0f, finiteOr(fitted[context_.mesh.slotOfVertex[v]], 0.0f)));
  }

 private:
  const BakeContext& context_;
  ThicknessColumn column_;
};

std::unique_ptr<Projector> makeThicknessProjector(const BakeContext& context) {
  if (!context.request.thickness) return nullptr;
  return std::make_unique<ThicknessProjector>(context);
}

std::size_t thicknessBytes(const Bake& bake) { return bytesOf(bake.thickness); }

void writeThicknessEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Technique::Json& entry) {
  const std::vector<float>& thickness = output.bake.thickness;
  if (thickness.empty()) return;
  float greatest = 0.0f;
  for (const PrimitiveRange& range : ranges)
    for (const float length : std::span(thickness).subspan(range.firstVertex, range.vertexCount))
      greatest = std::max(greatest, length);
  const ByteForm form{.isSigned = false, .square = true, .scale = greatest > 0.0f ? greatest : 1.0f};
  entry["thickness"] = output.column("thickness", thickness, ranges, 1, form);
}

class ThicknessReader final : public TechniqueReader {
 public:
  explicit ThicknessReader(const BakedInput& input) : input_(input), values_(input.document, input.root) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& bake) override {
    const auto thickness = entry.find("thickness");
    if (!thickness) return;
    const std::vector<float> values = values_.floats(*thickness, "SCALAR", vertexCount(ranges));
    if (std::ranges::any_of(values, [](float value) { return value < 0.0f; }))
      thickness->fail("expected lengths of at least 0 m", rebake);
    placeVertices(values, ranges, 1, input_.scene, bake.thickness);
  }

 private:
  const BakedInput& input_;
  ValueReader values_;
};

void summarizeThickness(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (!bake.thickness.empty())
    found.push_back({"thickness", "thickness of bodies", thicknessBytes(bake), true, true});
}

void addThicknessArrays(const Bake& bake, std::vector<BakedArray>& arrays) {
  if (!bake.thickness.empty()) arrays.push_back({"thickness", "[vertex], m", {bake.thickness}});
}

constexpr auto thicknessOptions = std::to_array<Option<BakeRequest>>({
    options::BakeRow::flag<&BakeRequest::thickness>(
        {.field = "BakeRequest::thickness",
         .name = "thickness",
         .help = "thickness of bodies below each vertex, by which light shines through wax, jade and skin"}),
});

}  // namespace

Technique thicknessTechnique() {
  return {.name = "thickness",
          .options = {.rows = thicknessOptions, .behind = "horizons"},
          .shading = &thicknessShading,
          .use = {.bounces = false},
          .plan = {.passes = thicknessPasses, .addMemory = addThicknessMemory, .addToKey = addThicknessToKey},
          .makeProjector = makeThicknessProjector,
          .file = {.members = {"thickness"},
                   .quantizable = true,
                   .accessors = {"thickness"},
                   .storedBytes = thicknessBytes,
                   .writeEntry = writeThicknessEntry,
                   .makeReader = makeTechniqueReader<ThicknessReader>},
          .summarize = summarizeThickness,
          .addArrays = addThicknessArrays};
}

}  // namespace prelight
