#include "gi/surface_patches.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "charts/light_map_lookup.h"
#include "charts/seam_stitching.h"
#include "charts/wall_search.h"
#include "receivers/surface_sampler.h"
#include "scene/surface/mesh_edges.h"
#include "scene/surface/surface_regions.h"
#include "scene/surface/triangles.h"

namespace prelight {

namespace {

constexpr std::size_t placesAtOnce = 1u << 13;  // per thread

}  // namespace

SurfacePatches::SurfacePatches(const CompiledScene& scene, Tracer& tracer, LightMapLayout layout,
                               const DensitySurface& surface)
    : scene_(scene), tracer_(tracer), layout_(std::move(layout)), surface_(surface), grid_(layout_) {
  std::vector<std::uint32_t> roots = wallPatches(layout_);
  for (const SeamPoint& seam : seamsOf(scene_, tracer_, layout_, usualCreaseAngle)) {
    const std::uint32_t a = rootOf(roots, grid_.indexOf(nearestTexel(seam.first))),
                        b = rootOf(roots, grid_.indexOf(nearestTexel(seam.second)));
    roots[std::max(a, b)] = std::min(a, b);
  }
  for (std::uint32_t i = 0; i < roots.size(); ++i) roots[i] = rootOf(roots, i);
  number(roots);
}

/// Numbers the patches. The first patch of a region's side has the region's number.
void SurfacePatches::number(std::span<const std::uint32_t> roots) {
  count_ = surface_.regionCount();
  std::vector<std::uint8_t> begun(2 * std::size_t{count_}, 0);
  std::vector<std::uint32_t> patchOfRoot(roots.size(), TexelGrid::none);
  for (std::size_t i = 0; i < roots.size(); ++i) {
    std::uint32_t& patch = patchOfRoot[roots[i]];
    if (patch == TexelGrid::none) {
      const LightMapTexel& texel = layout_.texels[i];
      const std::uint32_t triangle = triangleOf(scene_, texel), region = regionOf(triangle);
      std::uint8_t& has = begun[2 * region + (triangle == texel.face ? 0 : 1)];
      patch = region;
      if (has != 0) {
        patch = count_++;
        regions_.push_back(region);
      }
      has = 1;
    }
    patchOf_.push_back(patch);
  }
}

/// Returns the texels of the layout around a place, nearest first, and whether walls separate them. Returns
/// none if the face has no chart.
std::vector<std::uint32_t> SurfacePatches::texelsAround(const LightMapTexel& place, bool& walled) const {
  walled = false;
  if (layout_.chartOf[place.face] == LightMapLayout::noChart) return {};
  const glm::dvec2 at = lightMapPlace(layout_, place.face, double(place.b1), double(place.b2)) - 0.5;
  const glm::ivec2 low(glm::floor(at));
  walled = wallsOf(layout_, low.x, low.y).any();
  std::vector<std::pair<double, std::uint32_t>> around;
  for (int i = 0; i < 4; ++i) {
    const glm::ivec2 p = glm::clamp(low + glm::ivec2(i % 2, i / 2), glm::ivec2(0),
                                    glm::ivec2(layout_.width - 1, layout_.height - 1));
    const std::uint32_t index = grid_.indexOf(static_cast<std::uint32_t>(p.y * layout_.width + p.x));
    if (index != TexelGrid::none &&
        layout_.chartOf[layout_.texels[index].face] == layout_.chartOf[place.face])
      around.emplace_back(glm::distance(at, glm::dvec2(p)), index);
  }
  std::sort(around.begin(), around.end());
  std::vector<std::uint32_t> texels;
  for (const auto& [distance, index] : around) texels.push_back(index);
  return texels;
}

std::vector<std::uint32_t> SurfacePatches::at(std::span<const LightMapTexel> places) const {
  std::vector<std::uint32_t> patches(places.size());
  std::vector<std::uint8_t> walled(places.size(), 0);
  parallelRanges(places.size(), placesAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      patches[i] = regionOf(triangleOf(scene_, places[i]));
      if (areRegions()) continue;
      bool parted = false;
      const std::vector<std::uint32_t> around = texelsAround(places[i], parted);
      if (around.empty()) continue;
      patches[i] = patchOf_[around.front()];
      walled[i] = parted ? 1 : 0;
    }
  });
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < walled.size(); ++i)
    if (walled[i] != 0) indices.push_back(i);
  if (!indices.empty()) lookAround(places, indices, patches);
  return patches;
}

void SurfacePatches::lookAround(std::span<const LightMapTexel> places, std::span<const std::uint32_t> indices,
                                std::vector<std::uint32_t>& patches) const {
  std::vector<LightMapTexel> known = layout_.texels;
  const auto first = static_cast<std::uint32_t>(known.size());
  std::vector<PlacePair> pairs;
  for (std::uint32_t k = 0; k < indices.size(); ++k) {
    known.push_back(places[indices[k]]);
    patches[indices[k]] = count_;
    bool walled = false;
    for (const std::uint32_t texel : texelsAround(known.back(), walled)) pairs.push_back({first + k, texel});
  }
  const std::vector<Obstacle> there = lookAlong(scene_, tracer_, layout_, known, pairs);
  for (std::size_t i = pairs.size(); i-- > 0;)  // the nearest texel comes last and overrides the others
    if (there[i].seen) patches[indices[pairs[i][0] - first]] = patchOf_[pairs[i][1]];
}

PhotonMaps SurfacePatches::sort(std::span<const device::Photon> photons) const {
  return makePhotonMaps(photons, mapsOf(photons), std::size_t{count_} + (areRegions() ? 0 : 1));
}

std::vector<std::uint32_t> SurfacePatches::mapsOf(std::span<const device::Photon> photons) const {
  std::vector<std::uint32_t> mapOf = mapsOfPhotons(photons, surface_);
  if (areRegions()) return mapOf;
  std::vector<LightMapTexel> places(photons.size());
  parallelRanges(photons.size(), placesAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const device::Photon& photon = photons[i];
      const glm::dvec2 b = triangleWeights(scene_, photon.triangle,
                                           {photon.position[0], photon.position[1], photon.position[2]});
      const double b1 = std::clamp(b.x, 0.0, 1.0), b2 = std::clamp(b.y, 0.0, 1.0 - b1);
      places[i] = {0, photon.triangle + (mapOf[i] % 2) * scene_.triangleCount(), static_cast<float>(b1),
                   static_cast<float>(b2)};
    }
  });
  const std::vector<std::uint32_t> patches = at(places);
  for (std::size_t i = 0; i < mapOf.size(); ++i) mapOf[i] = 2 * patches[i] + mapOf[i] % 2;
  return mapOf;
}

}  // namespace prelight
