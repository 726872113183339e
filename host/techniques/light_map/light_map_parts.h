#pragma once

#include "charts/light_map_bake.h"
#include "gi/indirect_light.h"
#include "gi/surface_patches.h"
#include "photon/density_estimator.h"

namespace prelight {

/// Indirect light of a light map.
class IndirectLightPart final : public LightMapPart {
 public:
  /// The arguments outlive it.
  IndirectLightPart(IndirectLight& light, Progress& progress) : light_(light), progress_(progress) {}

  void add(std::span<const LightMapTexel> texels, int coefficients, std::span<float> values,
           std::span<std::uint8_t> hidden) override;
  std::uint64_t rays() const override { return light_.rays(); }

 private:
  IndirectLight& light_;
  Progress& progress_;
};

/// What photons tell by their density, such as caustics.
class PhotonLightPart final : public LightMapPart {
 public:
  /// `patches`: that the estimator's photons are sorted by; `radius`: m, the largest of an estimate; `rays`:
  /// that the photons took. The arguments outlive it.
  PhotonLightPart(const CompiledScene& compiled, const SurfacePatches& patches, DensityEstimator& estimator,
                  double radius, std::uint64_t rays)
      : compiled_(compiled), patches_(patches), estimator_(estimator), radius_(radius), rays_(rays) {}

  void add(std::span<const LightMapTexel> texels, int coefficients, std::span<float> values,
           std::span<std::uint8_t> hidden) override;
  std::uint64_t rays() const override { return rays_; }

 private:
  const CompiledScene& compiled_;
  const SurfacePatches& patches_;
  DensityEstimator& estimator_;
  double radius_;
  std::uint64_t rays_;
};

}  // namespace prelight
