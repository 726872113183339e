#include "photon/density_estimator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "base/error.h"

namespace prelight {

namespace {

using namespace device;

constexpr int mostNearest = 4096;
constexpr std::size_t groupSize = 16;  // private memory of k distances a work-item
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
    : device_(device.context()),
      options_(options),
      parameters_(device_, 1),
      mapCount_(2 * std::size_t{surface.regionCount()}) {
  check(options);
  values_ = {static_cast<float>(options.minRadius), static_cast<float>(options.leastCosine),
             static_cast<float>(options.flatness), 0};
  parameters_.write(std::span<const DensityParameters>(&values_, 1));
  places_ = Buffer<SurfacePlace>(device_, std::span<const SurfacePlace>(surface.places));
  areaTrees_ = Buffer<LeafTree>(device_, std::span<const LeafTree>(surface.areaTrees));
  areaNodes_ = Buffer<AreaNode>(device_, std::span<const AreaNode>(surface.areaNodes));
  triangles_ = Buffer<AreaTriangle>(device_, std::span<const AreaTriangle>(surface.triangles));
  setPhotons({.trees = std::vector<LeafTree>(mapCount_), .boxes = {}, .blocks = {}, .photonCount = 0});
}

BuildOptions& DensityEstimator::addOptions(BuildOptions& options, const DensityOptions& density) {
  return options.define("PRELIGHT_DENSITY_KERNEL", static_cast<int>(density.kernel))
      .define("PRELIGHT_DENSITY_NEAREST", density.nearest);
}

void DensityEstimator::follow(const DensitySurface& surface) {
  areaNodes_.write(std::span<const AreaNode>(surface.areaNodes));
  triangles_.write(std::span<const AreaTriangle>(surface.triangles));
}

void DensityEstimator::setPhotons(const PhotonMaps& maps) {
  assert(maps.trees.size() == mapCount_);
  photonTrees_ = Buffer<LeafTree>(device_, std::span<const LeafTree>(maps.trees));
  boxes_ = Buffer<float>(device_, std::span<const float>(maps.boxes));
  blocks_ = Buffer<PhotonBlock>(device_, std::span<const PhotonBlock>(maps.blocks));
}

void DensityEstimator::setArguments(cl::Kernel& kernel, cl_uint index) const {
  kernel.setArg(index, parameters_.get());
  kernel.setArg(index + 1, photonTrees_.get());
  kernel.setArg(index + 2, boxes_.get());
  kernel.setArg(index + 3, blocks_.get());
  kernel.setArg(index + 4, places_.get());
  kernel.setArg(index + 5, areaTrees_.get());
  kernel.setArg(index + 6, areaNodes_.get());
  kernel.setArg(index + 7, triangles_.get());
}

void DensityEstimator::launch(cl::Kernel& kernel, const Buffer<DensityQuery>& queries, std::size_t count,
                              Buffer<float>& values) {
  values_.queryCount = static_cast<std::uint32_t>(count);
  parameters_.write(std::span<const DensityParameters>(&values_, 1));
  setArguments(kernel, 0);
  kernel.setArg(8, queries.get());
  kernel.setArg(9, values.get());
  device_.launch(kernel, count, groupSize);
}

cl::Kernel& DensityEstimator::estimateKernel() {
  if (estimate_() == nullptr) {
    BuildOptions build;
    estimate_ = cl::Kernel(device_.program("photon/density_kernels.cl", addOptions(build, options_)),
                           "estimateIrradiance");
  }
  return estimate_;
}

void DensityEstimator::estimate(const Buffer<DensityQuery>& queries, std::size_t count,
                                Buffer<float>& irradiance) {
  launch(estimateKernel(), queries, count, irradiance);
}

/// [query][length]
std::vector<float> DensityEstimator::estimateWith(cl::Kernel& kernel, std::size_t length,
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

std::vector<float> DensityEstimator::estimateIncident(std::span<const DensityQuery> queries) {
  if (estimateIncident_() == nullptr) {
    BuildOptions build;
    estimateIncident_ = cl::Kernel(device_.program("photon/incident_kernels.cl", addOptions(build, options_)),
                                   "estimateIncident");
  }
  return estimateWith(estimateIncident_, 15, queries);
}

}  // namespace prelight
