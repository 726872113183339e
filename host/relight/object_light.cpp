#include "relight/object_light.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "base/parallel.h"
#include "basis/sh_zonal.h"
#include "fit/symmetric_solve.h"
#include "relight/object_shadow.h"
#include "relight/vertex_lights.h"

namespace prelight {

namespace {

using namespace device;

constexpr std::size_t vertexGrain = 256;
constexpr std::size_t lampBands = ownLampOrder * ownLampOrder;
constexpr double leastPivot = 1e-4;  ///< least pivot of directions that an object's normals determine

CompiledScene withoutProbes(const CompiledScene& scene, std::uint32_t triangles) {
  CompiledScene traced = scene;
  traced.triangles.resize(triangles);
  traced.triangleMaterials.resize(triangles);
  traced.triangleFlat.resize(triangles);
  return traced;
}

std::vector<std::uint32_t> numbersFrom(std::uint32_t first, std::uint32_t end) {
  std::vector<std::uint32_t> numbers(end - first);
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

/// Rescales weights to a sum of 1. Returns false if all are 0.
template <typename Corners>
bool normalise(Corners& corners) {
  double sum = 0.0;
  for (const VolumeCorner& corner : corners) sum += corner.weight;
  if (sum < 1e-6) return false;
  for (VolumeCorner& corner : corners) corner.weight /= sum;
  return true;
}

/// Vertices without a cell copy those of vertices that they share a triangle with, ring by ring.
template <typename Corners>
void fillFromNeighbours(const CompiledScene& scene, const VertexRange& range, std::vector<std::uint8_t> known,
                        std::vector<Corners>& corners) {
  for (bool goesOn = true; goesOn;) {
    goesOn = false;
    const std::vector<std::uint8_t> before = known;
    for (std::uint32_t t = range.firstTriangle; t < range.firstTriangle + range.triangleCount; ++t) {
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t v = scene.triangles[t][k] - range.firstVertex;
        const std::uint32_t next = scene.triangles[t][(k + 1) % 3] - range.firstVertex;
        const auto take = [&](std::uint32_t to, std::uint32_t from) {
          if (known[to] != 0 || before[from] == 0) return;
          corners[to] = corners[from];
          known[to] = 1;
          goesOn = true;
        };
        take(v, next);
        take(next, v);
      }
    }
  }
}

/// Returns SH of the incident radiance, [i][light], that explains best, in the least-squares sense over the
/// normals, the light that vertices receive. `received` is [vertex][light], exit radiance over albedo.
std::vector<double> arrivingLight(const CompiledScene& scene, const VertexRange& range,
                                  const std::vector<float>& received, std::size_t lights) {
  std::vector<double> matrix(lampBands * lampBands, 0.0), right(lampBands * lights, 0.0), open(lampBands);
  for (std::size_t v = 0; v < range.vertexCount; ++v) {
    sh::openTransfer(glm::dvec3(scene.normals[range.firstVertex + v]), ownLampOrder, open);
    for (std::size_t i = 0; i < lampBands; ++i) {
      for (std::size_t j = 0; j < lampBands; ++j) matrix[i * lampBands + j] += open[i] * open[j];
      for (std::size_t k = 0; k < lights; ++k)
        right[i * lights + k] += open[i] * double(received[v * lights + k]);
    }
  }
  SymmetricFactors(std::move(matrix), leastPivot).solve(right, lights);
  return right;
}

ObjectTransfer emptyTransfer(const VolumeTransfer& volume, const VertexRange& range, std::size_t groups) {
  return {std::vector<float>(range.vertexCount * 3 * volume.columns()),
          std::vector<float>(range.vertexCount * 3 * groups)};
}

ReceivedTransfer rowOf(ObjectTransfer& transfer, std::size_t vertex, std::size_t columns,
                       std::size_t groups) {
  return {std::span(transfer.sh).subspan(vertex * 3 * columns, 3 * columns),
          std::span(transfer.lights).subspan(vertex * 3 * groups, 3 * groups)};
}

}  // namespace

ObjectScene::ObjectScene(const CompiledScene& scene, const SceneParts& parts, const GroupedLights* lights,
                         const Device& device)
    : whole_(withoutProbes(scene, parts.traced), device), walls_(whole_, scene, numbersFrom(0, parts.baked)) {
  whole_.separate(withoutProbes(scene, parts.traced), numbersFrom(parts.baked, parts.traced));
  if (lights == nullptr || lights->empty()) return;
  places_ = placesOf(scene, *lights);
  lamps_.emplace(scene, *lights, whole_);
  unhidden_.emplace(scene, *lights, walls_);
}

void ObjectScene::shadeByOccluders(const CompiledScene& scene, std::span<const VertexRange> objects) {
  for (const VertexRange& range : objects) occluders_.emplace_back(scene, range, whole_);
}

void ObjectScene::shadeByNeighbourhoods(const CompiledScene& scene, std::span<const VolumeObject> objects,
                                        std::vector<float> direct) {
  direct_ = std::move(direct);
  std::vector<VertexRange> ranges;
  for (const VolumeObject& object : objects) {
    ranges.push_back(object.range);
    neighbourhoods_.emplace_back(scene, object.range, object.own, whole_, Neighbourhood::mostOrder);
  }
  if (lamps_) shadeByOccluders(scene, ranges);
}

void ObjectScene::follow(const CompiledScene& scene) {
  whole_.follow(scene);
  for (Neighbourhood& neighbourhood : neighbourhoods_) neighbourhood.follow(scene);
  for (ObjectOccluder& occluder : occluders_) occluder.follow(scene);
}

ObjectShadow ObjectScene::shadowOf(const CompiledScene& scene, const VertexRange& baked,
                                   std::span<const VertexRange> objects, int order) {
  if (!neighbourhoods_.empty())
    return shadowByNeighbourhoods(scene, baked, neighbourhoods_, direct_, walls_, order);
  if (!occluders_.empty()) return shadowByOccluders(scene, baked, occluders_, walls_, order);
  return ObjectShadowCaster(whole_, walls_, order).cast(scene, baked, objects);
}

std::vector<float> ObjectScene::lampsPast(const CompiledScene& scene, const VertexRange& baked,
                                          std::span<const float> unhidden) {
  if (!occluders_.empty()) return lampsPastOccluders(scene, baked, occluders_, places_, unhidden);
  return lampsOn(scene, baked, true);
}

std::vector<float> ObjectScene::lampsOn(const CompiledScene& scene, const VertexRange& range,
                                        bool withObjects) {
  std::optional<VertexLights>& lamps = withObjects ? lamps_ : unhidden_;
  return lamps ? lamps->at(scene, range) : std::vector<float>();
}

void ObjectScene::addOwnBounces(const CompiledScene& scene, const VolumeObject& object,
                                std::vector<float>& lights) {
  if (!unhidden_ || object.bounced.empty()) return;
  const std::size_t groups = unhidden_->groupCount();
  const std::vector<double> arriving =
      arrivingLight(scene, object.range, unhidden_->at(scene, object.range), 3 * groups);
  const std::size_t columns = object.bounced.size() / (std::size_t{3} * object.range.vertexCount);
  for (std::size_t row = 0; row < lights.size(); ++row) {
    const std::size_t at = row / groups, light = row % (3 * groups);  // [vertex][channel]; [channel][group]
    double sum = 0.0;
    for (std::size_t i = 0; i < lampBands; ++i)
      sum += double(object.bounced[at * columns + i]) * arriving[i * 3 * groups + light];
    lights[row] += static_cast<float>(std::max(0.0, sum));
  }
}

ObjectLight::ObjectLight(const CompiledScene& scene, const SceneParts& parts, const VolumeTransfer& volume,
                         const GroupedLights* lights, const Device& device)
    : ObjectScene(scene, parts, lights, device), volume_(volume), receiver_(volume), origin_(scene.origin) {}

/// Removes cells inside objects and cells that are not visible from `origins`, [vertex].
void ObjectLight::leaveOutHidden(const std::vector<glm::vec3>& origins, std::vector<Corners>& corners) {
  std::vector<Ray> rays;
  for (std::size_t v = 0; v < corners.size(); ++v)
    for (const VolumeCorner& corner : corners[v]) {
      const glm::vec3 way(voxelCentre(volume_.grid, corner.voxel) - origin_ - glm::dvec3(origins[v]));
      rays.push_back(
          {{origins[v].x, origins[v].y, origins[v].z}, PRELIGHT_NO_TRIANGLE, {way.x, way.y, way.z}, 1.0f});
    }
  const std::vector<Hit> hits = walls_.traceAny(rays);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    VolumeCorner& corner = corners[i / 8][i % 8];
    if (hits[i].triangle != PRELIGHT_NO_TRIANGLE || volume_.air[corner.voxel] == 0) corner.weight = 0.0;
  }
}

