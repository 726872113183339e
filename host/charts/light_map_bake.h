#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/state_file.h"
#include "base/work_share.h"
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

  /// Adds the light that arrives at places of the surface to `values`, [texel][channel 3][coefficients]. Sets
  /// `hidden`, [texel], to 1 where a place lies inside an object, so that its values do not count.
  virtual void add(std::span<const LightMapTexel> texels, int coefficients, std::span<float> values,
                   std::span<std::uint8_t> hidden) = 0;

  /// As add(), averaged over the cells of whole texels, if that takes no more rays than add().
  virtual void addOverCells(std::span<const LightMapTexel> texels, const TexelCells& /*cells*/,
                            int coefficients, std::span<float> values, std::span<std::uint8_t> hidden) {
    add(texels, coefficients, values, hidden);
  }

  /// Returns true when the light has edges within texels that addOverCells() does not smooth. refine() then
  /// smooths them, at the few texels concerned and for more rays.
  virtual bool isSharp() const { return false; }

  /// Adds the difference between the mean over the cells of texels and the values of add() at their places.
  virtual void refine(std::span<const LightMapTexel> /*texels*/, const TexelCells& /*cells*/,
                      int /*coefficients*/, std::span<float> /*values*/) {}

  /// Returns the number of rays cast so far.
  virtual std::uint64_t rays() const = 0;
};

/// Returns a line for users that describes the map and its cost.
std::string noteOf(const LightMapLayout& layout, const LightMapReport& report);

/// Computes the values of a light map's texels block by block: first of all texels, then better ones of those
/// that sharp edges of light cross. Afterwards texels inside objects take their neighbours' values on the
/// chart, and seams are stitched.
class LightMapBake {
 public:
  /// Finds the layout's walls. `coefficients`: see LightMap. The scene, and the tracer of that scene, must
  /// outlive this object.
  LightMapBake(const CompiledScene& scene, Tracer& tracer, LightMapLayout layout, int coefficients);

  const LightMapLayout& layout() const { return map_.layout; }

  /// Computes all values. Completed blocks of both kinds are kept when it throws Interrupted.
  void run(std::span<LightMapPart* const> parts, Progress& progress);

  /// Returns, after run(), [texel of the layout][channel 3][coefficients]; hidden() marks the texels that lie
  /// inside objects.
  std::vector<float> values() const;
  const std::vector<std::uint8_t>& hidden() const { return hidden_; }

  /// Returns the number of rays that run() has cast, without those that parts had cast before, such as
  /// photons.
  std::uint64_t rays() const { return rays_; }

  /// Saves and loads the progress of a bake that continues later.
  void save(StateWriter& state) const;
  void load(StateReader& state);

  /// Returns the finished map, after run(). Seams are edges below the crease angle, radians. `filter`, if
  /// given, processes the texels before seams are stitched; texels inside objects then take the filtered
  /// values of their neighbours.
  LightMap finish(double creaseAngle, LightMapReport& report,
                  const std::function<void(LightMap&)>& filter = {},
                  const Progress& progress = Progress()) const;

 private:
  /// Calls addBlock(loop, size) for blocks of texels until `done` is `count`.
  template <typename AddBlock>
  void runBlocks(WorkPart& kept, const char* stage, Progress& progress, std::uint64_t& done,
                 std::size_t count, const AddBlock& addBlock);
  void addBlock(SharedLoop& loop, std::span<LightMapPart* const> parts, const TexelCells& cells,
                std::size_t first, std::size_t size);
  void refineBlock(SharedLoop& loop, std::span<LightMapPart* const> parts, const TexelCells& cells,
                   std::span<const std::uint32_t> edges);
  static constexpr std::size_t fewestAtOnce = 64;

  std::vector<std::uint32_t> edges() const;
  std::size_t length() const { return 3 * static_cast<std::size_t>(map_.coefficients); }

  const CompiledScene& scene_;
  Tracer& tracer_;
  LightMap map_;
  std::vector<std::uint8_t> hidden_;  ///< [index in layout.texels]
  /// [index in layout.texels] irradiance of sharp parts, summed over channels.
  std::vector<float> sharp_;
  std::uint64_t done_ = 0;          ///< finished texels of layout.texels
  std::uint64_t refined_ = 0;       ///< finished texels of edges()
  std::vector<float> corrections_;  ///< [finished texel of edges()][channel 3][coefficients], to be added
  std::uint64_t atOnce_ = fewestAtOnce;  ///< texels of the current block, by which parts keep their state
  std::uint64_t rays_ = 0;               ///< rays that run() has cast
};

/// Keeps only the first `coefficients` coefficients of a map's values.
void keepCoefficients(LightMap& map, int coefficients);

}  // namespace prelight
