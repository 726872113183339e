#include "gi/probes/probe_places.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "base/octahedral.h"
#include "cast/caster.h"
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

}  // namespace prelight
