#include "gi/probes/probe_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "base/directions.h"
#include "basis/sh_evaluate.h"
#include "basis/sh_zonal.h"
#include "cast/caster.h"
#include "gi/final_gather.h"
#include "radiosity/direct_light.h"
#include "receivers/sampling.h"
#include "scene/light_sources.h"
#include "techniques/volume/volume_light.h"

namespace prelight {

namespace {

constexpr std::size_t texels = std::size_t{IrradianceVolume::surfaceSide} * IrradianceVolume::surfaceSide;
constexpr std::size_t evenRays = 256, raysPerProbe = evenRays + texels, probesAtOnce = 1024;
constexpr double insideShare = 0.25;                     ///< share of directions that see backs
constexpr double farthestMove = 0.5, pastSurface = 0.1;  ///< in cells
/// Planes farther away than this, in cells, hide no point that a probe is used for.
constexpr double farthestSurface = 2.5;

/// Returns directions that cover the sphere evenly (a spherical Fibonacci lattice: Keinert and others 2015),
/// followed by those of an octahedral map's texels.
std::vector<glm::dvec3> probeDirections() {
  std::vector<glm::dvec3> directions;
  for (std::size_t i = 0; i < evenRays; ++i) {
    const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(evenRays);
    const double radius = std::sqrt(std::max(0.0, 1.0 - z * z));
    const double turn = 2.0 * std::numbers::pi * static_cast<double>(i) / std::numbers::phi;
    directions.emplace_back(radius * std::cos(turn), radius * std::sin(turn), z);
  }
  constexpr auto side = static_cast<std::size_t>(IrradianceVolume::surfaceSide);
  for (std::size_t texel = 0; texel < texels; ++texel)
    directions.push_back(
        octahedralDirection((glm::dvec2(texel % side, texel / side) + 0.5) / static_cast<double>(side)));
  return directions;
}

/// The surroundings of a probe.
struct ProbeView {
  std::vector<glm::vec4> surfaces;  ///< [texel], as IrradianceVolume::surfaces
  std::size_t backs = 0;            ///< number of the even directions that see a back
  double nearestBack = std::numeric_limits<double>::infinity();  ///< m
  std::size_t nearest = 0;                                       ///< index of the nearest back's direction

  bool inside() const { return static_cast<double>(backs) >= insideShare * evenRays; }
};

class ProbePlacer {
 public:
  ProbePlacer(const CompiledScene& scene, Tracer& tracer, IrradianceVolume& volume)
      : scene_(scene),
        tracer_(tracer),
        volume_(volume),
        normals_(orientedNormals(scene)),
        twoSided_(twoSidedTriangles(scene)),
        directions_(probeDirections()) {}

  ProbePlacement run(Progress& progress) {
    const std::size_t count = volume_.grid.count();
    volume_.valid.assign(count, 1);
    volume_.surfaces.resize(count * texels);
    volume_.places.clear();
    for (std::size_t p = 0; p < count; ++p) volume_.places.emplace_back(voxelCentre(volume_.grid, p));
    for (std::size_t first = 0; first < count; first += probesAtOnce) {
      progress.check();
      progress.report("places of probes", static_cast<double>(first) / static_cast<double>(count));
      placeBlock(first, std::min(probesAtOnce, count - first));
    }
    return placement_;
  }

 private:
  void placeBlock(std::size_t first, std::size_t count) {
    std::vector<std::size_t> probes(count);
    for (std::size_t i = 0; i < count; ++i) probes[i] = first + i;
    std::vector<std::size_t> moved;
    for (const auto& [probe, view] : look(probes)) {
      keep(probe, view);
      if (!view.inside()) continue;
      if (view.nearestBack > farthestMove * volume_.grid.cell()) {
        invalidate(probe);
        continue;
      }
      const double step = view.nearestBack + pastSurface * volume_.grid.cell();
      volume_.places[probe] += glm::vec3(step * directions_[view.nearest]);
      moved.push_back(probe);
    }
    for (const auto& [probe, view] : look(moved)) {
      keep(probe, view);
      view.inside() ? invalidate(probe) : void(++placement_.moved);
    }
  }

  void invalidate(std::size_t probe) {
    volume_.valid[probe] = 0;
    ++placement_.inside;
  }

