#include "photon/density_estimator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "base/spans.h"
#include "device/buffer.h"
#include "prelight/error.h"
#include "shared/gather_types.h"

namespace prelight {

namespace {

using namespace device;

constexpr int mostNearest = 4096;
constexpr std::size_t densityGroup = 16;  // work-items have private memory for k distances each
constexpr std::size_t queriesPerLaunch = 1u << 18;

void check(const DensityOptions& options) {
  if (options.nearest != 0 && (options.nearest < 2 || options.nearest > mostNearest))
    throw UsageError("density estimation",
                     fmt::format("{} nearest photons; expected 2 to {}, or 0 for a fixed radius",
                                 options.nearest, mostNearest));
  if (!(options.minRadius >= 0.0) || !(options.flatness > 0.0) || !(options.leastCosine >= -1.0) ||
      !(options.leastCosine <= 1.0))
    throw UsageError(
        "density estimation",
        fmt::format("least radius {} m, flatness {}, least cosine {}; expected >= 0, > 0, -1 to 1",
                    options.minRadius, options.flatness, options.leastCosine));
}

}  // namespace

DensityEstimator::DensityEstimator(const DensitySurface& surface, const DensityOptions& options,
                                   const Device& device)
    : DensityEstimator(surface, options, device.context()) {}

DensityEstimator::DensityEstimator(const DensitySurface& surface, const DensityOptions& options,
                                   DeviceContext& device)
    : device_(device),
      options_(options),
      parameters_(device_, 1),
      mapCount_(2 * std::size_t{surface.regionCount()}) {
  check(options);
  values_ = {static_cast<float>(options.minRadius),
             static_cast<float>(options.leastCosine),
             static_cast<float>(options.flatness),
             0,
             0,
             0,
             0,
             0,
             0,
             0,
             0};
  PackedArrays<DensityLine> pack;
  values_.places = pack.add(spanOf(surface.places));
  values_.areaTrees = pack.add(spanOf(surface.areaTrees));
  values_.areaNodes = pack.add(spanOf(surface.areaNodes));
  values_.areaTriangles = pack.add(spanOf(surface.triangles));
  surfaceLines_ = pack.lines();
  lines_ = pack.upload(device_);
  setPhotons({.trees = std::vector<LeafTree>(mapCount_), .boxes = {}, .blocks = {}, .photonCount = 0});
}

BuildOptions& DensityEstimator::addOptions(BuildOptions& options, const DensityOptions& density) {
  return options.define("PRELIGHT_DENSITY_KERNEL", static_cast<int>(density.kernel))
      .define("PRELIGHT_DENSITY_NEAREST", density.nearest);
}

void DensityEstimator::follow(const DensitySurface& surface) {
  lines_.writeArray(spanOf(surface.areaNodes), values_.areaNodes);
  lines_.writeArray(spanOf(surface.triangles), values_.areaTriangles);
}

void DensityEstimator::setPhotons(const PhotonMaps& maps) {
  assert(maps.trees.size() >= mapCount_);
  PackedArrays<DensityLine> pack(surfaceLines_);
  values_.photonTrees = pack.add(spanOf(maps.trees));
  values_.photonBoxes = pack.add(spanOf(maps.boxes));
  values_.photonBlocks = pack.add(spanOf(maps.blocks));
  Buffer<DensityLine> lines(device_, pack.lines());
  lines.copy(lines_, surfaceLines_);
  pack.upload(lines);
  lines_ = std::move(lines);
}

void DensityEstimator::launch(Estimate& kernel, const Buffer<DensityQuery>& queries, std::size_t count,
                              Buffer<float>& values) {
  values_.queryCount = static_cast<std::uint32_t>(count);
  parameters_.write(std::span<const DensityParameters>(&values_, 1));
  kernel.launch({count, densityGroup}, parameters_, lines_, queries, values);
}

DensityEstimator::Estimate& DensityEstimator::estimateKernel() {
  if (!estimate_) {
    BuildOptions build;
    estimate_ = {device_, "photon/density_kernels.cl", addOptions(build, options_), "estimateIrradiance"};
  }
  return estimate_;
}

void DensityEstimator::estimate(const Buffer<DensityQuery>& queries, std::size_t count,
                                Buffer<float>& irradiance) {
  launch(estimateKernel(), queries, count, irradiance);
}

/// Runs a kernel. Returns its values, [query][length].
std::vector<float> DensityEstimator::estimateWith(Estimate& kernel, std::size_t length,
                                                  std::span<const DensityQuery> queries) {
  std::vector<float> values(length * queries.size());
  const std::size_t most = std::min(queries.size(), queriesPerLaunch);
  Buffer<DensityQuery> in(device_, most);
  Buffer<float> out(device_, length * most);
  for (std::size_t first = 0; first < queries.size(); first += most) {
    const std::size_t count = std::min(most, queries.size() - first);
    in.write(queries.subspan(first, count));
    launch(kernel, in, count, out);
    out.read(std::span(&values[length * first], length * count));
  }
  return values;
}

std::vector<glm::vec3> DensityEstimator::estimate(std::span<const DensityQuery> queries) {
  const std::vector<float> values = estimateWith(estimateKernel(), 3, queries);
  std::vector<glm::vec3> irradiance;
  irradiance.reserve(queries.size());
  for (std::size_t i = 0; i < values.size(); i += 3)
    irradiance.emplace_back(values[i], values[i + 1], values[i + 2]);
  return irradiance;
}

std::vector<float> DensityEstimator::guides(std::span<const DensityQuery> queries) {
  if (!guides_) {
    BuildOptions build;
    guides_ = {device_, "photon/guide_kernels.cl", addOptions(build, options_), "estimateGuides"};
  }
  return estimateWith(guides_, PRELIGHT_GUIDE_CELLS, queries);
}

std::vector<float> DensityEstimator::estimateIncident(std::span<const DensityQuery> queries, int order) {
  if (incidentOrder_ != order) {
    BuildOptions build;
    addIncidentOrder(build, order);
    incidentOrder_ = order;
    estimateIncident_ = {device_, "photon/incident_kernels.cl", addOptions(build, options_),
                         "estimateIncident"};
  }
  return estimateWith(estimateIncident_, 3 * static_cast<std::size_t>(incidentValueCount(order)), queries);
}

}  // namespace prelight