std::vector<ObjectLight::Corners> ObjectLight::seenCorners(const CompiledScene& scene,
                                                           const VertexRange& range) {
  const glm::vec3 middle = middleOf(scene, range);
  std::vector<Corners> corners;
  std::vector<glm::vec3> origins;
  for (std::uint32_t v = range.firstVertex; v < range.firstVertex + range.vertexCount; ++v) {
    corners.push_back(cornersAt(volume_.grid, glm::dvec3(scene.positions[v]) + origin_));
    origins.push_back(glm::mix(scene.positions[v], middle, towardsMiddle));
  }
  leaveOutHidden(origins, corners);
  std::vector<std::uint8_t> known;
  for (Corners& around : corners) known.push_back(normalise(around) ? 1 : 0);
  fillFromNeighbours(scene, range, std::move(known), corners);
  return corners;
}

void ObjectLight::addLamps(std::optional<VertexLights>& lamps, const CompiledScene& scene,
                           const VertexRange& range, ObjectTransfer& transfer) {
  if (!lamps) return;
  const std::vector<float> direct = lamps->at(scene, range);
  for (std::size_t i = 0; i < direct.size(); ++i) transfer.lights[i] += direct[i];
}

ObjectTransfer ObjectLight::transferOf(const CompiledScene& scene, const VolumeObject& object) {
  const VertexRange& range = object.range;
  const std::size_t groups = lamps_ ? lamps_->groupCount() : 0;
  ObjectTransfer transfer = emptyTransfer(volume_, range, groups);
  const std::vector<Corners> corners = seenCorners(scene, range);
  const std::vector<double> shares = shareBesideOwnShadow(scene, range, walls_);
  const std::size_t ownLength = object.own.coefficients.size() / range.vertexCount;
  parallelRanges(range.vertexCount, vertexGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v)
      receiver_.receive(corners[v], std::span(object.own.coefficients).subspan(v * ownLength, ownLength),
                        object.own.channels, shares[v], rowOf(transfer, v, volume_.columns(), groups));
  });
  addLamps(lamps_, scene, range, transfer);
  addOwnBounces(scene, object, transfer.lights);
  return transfer;
}

ObjectTransfer ObjectLight::transferOfProbes(const CompiledScene& scene, const VertexRange& range,
                                             std::span<const std::size_t> voxels) {
  const std::size_t groups = unhidden_ ? unhidden_->groupCount() : 0;
  ObjectTransfer transfer = emptyTransfer(volume_, range, groups);
  const std::size_t each = range.vertexCount / std::max<std::size_t>(1, voxels.size());
  const int order = VolumeReceiver::ownOrder(volume_);
  parallelRanges(range.vertexCount, vertexGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<double> open(static_cast<std::size_t>(order * order));
    for (std::size_t v = begin; v < end; ++v) {
      sh::openTransfer(glm::dvec3(scene.normals[range.firstVertex + v]), order, open);
      const std::vector<float> own(open.begin(), open.end());
      const VolumeCorner cell{voxels[v / each], 1.0};
      receiver_.receive(std::span(&cell, 1), own, 1, 1.0, rowOf(transfer, v, volume_.columns(), groups));
    }
  });
  addLamps(unhidden_, scene, range, transfer);
  return transfer;
}

}  // namespace prelight