  void keep(std::size_t probe, const ProbeView& view) {
    std::copy(view.surfaces.begin(), view.surfaces.end(),
              volume_.surfaces.begin() + static_cast<std::ptrdiff_t>(probe * texels));
  }

  std::vector<std::pair<std::size_t, ProbeView>> look(const std::vector<std::size_t>& probes) const {
    std::vector<device::Ray> rays;
    for (const std::size_t probe : probes) {
      const glm::vec3 from(glm::dvec3(volume_.places[probe]) - scene_.origin);
      for (const glm::dvec3& d : directions_)
        rays.push_back({{from.x, from.y, from.z},
                        PRELIGHT_NO_TRIANGLE,
                        {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)},
                        std::numeric_limits<float>::max()});
    }
    std::vector<std::pair<std::size_t, ProbeView>> views;
    if (rays.empty()) return views;
    std::vector<device::Hit> hits = tracer_.traceClosest(rays);
    preferFronts(rays, hits);
    for (std::size_t i = 0; i < probes.size(); ++i)
      views.emplace_back(probes[i], viewOf(std::span(hits).subspan(i * raysPerProbe, raysPerProbe)));
    return views;
  }

  /// Where the back of one room's wall coincides with the front of another's, chooses the front.
  void preferFronts(const std::vector<device::Ray>& rays, std::vector<device::Hit>& hits) const {
    constexpr float sameDistance = 1.0001f;
    std::vector<device::Ray> again;
    std::vector<std::size_t> of;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (!meetsBack(hits[i], directions_[i % raysPerProbe])) continue;
      again.push_back(rays[i]);
      again.back().sourceTriangle = hits[i].triangle;
      again.back().tMax = hits[i].t * sameDistance;
      of.push_back(i);
    }
    if (again.empty()) return;
    const std::vector<device::Hit> others = tracer_.traceClosest(again);
    for (std::size_t i = 0; i < of.size(); ++i)
      if (others[i].triangle != PRELIGHT_NO_TRIANGLE &&
          !meetsBack(others[i], directions_[of[i] % raysPerProbe]))
        hits[of[i]] = others[i];
  }

  ProbeView viewOf(std::span<const device::Hit> hits) const {
    ProbeView view;
    for (std::size_t i = 0; i < evenRays; ++i) {
      if (!meetsBack(hits[i], directions_[i])) continue;
      ++view.backs;
      const auto length = static_cast<double>(hits[i].t);
      if (length >= view.nearestBack) continue;
      view.nearestBack = length;
      view.nearest = i;
    }
    for (std::size_t i = evenRays; i < raysPerProbe; ++i)
      view.surfaces.push_back(surfaceAt(hits[i], directions_[i]));
    return view;
  }

  glm::dvec3 normalOf(std::uint32_t triangle) const {
    return {normals_[3 * triangle], normals_[3 * triangle + 1], normals_[3 * triangle + 2]};
  }

  bool meetsBack(const device::Hit& hit, const glm::dvec3& direction) const {
    return hit.triangle != PRELIGHT_NO_TRIANGLE && twoSided_[hit.triangle] == 0 &&
           glm::dot(normalOf(hit.triangle), direction) > 0.0;
  }

  glm::vec4 surfaceAt(const device::Hit& hit, const glm::dvec3& direction) const {
    constexpr glm::vec4 none(0.0f, 0.0f, 0.0f, 1.0f);
    if (hit.triangle == PRELIGHT_NO_TRIANGLE) return none;
    glm::dvec3 normal = normalOf(hit.triangle);
    const double length = glm::length(normal);
    if (!(length > 0.0)) return none;
    normal /= glm::dot(normal, direction) > 0.0 ? -length : length;
    const double height = -static_cast<double>(hit.t) * glm::dot(normal, direction);
    if (height > farthestSurface * volume_.grid.cell()) return none;
    return {glm::vec3(normal), static_cast<float>(height)};
  }

  const CompiledScene& scene_;
  Tracer& tracer_;
  IrradianceVolume& volume_;
  std::vector<float> normals_;
  std::vector<std::uint8_t> twoSided_;
  std::vector<glm::dvec3> directions_;
  ProbePlacement placement_;
};

}  // namespace

