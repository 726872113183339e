#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "device/kernel.h"

namespace prelight {

/// A way to evaluate harmonics on a device, see lab/kernels/harmonic_sum_kernels.cl.
enum class HarmonicWay { Sh, Ch, ShMonic, ChMonic, ChPlain };

struct HarmonicWayName {
  HarmonicWay way;
  const char* name;
  bool isCh;
};

/// Returns all ways; each way of SH is followed by its counterparts of CH.
std::span<const HarmonicWayName> harmonicWays();

/// Returns arithmetic instructions per direction for the functions and their addition to sums. A fused
/// multiplication and addition counts as one.
int harmonicOperations(HarmonicWay way, int order);

/// A direction and the weight of the functions' values there.
struct WeightedDirection {
  glm::vec3 towards;
  float weight;
};

/// Sums of weight x function over blocks of directions, as a bake projects the rays of its receivers.
class HarmonicSums {
 public:
  static constexpr std::uint32_t blockSize = 64;

  /// The number of `directions` is a multiple of blockSize.
  HarmonicSums(DeviceContext& device, HarmonicWay way, int order,
               std::span<const WeightedDirection> directions);

  void run();                       ///< waits
  std::vector<float> sums() const;  ///< [block][order^2]

 private:
  DeviceContext& device_;
  std::uint32_t blocks_;
  Buffer<float> table_, norms_, directions_, sums_;
  Kernel<std::uint32_t, std::uint32_t, Buffer<float>, Buffer<float>, Buffer<float>, Buffer<float>> kernel_;
};

}  // namespace prelight
