#include "fit/texel_fill.h"

#include <algorithm>
#include <vector>

namespace prelight {

namespace {

class TexelFiller {
 public:
  TexelFiller(int width, int height, std::size_t length, std::span<std::uint8_t> filled,
              std::span<float> values, std::span<const std::uint32_t> groups)
      : width_(width), height_(height), length_(length), filled_(filled), values_(values), groups_(groups) {}

  void run() {
    std::vector<std::size_t> ring = emptyBesideFilled();
    while (!ring.empty()) {
      for (const std::size_t texel : ring) takeMean(texel);
      // Texels of a ring are marked together, so that they do not use one another.
      for (const std::size_t texel : ring) filled_[texel] = 1;
      ring = emptyAround(ring);
    }
  }

 private:
  /// Calls `visit` with each neighbouring texel of the same group.
  template <typename Visitor>
  void forNeighbours(std::size_t texel, const Visitor& visit) const {
    const int column = static_cast<int>(texel) % width_, row = static_cast<int>(texel) / width_;
    for (int r = std::max(0, row - 1); r <= std::min(height_ - 1, row + 1); ++r)
      for (int c = std::max(0, column - 1); c <= std::min(width_ - 1, column + 1); ++c)
        if (r != row || c != column) {
          const auto other = static_cast<std::size_t>(r * width_ + c);
          if (groups_.empty() || groups_[other] == groups_[texel]) visit(other);
        }
  }

  std::vector<std::size_t> emptyBesideFilled() const {
    std::vector<std::size_t> empty;
    for (std::size_t texel = 0; texel < filled_.size(); ++texel) {
      bool beside = false;
      if (!filled_[texel])
        forNeighbours(texel, [&](std::size_t other) { beside = beside || filled_[other] != 0; });
      if (beside) empty.push_back(texel);
    }
    return empty;
  }

  std::vector<std::size_t> emptyAround(const std::vector<std::size_t>& ring) const {
    std::vector<std::size_t> empty;
    for (const std::size_t texel : ring)
      forNeighbours(texel, [&](std::size_t other) {
        if (!filled_[other]) empty.push_back(other);
      });
    std::sort(empty.begin(), empty.end());
    empty.erase(std::unique(empty.begin(), empty.end()), empty.end());
    return empty;
  }

  void takeMean(std::size_t texel) {
    float count = 0.0f;
    const auto own = values_.subspan(texel * length_, length_);
    std::fill(own.begin(), own.end(), 0.0f);
    forNeighbours(texel, [&](std::size_t other) {
      if (!filled_[other]) return;
      count += 1.0f;
      for (std::size_t i = 0; i < length_; ++i) own[i] += values_[other * length_ + i];
    });
    for (float& value : own) value /= count;
  }

  int width_;
  int height_;
  std::size_t length_;
  std::span<std::uint8_t> filled_;
  std::span<float> values_;
  std::span<const std::uint32_t> groups_;
};

}  // namespace

void fillTexels(int width, int height, std::size_t length, std::span<std::uint8_t> filled,
                std::span<float> values, std::span<const std::uint32_t> groups) {
  TexelFiller(width, height, length, filled, values, groups).run();
}

}  // namespace prelight
