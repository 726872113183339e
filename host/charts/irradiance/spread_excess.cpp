#include "charts/irradiance/spread_excess.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "charts/texel_grid.h"
#include "charts/wall_search.h"

namespace prelight {
namespace {

constexpr int reach = 8;  ///< texels
/// Sum of weights with which the excess of a texel counts in full.
constexpr float leastWeight = 16.0f;

/// A texel that shares in the excess of another, and its weight.
struct Sharer {
  std::uint32_t index = 0;
  float weight = 0.0f;
};

/// Finds who shares in a texel's excess.
class SharersAround {
 public:
  explicit SharersAround(const LightMapLayout& layout) : grid_(layout), patches_(wallPatches(layout)) {}

  /// Returns the sum of the weights of those who share.
  float find(std::uint32_t index, std::vector<Sharer>& sharers) const {
    sharers.clear();
    float sum = 0.0f;
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x) {
        const std::uint32_t other = grid_.neighbour(index, {x, y});
        const float falling =
            1.0f - static_cast<float>(x * x + y * y) / static_cast<float>(reach * reach + 1);
        if (other == TexelGrid::none || patches_[other] != patches_[index] || falling <= 0.0f) continue;
        sharers.push_back({other, falling * falling});
        sum += sharers.back().weight;
      }
    return sum;
  }

 private:
  TexelGrid grid_;
  std::vector<std::uint32_t> patches_;  ///< [texel of the layout]
};

}  // namespace

void spreadExcess(const LightMapLayout& layout, std::span<const glm::vec3> excess,
                  std::span<glm::vec3> irradiance) {
  const SharersAround around(layout);
  std::vector<Sharer> sharers;
  for (std::uint32_t i = 0; i < excess.size(); ++i) {
    if (excess[i] == glm::vec3(0.0f)) continue;
    const float sum = around.find(i, sharers);
    const glm::vec3 share = excess[i] / std::max(sum, leastWeight);
    for (const Sharer& sharer : sharers) irradiance[sharer.index] += share * sharer.weight;
  }
}

}  // namespace prelight
