#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "charts/texel_grid.h"
#include "gpu/tracer.h"
#include "photon/density_surface.h"
#include "photon/photon_maps.h"
#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"

namespace prelight {

/// Divides the regions of a surface into patches separated by walls, so that photons on one side of a wall do
/// not count on the other. Patches follow from the walls of a light map: texels of one patch are connected by
/// steps along the surface without a wall. An undivided region is one patch with the region's number.
class SurfacePatches {
 public:
  /// The scene, the tracer made of it and the density surface must outlive the object.
  SurfacePatches(const CompiledScene& scene, Tracer& tracer, LightMapLayout layout,
                 const DensitySurface& surface);
  SurfacePatches(const SurfacePatches&) = delete;
  SurfacePatches& operator=(const SurfacePatches&) = delete;

  const LightMapLayout& layout() const { return layout_; }

  std::uint32_t count() const { return count_; }

  /// Returns the region that contains a patch.
  std::uint32_t regionOfPatch(std::uint32_t patch) const {
    return patch < surface_.regionCount() ? patch : regions_[patch - surface_.regionCount()];
  }

  /// Returns whether every region is one patch.
  bool areRegions() const { return count_ == surface_.regionCount(); }

  /// Returns the patch of each place on the surface, [place], for DensityQuery. Between texels separated by a
  /// wall it is the patch of the nearest texel visible from the place; a place that sees none gets a patch of
  /// its own.
  std::vector<std::uint32_t> at(std::span<const LightMapTexel> places) const;

  /// Returns 2 patch + (1 on the back) for each photon, [photon]. Patch `count()` contains no place. Throws
  /// as makePhotonMaps().
  std::vector<std::uint32_t> mapsOf(std::span<const device::Photon> photons) const;

  /// Sorts photons by patch and side. Throws as makePhotonMaps().
  PhotonMaps sort(std::span<const device::Photon> photons) const;

 private:
  void number(std::span<const std::uint32_t> roots);
  std::uint32_t regionOf(std::uint32_t triangle) const {
    return surface_.places[triangle].region & ~PRELIGHT_PLANAR_REGION;
  }
  std::vector<std::uint32_t> texelsAround(const LightMapTexel& place, bool& walled) const;
  void lookAround(std::span<const LightMapTexel> places, std::span<const std::uint32_t> indices,
                  std::vector<std::uint32_t>& patches) const;

  const CompiledScene& scene_;
  Tracer& tracer_;
  LightMapLayout layout_;
  const DensitySurface& surface_;
  TexelGrid grid_;
  std::uint32_t count_ = 0;             ///< number of patches
  std::vector<std::uint32_t> regions_;  ///< [patch - number of regions]
  std::vector<std::uint32_t> patchOf_;  ///< [texel of the layout]
};

}  // namespace prelight
