#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/state_file.h"
#include "charts/texel_cells.h"
#include "gpu/tracer.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"
#include "prelight/progress.h"

namespace prelight {

/// A share of the light in a light map: direct, caustic, indirect.
class LightMapPart {
 public:
  virtual ~LightMapPart() = default;

  /// Adds to `values`, [texel][channel 3][coefficients], what arrives at places of the surface. `hidden`,
  /// [texel], becomes 1 where a place lies inside an object, so that nothing that is seen there counts.
  virtual void add(std::span<const LightMapTexel> texels, int coefficients, std::span<float> values,
                   std::span<std::uint8_t> hidden) = 0;

  /// The same over the cells of whole texels, where that takes no more rays than at their places.
  virtual void addOverCells(std::span<const LightMapTexel> texels, const TexelCells& /*cells*/,
                            int coefficients, std::span<float> values, std::span<std::uint8_t> hidden) {
    add(texels, coefficients, values, hidden);
  }

  /// Whether its light has edges within texels that addOverCells() does not smooth: refine() does, at the few
  /// texels where they are, for more rays.
  virtual bool isSharp() const { return false; }

  /// Adds by how much the mean over the cells of texels exceeds what add() finds at their places.
  virtual void refine(std::span<const LightMapTexel> /*texels*/, const TexelCells& /*cells*/,
                      int /*coefficients*/, std::span<float> /*values*/) {}

  /// Cast so far.
  virtual std::uint64_t rays() const = 0;
};

/// A line that tells people what the map is and what it took.
std::string noteOf(const LightMapLayout& layout, const LightMapReport& report);

/// The values of a light map's texels, block by block: first of all of them, then better ones of those that
/// sharp edges of light cross. Afterwards texels inside objects take after their neighbours on the chart, and
/// seams are stitched.
class LightMapBake {
 public:
  /// Finds the layout's walls. `coefficients`: see LightMap. The scene, which the tracer was made of, and the
  /// tracer outlive it.
  LightMapBake(const CompiledScene& scene, Tracer& tracer, LightMapLayout layout, int coefficients);

  const LightMapLayout& layout() const { return map_.layout; }

  /// Blocks are kept, of both kinds. Throws Interrupted.
  void run(std::span<LightMapPart* const> parts, Progress& progress);

  /// After run(): [texel of the layout][channel 3][coefficients], and which texels lie inside objects.
  std::vector<float> values() const;
  const std::vector<std::uint8_t>& hidden() const { return hidden_; }

  /// Rays that run() has cast. What parts had cast before, such as photons, is not among them.
  std::uint64_t rays() const { return rays_; }

  /// What is done, for a bake that will go on later.
  void save(StateWriter& state) const;
  void load(StateReader& state);

  /// After run(). Seams are edges below the crease angle, radians. `filter`, if there is one, works on what
  /// texels hold before seams are stitched; texels inside objects then take after what it left.
  LightMap finish(double creaseAngle, LightMapReport& report,
                  const std::function<void(LightMap&)>& filter = {},
                  const Progress& progress = Progress()) const;

 private:
  void addBlock(std::span<LightMapPart* const> parts, const TexelCells& cells, std::size_t first,
                std::size_t size);
  void refineBlock(std::span<LightMapPart* const> parts, const TexelCells& cells,
                   std::span<const std::uint32_t> edges);
  static constexpr std::size_t fewestAtOnce = 64;

  std::vector<std::uint32_t> edges() const;
  std::size_t length() const { return 3 * static_cast<std::size_t>(map_.coefficients); }

  const CompiledScene& scene_;
  Tracer& tracer_;
  LightMap map_;
  std::vector<std::uint8_t> hidden_;  ///< [place of layout.texels]
  std::vector<float> sharp_;        ///< [place of layout.texels], irradiance of sharp parts, sum of channels
  std::uint64_t done_ = 0;          ///< texels of layout.texels
  std::uint64_t refined_ = 0;       ///< of edges()
  std::vector<float> corrections_;  ///< [of edges() so far][channel 3][coefficients], to be added
  std::uint64_t atOnce_ = fewestAtOnce;  ///< texels of the block at hand, which parts inside are kept by
  std::uint64_t rays_ = 0;               ///< that run() has cast
};

/// Leaves the first coefficients of a map's values, as many as are given.
void keepCoefficients(LightMap& map, int coefficients);

}  // namespace prelight
