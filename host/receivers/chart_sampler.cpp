#include "receivers/chart_sampler.h"

#include "receivers/sampling.h"
#include "scene/surface/uv_raster.h"

namespace prelight {

namespace {

constexpr int grid = 4;  // positions along the side of a texel
static_assert(grid * grid == ChartSampler::positionsPerTexel);

std::uint32_t seedOf(std::uint64_t seed, std::size_t chart) {
  using sampling::hashInteger;
  return hashInteger(static_cast<std::uint32_t>(seed) ^
                     hashInteger(static_cast<std::uint32_t>(seed >> 32) ^
                                 hashInteger(0x7e8e1u + static_cast<std::uint32_t>(chart))));
}

}  // namespace

ChartSampler::ChartSampler(const CompiledScene& scene, const Charts& charts, std::size_t chart,
                           std::uint64_t seed)
    : scene_(scene), charts_(charts), chart_(charts.charts[chart]), seed_(seedOf(seed, chart)) {
  const PrimitiveRange& range = scene.primitives[chart_.primitive];
  const std::vector<glm::uvec3> triangles = trianglesOf(scene, range);
  const int columns = grid * chart_.width, rows = grid * chart_.height;
  const auto jitter = [&](int column, int row) {
    return sampling::sobol(0,
                           seed_ ^ sampling::hashInteger(static_cast<std::uint32_t>(row * columns + column)));
  };
  const UvRaster raster = rasterizeUv(chart_.coords, triangles, columns, rows, jitter);
  firstPosition_.push_back(0);
  for (int texel = 0; texel < chart_.width * chart_.height; ++texel) {
    for (int k = 0; k < grid * grid; ++k) {
      const int column = texel % chart_.width * grid + k % grid, row = texel / chart_.width * grid + k / grid;
      const std::uint32_t t = raster.triangles[static_cast<std::size_t>(row * columns + column)];
      if (t == UvRaster::nothing) continue;
      const glm::dvec2 point = (glm::dvec2(column, row) + jitter(column, row)) / glm::dvec2(columns, rows);
      const auto weights = uvWeights(chart_.coords, triangles[t], point);
      const glm::dvec2 b = keptOffEdges(scene, range.firstTriangle + t, {weights[1], weights[2]});
      positions_.push_back({range.firstTriangle + t, static_cast<float>(b.x), static_cast<float>(b.y)});
    }
    if (positions_.size() == firstPosition_.back()) continue;
    texels_.push_back(static_cast<std::uint32_t>(texel));
    firstPosition_.push_back(static_cast<std::uint32_t>(positions_.size()));
  }
}

SurfaceSample ChartSampler::sampleAt(std::size_t place, std::uint32_t index, std::uint32_t count) const {
  const std::uint32_t first = firstPosition_[place], covered = firstPosition_[place + 1] - first;
  // Receivers are spread over the covered positions, which repeat if there are more receivers.
  const std::uint32_t chosen = count <= covered ? (2 * index + 1) * covered / (2 * count) : index % covered;
  const Position& position = positions_[first + chosen];
  return {position.triangle, position.b1, position.b2, 1.0f};
}

ChartSampler::Point ChartSampler::point(std::size_t place, std::uint32_t index, std::uint32_t count) const {
  const SurfaceSample sample = sampleAt(place, index, count);
  const auto [b0, b1, b2] = cornerWeights(sample);
  const device::Receiver receiver = receiverAt(scene_, sample, Side::Front);
  return {sample.triangle, {b0, b1, b2}, {receiver.normal[0], receiver.normal[1], receiver.normal[2]}};
}

device::Receiver ChartSampler::receiver(std::size_t place, std::uint32_t index, std::uint32_t count,
                                        std::uint32_t raysPerReceiver) const {
  const SurfaceSample sample = sampleAt(place, index, count);
  device::Receiver receiver = receiverAt(scene_, sample, Side::Front);
  const auto [b0, b1, b2] = cornerWeights(sample);
  const glm::dvec3 normal(receiver.normal[0], receiver.normal[1], receiver.normal[2]);
  const glm::vec3 mapped(mappedNormal(scene_, charts_, chart_, sample.triangle, {b0, b1, b2}, normal));
  for (int a = 0; a < 3; ++a) receiver.normal[a] = mapped[a];
  receiver.seed = seed_ ^ sampling::hashInteger(~texels_[place]);
  receiver.firstSample = index * raysPerReceiver;
  return receiver;
}

}  // namespace prelight
