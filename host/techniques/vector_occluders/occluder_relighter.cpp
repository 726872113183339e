#include "techniques/vector_occluders/occluder_relighter.h"

#include <fmt/format.h>

#include <algorithm>

#include "occluders/wave_table.h"
#include "prelight/error.h"

namespace prelight {

namespace {

constexpr std::size_t groupSize = 64;

/// Most records x lights per launch, which takes a fraction of a second on a slow processor.
constexpr std::size_t mostPairs = std::size_t{1} << 21;

void copy(float* to, const glm::vec3& from) { std::copy(&from.x, &from.x + 3, to); }

const OccluderReceivers& checked(const OccluderReceivers& receivers, const OccluderTransfer& transfer) {
  const std::size_t vertices = transfer.offsets.empty() ? 0 : transfer.offsets.size() - 1;
  if (receivers.positions.size() != vertices || receivers.normals.size() != vertices ||
      (!receivers.gloss.empty() && receivers.gloss.size() != vertices))
    throw UsageError(
        "vector occluders",
        fmt::format("got {} positions, {} normals and {} glosses, expected {} of each, or no gloss",
                    receivers.positions.size(), receivers.normals.size(), receivers.gloss.size(), vertices));
  return receivers;
}

}  // namespace

std::vector<device::OccluderReceiverPoint> OccluderReceivers::points() const {
  std::vector<device::OccluderReceiverPoint> result(positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) {
    copy(result[v].position, positions[v]);
    copy(result[v].normal, normals[v]);
    result[v].roughness = gloss.empty() ? 1.0f : gloss[v].w;
    if (!gloss.empty()) copy(result[v].f0, glm::vec3(gloss[v]));
  }
  return result;
}

OccluderRelighter::OccluderRelighter(DeviceContext& device, const OccluderTransfer& transfer,
                                     const OccluderReceivers& receivers)
    : device_(device),
      upload_(transfer, checked(receivers, transfer).origin),
      vertices_(receivers.positions.size()),
      records_(device, std::span<const glm::vec4>(upload_.records)),
      owners_(device, std::span<const std::int32_t>(upload_.owners)),
      offsets_(device, std::span<const std::uint32_t>(transfer.offsets)),
      waves_(device, std::span<const glm::vec4>(makeWaveTable())),
      prepared_(device, upload_.owners.size() * static_cast<std::size_t>(upload_.stride)) {
  const std::vector<device::OccluderReceiverPoint> points = receivers.points();
  receivers_ =
      Buffer<device::OccluderReceiverPoint>(device, std::span<const device::OccluderReceiverPoint>(points));
  upload_.records = {};
  prepareKernel_ = {device, "techniques/vector_occluders/occluder_light_kernels.cl", {}, "prepareOccluders"};
  relightKernel_ = {device, "techniques/vector_occluders/occluder_light_kernels.cl", {}, "relightOccluders"};
  diffuseKernel_ = {device, "techniques/vector_occluders/occluder_light_kernels.cl", {}, "takeDiffuse"};
}

void OccluderRelighter::prepare(const device::OccluderTerms& terms) {
  if (preparedFor_ && samePreparation(*preparedFor_, terms)) return;
  const std::size_t count = recordCount();
  prepareKernel_.launch(count, records_, owners_, receivers_, waves_, terms,
                        static_cast<std::uint32_t>(count), prepared_);
  preparedFor_ = terms;
}

void OccluderRelighter::relight(std::span<const device::OccluderLight> lights, const OccluderShading& shading,
                                const OccluderEye& eye, Buffer<device::LitVertex>& lit) {
  const device::OccluderTerms terms = upload_.terms(shading, eye, lights.size());
  prepare(terms);
  const Buffer<device::OccluderLight> onDevice(device_, lights);
  const std::size_t pairs = (upload_.longestRow + 1) * std::max<std::size_t>(1, lights.size());
  const std::size_t step = std::max(groupSize, mostPairs / pairs / groupSize * groupSize);
  for (std::size_t first = 0; first < vertices_; first += step) {
    const std::size_t end = std::min(vertices_, first + step);
    relightKernel_.launch({end - first, groupSize}, offsets_, prepared_, receivers_, onDevice, waves_, terms,
                          static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end), lit);
  }
}

void OccluderRelighter::takeDiffuse(const Buffer<device::LitVertex>& lit, Buffer<float>& radiance) {
  diffuseKernel_.launch(vertices_, lit, static_cast<std::uint32_t>(vertices_), radiance);
}

std::vector<device::LitVertex> OccluderRelighter::relight(std::span<const device::OccluderLight> lights,
                                                          const OccluderShading& shading,
                                                          const OccluderEye& eye) {
  Buffer<device::LitVertex> lit(device_, vertices_);
  relight(lights, shading, eye, lit);
  return lit.read();
}

}  // namespace prelight
