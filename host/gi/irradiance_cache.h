#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "shared/gather_types.h"

namespace prelight {

/// Irradiance at a place, and how it changes around it.
struct CachedIrradiance {
  glm::vec3 position{0.0f};
  glm::vec3 normal{0.0f};  ///< unit
  device::GatherRecord light{};
};

struct IrradianceCacheOptions {
  double error =
      0.3;  ///< a of Ward et al. 1988: records reach so far, in harmonic mean distances of what they see
  double leastReach = 0.0;  ///< m, > 0
  double mostReach = 0.0;   ///< m, >= leastReach
};

/// Irradiance of diffuse surfaces, interpolated between records (Ward, Rubinstein and Clear 1988) along their
/// gradients (Ward and Heckbert 1992). Records reach no farther than where their gradient would double or
/// extinguish their light, and not much farther than their neighbours do, so that what one of them has missed
/// is not ignored (Krivanek et al. 2006).
class IrradianceCache {
 public:
  explicit IrradianceCache(const IrradianceCacheOptions& options) : options_(options) {}

  void add(std::span<const CachedIrradiance> records);

  /// W/m2; none where no record reaches. Does not depend on the order of the records but by rounding.
  std::optional<glm::vec3> at(const glm::vec3& position, const glm::vec3& normal) const;
  bool covers(const glm::vec3& position, const glm::vec3& normal) const;

  std::size_t size() const { return records_.size(); }
  /// m, of a record in the order in which they were added.
  double reach(std::size_t record) const { return records_[record].reach; }

 private:
  struct Record {
    CachedIrradiance cached;
    double reach = 0.0;
  };
  /// Records of like reach, by the cells of a grid that they reach into.
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

}  // namespace prelight