ProbePlacement placeProbes(const CompiledScene& scene, Tracer& tracer, IrradianceVolume& volume,
                           Progress& progress) {
  return ProbePlacer(scene, tracer, volume).run(progress);
}

namespace {

struct WeightedNormal {
  glm::dvec3 normal;
  double weight;  ///< the weights sum to 1
};

constexpr std::size_t normalCount = 50;

/// Returns the directions of the centres of a cube's faces, of its edges and corners, and of one more point
/// per quarter of a face.
std::vector<WeightedNormal> lebedevNormals() {
  constexpr std::array<double, 3> weights = {4.0 / 315.0, 64.0 / 2835.0, 27.0 / 1280.0};
  std::vector<WeightedNormal> normals;
  for (int i = 0; i < 27; ++i) {
    const glm::dvec3 n(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    const double squared = glm::dot(n, n);
    if (squared > 0.0)
      normals.push_back({n / std::sqrt(squared), weights[static_cast<std::size_t>(squared) - 1]});
  }
  for (int i = 0; i < 24; ++i) {
    glm::dvec3 n(1.0);
    n[i / 8] = 3.0;
    for (int a = 0; a < 3; ++a)
      if ((i >> a & 1) != 0) n[a] = -n[a];
    normals.push_back({n / std::sqrt(11.0), 14641.0 / 725760.0});
  }
  return normals;
}

GatherRequest gatherRequest(const ProbeRequest& request) {
  GatherRequest gather;
  // The rays of a normal cover a hemisphere, and normals share their results.
  gather.raysPerReceiver = std::clamp(std::bit_floor(request.rays / std::uint32_t{normalCount}), 8u,
                                      GatherRequest::mostRaysPerReceiver);
  gather.seed = request.seed;
  return gather;
}

class ProbeGatherer {
 public:
  ProbeGatherer(const LitScene& lit, TransportScene& transport, const IrradianceMap& irradiance,
                const ProbeRequest& request, IrradianceVolume& volume)
      : origin_(lit.scene.origin),
        seed_(sampling::hashInteger(static_cast<std::uint32_t>(request.seed ^ request.seed >> 32))),
        volume_(volume),
        repeats_(std::max(1u, request.rays / raysOfARepeat)),
        gather_(transport, irradiance, gatherRequest(request)),
        direct_(lit.scene, transport.tracer()) {
    direct_.setLights({lit.lights, lit.sky, lit.skyRotation, true});
  }

  void run(Progress& progress) {
    volume_.coefficients.assign(volume_.grid.count() * 3 * volume_.columns(), 0.0f);
    constexpr std::size_t gatheredAtOnce = 512;
    for (std::size_t first = 0; first < volume_.grid.count(); first += gatheredAtOnce) {
      progress.check();
      progress.report("probes", static_cast<double>(first) / static_cast<double>(volume_.grid.count()));
      gatherBlock(first, std::min(gatheredAtOnce, volume_.grid.count() - first));
    }
  }

  std::uint64_t rays() const { return gather_.rays() + direct_.rays(); }

 private:
  static constexpr std::uint32_t raysOfARepeat = 256;  ///< rays of a probe per repetition of direct light

  void gatherBlock(std::size_t first, std::size_t count) {
    std::vector<device::Receiver> receivers;
    for (std::size_t probe = first; probe < first + count; ++probe)
      for (std::size_t n = 0; n < normalCount; ++n) receivers.push_back(receiverOf(probe, n));
    Progress silent;
    std::vector<glm::dvec3> irradiance;
    for (const glm::vec3& indirect : gather_.gather(receivers, silent)) irradiance.emplace_back(indirect);
    for (std::uint32_t repeat = 0; repeat < repeats_; ++repeat) {
      for (device::Receiver& receiver : receivers) receiver.firstSample = repeat;
      const std::vector<PointIrradiance> light = direct_.at(receivers);
      for (std::size_t i = 0; i < light.size(); ++i)
        irradiance[i] += glm::dvec3(light[i].far + light[i].emitters) / static_cast<double>(repeats_);
    }
    for (std::size_t i = 0; i < count; ++i)
      project(std::span(irradiance).subspan(i * normalCount, normalCount), first + i);
  }

  device::Receiver receiverOf(std::size_t probe, std::size_t normal) const {
    const glm::vec3 at(glm::dvec3(volume_.places[probe]) - origin_), n(normals_[normal].normal);
    device::Receiver receiver{};
    for (int a = 0; a < 3; ++a) {
      receiver.position[a] = at[a];
      receiver.normal[a] = receiver.geometricNormal[a] = n[a];
    }
    receiver.triangle = PRELIGHT_NO_TRIANGLE;
    receiver.seed = seed_ ^ sampling::hashInteger(static_cast<std::uint32_t>(probe * normalCount + normal));
    return receiver;
  }

  void project(std::span<const glm::dvec3> irradiance, std::size_t probe) {
    const std::size_t columns = volume_.columns();
    std::vector<double> values(columns);
    std::vector<glm::dvec3> sums(columns, glm::dvec3(0.0));
    for (std::size_t n = 0; n < normalCount; ++n) {
      sh::evaluate(normals_[n].normal, volume_.order, values);
      for (std::size_t i = 0; i < columns; ++i)
        sums[i] += 4.0 * std::numbers::pi * normals_[n].weight * values[i] * irradiance[n];
    }
    for (int l = 0, i = 0; l < volume_.order; ++l)
      for (int m = -l; m <= l; ++m, ++i)
        for (int c = 0; c < 3; ++c)
          volume_.coefficients[3 * (probe * columns + static_cast<std::size_t>(i)) +
                               static_cast<std::size_t>(c)] =
              static_cast<float>(sums[static_cast<std::size_t>(i)][c] /
                                 (std::numbers::pi * sh::clampedCosine(l)));
  }

  glm::dvec3 origin_;
  std::uint32_t seed_;
  IrradianceVolume& volume_;
  std::uint32_t repeats_;
  FinalGather gather_;
  DirectLight direct_;
  std::vector<WeightedNormal> normals_ = lebedevNormals();
};

/// Fills probes inside objects with the mean of their neighbours, from the outside in, for programs that
/// interpolate all probes.
void fillInvalid(IrradianceVolume& volume) {
  const glm::ivec3 size = volume.grid.size;
  const std::size_t length = 3 * volume.columns();
  std::vector<std::uint8_t> known = volume.valid;
  const auto indexOf = [&](const glm::ivec3& p) {
    return static_cast<std::size_t>((p.z * size.y + p.y) * size.x + p.x);
  };
  for (bool changed = true; changed;) {
    changed = false;
    const std::vector<std::uint8_t> before = known;
    for (int at = 0; at < static_cast<int>(volume.grid.count()); ++at) {
      if (before[static_cast<std::size_t>(at)] != 0) continue;
      const glm::ivec3 place(at % size.x, at / size.x % size.y, at / (size.x * size.y));
      std::vector<double> sum(length, 0.0);
      int neighbours = 0;
      for (int side = 0; side < 6; ++side) {
        glm::ivec3 next = place;
        next[side / 2] += side % 2 == 0 ? 1 : -1;
        if (next[side / 2] < 0 || next[side / 2] >= size[side / 2] || before[indexOf(next)] == 0) continue;
        ++neighbours;
        for (std::size_t i = 0; i < length; ++i) sum[i] += volume.coefficients[indexOf(next) * length + i];
      }
      if (neighbours == 0) continue;
      for (std::size_t i = 0; i < length; ++i)
        volume.coefficients[indexOf(place) * length + i] = static_cast<float>(sum[i] / neighbours);
      known[indexOf(place)] = 1;
      changed = true;
    }
  }
}

}  // namespace

IrradianceVolume gatherProbes(const LitScene& lit, const LightMapLayout& layout,
                              std::span<const glm::vec3> irradiance, const ProbeRequest& request,
                              const Device& device, Progress& progress, ProbeReport& report) {
  requireRanges(request);
  IrradianceVolume volume;
  volume.grid = makeVolumeGrid(lit.scene, request.size);
  volume.order = request.order;
  TransportScene transport(lit, device);
  report.placement = placeProbes(lit.scene, transport.tracer(), volume, progress);
  IrradianceMap map(transport.context(), layout);
  map.set(irradiance);
  ProbeGatherer gatherer(lit, transport, map, request, volume);
  gatherer.run(progress);
  fillInvalid(volume);
  report.rays = gatherer.rays();
  return volume;
}

}  // namespace prelight
