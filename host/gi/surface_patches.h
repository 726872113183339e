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

/// Regions of a surface in patches that walls part, so that photons on one side of a wall do not count on the
/// other. Patches are told by the walls of a light map: its texels on one patch see each other in steps along
/// the surface. A region that nothing parts is a patch, whose number is the region's.
class SurfacePatches {
 public:
  /// The scene, which the tracer was made of, the tracer and the density surface outlive it.
  SurfacePatches(const CompiledScene& scene, Tracer& tracer, LightMapLayout layout,
                 const DensitySurface& surface);
  SurfacePatches(const SurfacePatches&) = delete;
  SurfacePatches& operator=(const SurfacePatches&) = delete;

  const LightMapLayout& layout() const { return layout_; }

  std::uint32_t count() const { return count_; }

  /// The region that a patch is of.
  std::uint32_t regionOfPatch(std::uint32_t patch) const {
    return patch < surface_.regionCount() ? patch : regions_[patch - surface_.regionCount()];
  }

  /// Whether every region is one patch.
  bool areRegions() const { return count_ == surface_.regionCount(); }

  /// [place] the patch that a place of the surface lies on, for DensityQuery. Between texels that a wall
  /// parts it is the patch of the nearest of them that the place sees; one that sees none lies on a patch of
  /// its own.
  std::vector<std::uint32_t> at(std::span<const LightMapTexel> places) const;

  /// [photon] 2 patch, and 1 more on the back; patch `count()` is of no place. Throws as makePhotonMaps().
  std::vector<std::uint32_t> mapsOf(std::span<const device::Photon> photons) const;

  /// Photons sorted by patch and side. Throws as makePhotonMaps().
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
  std::uint32_t count_ = 0;             ///< of patches
  std::vector<std::uint32_t> regions_;  ///< [patch - regions]
  std::vector<std::uint32_t> patchOf_;  ///< [texel of the layout]
};

}  // namespace prelight
