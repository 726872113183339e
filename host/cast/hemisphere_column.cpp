#include "cast/hemisphere_column.h"

#include <algorithm>

#include "base/spans.h"
#include "basis/sh_evaluate.h"

namespace prelight {

namespace {

constexpr std::uint32_t mostViews = 256;  // drawn at once

std::size_t bandsOf(int order) { return static_cast<std::size_t>(order * order); }

HemispherePlace placeOf(const device::Receiver& receiver) {
  const auto vector = [](const float* from) { return glm::vec3(from[0], from[1], from[2]); };
  return {vector(receiver.position), receiver.triangle, vector(receiver.normal),
          vector(receiver.geometricNormal)};
}

}  // namespace

HemisphereColumn::HemisphereColumn(int shOrder, HemisphereRenderer* renderer)
    : FittedColumn(firstBand + bandsOf(shOrder), 1 + bandsOf(shOrder)),
      shOrder_(shOrder),
      renderer_(renderer) {}

// Views take longer than rays: a bake can be interrupted between blocks.
std::uint32_t HemisphereColumn::receiversAtOnce(DeviceKind /*kind*/, std::uint32_t usual) const {
  return renderer_ != nullptr ? std::min(usual, mostViews) : usual;
}

void HemisphereColumn::allocate(const CastShape& shape) {
  if (renderer_ != nullptr) return;
  FittedColumn::allocate(shape);
  DeviceContext& device = shape.tracer.context();
  shTable_ = Buffer<float>(device, std::span<const float>(makeShTable(std::max(1, shOrder_))));
  project_ = {device, "project/project_kernels.cl", BuildOptions().define("PRELIGHT_SH_ORDER", shOrder_),
              "projectHits"};
}

void HemisphereColumn::addParameters(const CastTask& /*task*/, DeviceLane /*lane*/,
                                     device::CastParameters& parameters) {
  parameters.valueCount = static_cast<std::uint32_t>(rowWidth());
}

void HemisphereColumn::start(const CastBlock& block) {
  if (renderer_ != nullptr) return;
  project_.launch({block.receivers, block.lane}, block.buffers.parameters, shTable_, block.buffers.rays,
                  block.buffers.hits, valuesOf(block));
}

void HemisphereColumn::finish(const CastBlock& block, ColumnRows& rows) {
  if (renderer_ == nullptr) return FittedColumn::finish(block, rows);
  ColumnRows::read(block.buffers.receivers, 0, block.receivers, rows.rows);
  std::vector<HemispherePlace> places;
  for (const device::Receiver& receiver : rows.of<device::Receiver>()) places.push_back(placeOf(receiver));
  std::vector<float> values;
  for (const HemisphereView& view : renderer_->look(places, shOrder_)) {
    values.insert(values.end(), {view.open, view.direction.x, view.direction.y, view.direction.z});
    values.insert(values.end(), view.harmonics.begin(), view.harmonics.end());
  }
  const auto bytes = std::as_bytes(std::span(values));
  rows.rows.assign(bytes.begin(), bytes.end());
}

std::unique_ptr<ColumnSums> HemisphereColumn::makeSums(const SideShape& side) {
  mesh_ = &side.mesh;
  if (!front_) front_.emplace(side.scene, side.mesh, shOrder_);
  if (side.side == Side::Back) back_ = front_->ofBacks();
  return FittedColumn::makeSums(side);
}

// The kernel's values are those of the blocked part; what an open hemisphere has is added in closed form,
// then the interpolated baseline is taken off, so that the fit sees only what occlusion changes.
void HemisphereColumn::addTo(VertexFit& fit, const SeenBlock& block, std::vector<double>& rows) const {
  const Baseline& baseline = baselineOf(block.task.side);
  const std::size_t columns = fitWidth();
  rows.resize(block.samples.size() * columns);
  for (std::size_t i = 0; i < block.samples.size(); ++i) {
    askFor(block.samples, i, baseline);
    const SurfaceSample& sample = block.samples[i];
    const float* normal = block.receivers[i].normal;
    const float* values = row(block.rows, i);
    double* residual = &rows[i * columns];
    baseline.evaluate({normal[0], normal[1], normal[2]}, residual);
    const auto& slots = mesh_->triangles[sample.triangle];
    const double b1 = sample.b1, b2 = sample.b2, b0 = 1.0 - b1 - b2, open = values[0];
    residual[0] = open - 1.0;
    for (std::size_t c = 1; c < columns; ++c) {
      const double interpolated = b0 * baseline.value(slots[0], c) + b1 * baseline.value(slots[1], c) +
                                  b2 * baseline.value(slots[2], c);
      residual[c] = double(values[firstBand - 1 + c]) + open * residual[c] - interpolated;
    }
  }
  fit.add(block.samples, rows);
}

// The rows of samples after the i-th are made of values that lie anywhere in memory: prefetching them saves
// waiting.
void HemisphereColumn::askFor(std::span<const SurfaceSample> samples, std::size_t i,
                              const Baseline& baseline) const {
  constexpr std::size_t trianglesAhead = 12, slotsAhead = 6;
  if (i + trianglesAhead < samples.size()) prefetch(&mesh_->triangles[samples[i + trianglesAhead].triangle]);
  if (i + slotsAhead >= samples.size()) return;
  for (const std::uint32_t slot : mesh_->triangles[samples[i + slotsAhead].triangle])
    baseline.prefetchRow(slot);
}

}  // namespace prelight
