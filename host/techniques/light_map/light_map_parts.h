#pragma once

#include <cstdint>
#include <vector>

#include "cast/light_column.h"
#include "cast/light_groups.h"
#include "charts/hidden_light.h"
#include "charts/light_map_bake.h"
#include "charts/spread_caster.h"
#include "gi/indirect_light.h"
#include "gi/surface_patches.h"
#include "gpu/tracer.h"
#include "photon/density_estimator.h"
#include "prelight/picture.h"
#include "radiosity/direct_light.h"

/// The parts of which the light of a light map is added up.
namespace prelight {

/// Light that comes straight from emissive surfaces, by samples of these and of the hemisphere
/// (cast/light_column.h), and which texels lie inside objects. Textured emitters count with their mean
/// radiance.
class EmitterLightPart final : public LightMapPart {
 public:
  /// `lights`: of the scene, with an emitter. `rays`: of the hemisphere at each texel, a power of two, 16 and
  /// more. `coefficients`: of the map (LightMap). The scene and the tracer outlive it.
  EmitterLightPart(const CompiledScene& scene, Tracer& tracer, const GroupedLights& lights,
                   std::uint32_t rays, std::uint64_t seed, int coefficients = 1);

  void add(std::span<const LightMapTexel> texels, int coefficients, std::span<float> values,
           std::span<std::uint8_t> hidden) override;
  void addOverCells(std::span<const LightMapTexel> texels, const TexelCells& cells, int coefficients,
                    std::span<float> values, std::span<std::uint8_t> hidden) override;
  std::uint64_t rays() const override;

 private:
  void addPlaces(std::span<const LightMapTexel> texels, const TexelCells* cells, std::span<float> values,
                 std::span<std::uint8_t> hidden);

  GroupedLights lights_;
  LightColumn column_;
  SpreadCaster caster_;
  std::size_t coefficients_;
};

/// Light that comes straight from punctual lights: exact at a place, with sharp edges of shadows between
/// places.
class PointLightPart final : public LightMapPart {
 public:
  /// `lights`: of the scene, with a punctual one. `coefficients`: of the map (LightMap). The scene and the
  /// tracer outlive it.
  PointLightPart(const CompiledScene& scene, Tracer& tracer, const GroupedLights& lights,
                 int coefficients = 1);

  void add(std::span<const LightMapTexel> texels, int coefficients, std::span<float> values,
           std::span<std::uint8_t> hidden) override;
  bool isSharp() const override { return true; }
  void refine(std::span<const LightMapTexel> texels, const TexelCells& cells, int coefficients,
              std::span<float> values) override;
  std::uint64_t rays() const override { return caster_.rays(); }

 private:
  void addMeans(std::span<const LightMapTexel> texels, const TexelCells* cells, std::uint32_t perTexel,
                float factor, std::span<float> values);

  const CompiledScene& scene_;
  std::vector<LightGroup> groups_;
  PointLightCaster caster_;
  std::size_t coefficients_;
  std::vector<device::Receiver> receivers_;
  std::vector<float> cast_;
};

/// Light that comes straight from the sky.
class SkyLightPart final : public LightMapPart {
 public:
  /// `rays`: at each texel, rounded to whole samplings of 16. What is given outlives it. `rotation`: of the
  /// sky, radians, counter-clockwise seen from above.
  SkyLightPart(const CompiledScene& scene, Tracer& tracer, const Environment& sky, double rotation,
               std::uint32_t rays, std::uint64_t seed);

  void add(std::span<const LightMapTexel> texels, int coefficients, std::span<float> values,
           std::span<std::uint8_t> hidden) override;
  void addOverCells(std::span<const LightMapTexel> texels, const TexelCells& cells, int coefficients,
                    std::span<float> values, std::span<std::uint8_t> hidden) override;
  std::uint64_t rays() const override { return light_.rays(); }

 private:
  void addPlaces(std::span<const LightMapTexel> texels, const TexelCells* cells, int coefficients,
                 std::span<float> values);
  void addIrradiance(std::span<const device::Receiver> receivers, std::span<float> values);
  void addIncident(std::span<const device::Receiver> receivers, int coefficients, std::span<float> values);

  const CompiledScene& scene_;
  DirectLight light_;
  std::uint32_t repeats_;
  std::uint32_t seed_;
};

/// No light, but which texels lie inside objects, for maps without direct light, whose part tells it as well.
class InsidePart final : public LightMapPart {
 public:
  /// The scene and the tracer outlive it.
  InsidePart(const CompiledScene& scene, Tracer& tracer, std::uint64_t seed);

  void add(std::span<const LightMapTexel> texels, int coefficients, std::span<float> values,
           std::span<std::uint8_t> hidden) override;
  std::uint64_t rays() const override { return rays_; }

 private:
  HiddenPlaces places_;
  std::uint64_t rays_ = 0;
};

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

/// Light that is estimated from the density of photons, such as caustics.
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
