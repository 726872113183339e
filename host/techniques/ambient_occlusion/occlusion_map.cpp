#include "techniques/ambient_occlusion/occlusion_map.h"

#include <memory>

#include "cast/hemisphere_column.h"
#include "charts/even_places.h"
#include "charts/light_map_bake.h"
#include "charts/spread_caster.h"
#include "gpu/tracer.h"
#include "plan/shadow_sets.h"
#include "receivers/surface_sampler.h"
#include "scene/surface/surface_regions.h"

namespace prelight {

namespace {

constexpr std::size_t errorPlaces = 2048;
constexpr std::uint64_t errorSeeds[] = {0x5eedu, 0xfeedu};  // added to the map's

/// Accessibility in place of light.
class OcclusionPart final : public LightMapPart {
 public:
  /// `setTracers`: [set - 1]. Everything outlives it.
  OcclusionPart(const CompiledScene& scene, Tracer& tracer, const ShadowSets& sets,
                std::span<Tracer> setTracers, const OcclusionMapRequest& request, std::uint64_t seed)
      : scene_(scene),
        sets_(sets),
        caster_(scene, tracer, castOptions(request, sets, setTracers), {&hemisphere_}, request.rays, seed) {}

  void add(std::span<const LightMapTexel> texels, int, std::span<float> values,
           std::span<std::uint8_t> hidden) override {
    addPlaces(texels, nullptr, values, hidden);
  }
  void addOverCells(std::span<const LightMapTexel> texels, const TexelCells& cells, int,
                    std::span<float> values, std::span<std::uint8_t> hidden) override {
    addPlaces(texels, &cells, values, hidden);
  }
  std::uint64_t rays() const override { return caster_.receivers() * caster_.caster().raysPerReceiver(); }

 private:
  static CastOptions castOptions(const OcclusionMapRequest& request, const ShadowSets& sets,
                                 std::span<Tracer> setTracers) {
    CastOptions options;
    options.limits = request.limits;
    options.sets = &sets;
    options.setTracers = setTracers;
    return options;
  }

  void addPlaces(std::span<const LightMapTexel> texels, const TexelCells* cells, std::span<float> values,
                 std::span<std::uint8_t> hidden) {
    for (std::uint32_t set = 0; set <= sets_.sets.size(); ++set) {
      std::vector<std::size_t> places;  // of the set's texels among all
      std::vector<LightMapTexel> some;
      for (std::size_t i = 0; i < texels.size(); ++i) {
        if (sets_.setOf(triangleOf(scene_, texels[i])) != set) continue;
        places.push_back(i);
        some.push_back(texels[i]);
      }
      std::vector<std::uint8_t> marks(some.size(), 0);
      caster_.cast(some, cells, set, marks,
                   [&](std::size_t texel, std::size_t r, float share, const CastRows& seen) {
                     const float open = hemisphere_.accessibility(seen, r);
                     for (std::size_t c = 0; c < 3; ++c) values[3 * places[texel] + c] += share * open;
                   });
      for (std::size_t i = 0; i < marks.size(); ++i)
        if (marks[i] != 0) hidden[places[i]] = 1;
    }
  }

  const CompiledScene& scene_;
  const ShadowSets& sets_;
  HemisphereColumn hemisphere_{0};
  SpreadCaster caster_;
};

}  // namespace

LightMap makeOcclusionMap(const CompiledScene& scene, const LightMapLayout& layout,
                          const OcclusionMapRequest& request, const Device& device, Progress& progress,
                          OcclusionMapReport& report) {
  const ShadowSets sets = makeShadowSets(scene, request.shadowSets);
  Tracer tracer(scene, device);
  std::vector<Tracer> setTracers;
  for (const ShadowSets::Occluders& set : sets.sets) setTracers.emplace_back(tracer, scene, set.triangles);
  const auto partOf = [&](std::uint64_t seed) {
    return std::make_unique<OcclusionPart>(scene, tracer, sets, setTracers, request, seed);
  };
  const auto part = partOf(request.seed);
  LightMapPart* parts[] = {part.get()};
  LightMapBake bake(scene, tracer, layout, 1);
  bake.run(parts, progress);
  LightMapReport made;
  LightMap map = bake.finish(usualCreaseAngle, made, {}, progress);
  const std::vector<LightMapTexel> places = evenPlaces(scene, layout, errorPlaces);
  FoundTwice found;
  found.hidden.assign(places.size(), 0);
  report.rays = made.rays;
  for (std::size_t i = 0; i < 2; ++i) {
    progress.check();
    const auto again = partOf(request.seed + errorSeeds[i]);
    found.values[i].assign(3 * places.size(), 0.0f);
    again->add(places, 1, found.values[i], found.hidden);
    report.rays += again->rays();
  }
  report.error = errorOfShown(map, places, found).rms;
  report.places = places.size();
  return map;
}

}  // namespace prelight
