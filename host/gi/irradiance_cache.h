#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "gi/final_gather.h"
#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"
#include "shared/gather_types.h"

namespace prelight {

/// Irradiance at a place, with its derivatives.
struct CachedIrradiance {
  glm::vec3 position{0.0f};
  glm::vec3 normal{0.0f};  ///< unit
  device::GatherRecord light{};
};

/// Accuracy of an irradiance cache.
struct IrradianceCacheOptions {
  /// A of Ward et al. 1988: the reach of a record over the harmonic mean distance of the surfaces that it
  /// sees.
  double error = 0.3;
  double leastReach = 0.0;  ///< m, > 0
  double mostReach = 0.0;   ///< m, >= leastReach
};

/// Irradiance of diffuse surfaces, interpolated between records (Ward, Rubinstein and Clear 1988) along their
/// gradients (Ward and Heckbert 1992). A record reaches at most to where its gradient would double or
/// extinguish its light, and not much farther than its neighbours do, so that details that it missed itself
/// are respected (Krivanek et al. 2006).
class IrradianceCache {
 public:
  explicit IrradianceCache(const IrradianceCacheOptions& options) : options_(options) {}

  void add(std::span<const CachedIrradiance> records);

  /// Returns irradiance, W/m2, or nothing where no record reaches. The order of the records matters only for
  /// rounding.
  std::optional<glm::vec3> at(const glm::vec3& position, const glm::vec3& normal) const;
  bool covers(const glm::vec3& position, const glm::vec3& normal) const;

  std::size_t size() const { return records_.size(); }
  /// Returns the reach of a record, m; records are numbered in order of addition.
  double reach(std::size_t record) const { return records_[record].reach; }

 private:
  struct Record {
    CachedIrradiance cached;
    double reach = 0.0;
  };
  /// Records of similar reach, in the cells of a grid that they reach into.
  struct Level {
    double cell = 0.0;  ///< m
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells;
  };

  double reachOf(const device::GatherRecord& light) const;
  double weight(const Record& record, const glm::vec3& position, const glm::vec3& normal) const;
  template <typename Visit>
  void visitNear(const glm::vec3& position, const Visit& visit) const;
  void sortIn();
  void clampToNeighbours();

  IrradianceCacheOptions options_;
  std::vector<Record> records_;
  std::vector<Level> levels_;
};

/// Casts rays stratified in both angles and makes records for an irradiance cache of them.
class RecordGather final : public GatherPattern {
 public:
  explicit RecordGather(const FinalGather& gather);

  void makeRays(const GatherBlock& block) override;
  void meet(const GatherBlock& block) override;
  void sum(const GatherBlock& block) override;

  /// Takes the records of all blocks so far, [receiver].
  std::vector<device::GatherRecord> take() { return std::exchange(records_, {}); }

 private:
  std::vector<device::GatherRecord> records_;
  Buffer<float> distances_;
  Buffer<device::GatherRecord> recordBuffer_;
  using Parameters = Buffer<device::GatherParameters>;
  using Receivers = Buffer<device::Receiver>;
  Kernel<Parameters, Receivers, Buffer<device::Ray>> generate_;
  Kernel<std::uint32_t, Buffer<device::Hit>, Buffer<float>> store_;
  Kernel<Parameters, Receivers, Buffer<float>, Buffer<float>, Buffer<device::GatherRecord>> sum_;
};

/// Options of gatherCached().
struct CachedGatherRequest {
  std::uint32_t rays = 128;  ///< rays per record, a power of two, at least 8
  std::uint64_t seed = 0;
  std::uint32_t width = 1;  ///< width of the map whose texels the places are
  IrradianceCacheOptions cache;
};

/// Returns the irradiance at texels, W/m2, [place], gathered at some texels and interpolated at the others:
/// first at those of a coarse grid, then, on finer grids, at texels that no record reaches. `records`
/// receives the number of texels gathered at.
std::vector<glm::vec3> gatherCached(FinalGather& gather, const CompiledScene& compiled,
                                    std::span<const LightMapTexel> places, const CachedGatherRequest& request,
                                    Progress& progress, std::size_t& records);

}  // namespace prelight
