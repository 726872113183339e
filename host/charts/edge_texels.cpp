#include "charts/edge_texels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace prelight {

namespace {

constexpr double leastStep = 0.04;     // share of all light at the brighter of two texels
constexpr double darkestLight = 0.01;  // share of the map's mean; steps between darker texels are not visible

class EdgeFinder {
 public:
  EdgeFinder(const LightMapLayout& layout, const TexelLight& light)
      : layout_(layout), light_(light), indexOf_(layout.texelCount(), nothing) {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < layout.texels.size(); ++i) {
      indexOf_[layout.texels[i].texel] = i;
      sum += double(light.all[i]);
    }
    dark_ = darkestLight * sum / static_cast<double>(std::max<std::size_t>(layout.texels.size(), 1));
  }

  bool isEdge(std::uint32_t i) const {
    const LightMapTexel& texel = layout_.texels[i];
    if (!texel.whole || light_.hidden[i] != 0) return false;
    const int width = layout_.width, x = static_cast<int>(texel.texel) % width,
              y = static_cast<int>(texel.texel) / width;
    for (int row = std::max(0, y - 1); row <= std::min(layout_.height - 1, y + 1); ++row)
      for (int column = std::max(0, x - 1); column <= std::min(width - 1, x + 1); ++column)
        if (differs(i, indexOf_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                                static_cast<std::size_t>(column)]))
          return true;
    return false;
  }

 private:
  static constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();

  bool differs(std::uint32_t i, std::uint32_t other) const {
    if (other == nothing || light_.hidden[other] != 0) return false;
    if (layout_.chartOf[layout_.texels[i].face] != layout_.chartOf[layout_.texels[other].face]) return false;
    const double step = std::abs(double(light_.sharp[i]) - double(light_.sharp[other]));
    return step > leastStep * std::max({double(light_.all[i]), double(light_.all[other]), dark_});
  }

  const LightMapLayout& layout_;
  const TexelLight& light_;
  std::vector<std::uint32_t> indexOf_;  ///< [texel of the map] index in layout.texels, or `nothing`
  double dark_ = 0.0;
};

}  // namespace

std::vector<std::uint32_t> edgeTexels(const LightMapLayout& layout, const TexelLight& light) {
  const EdgeFinder finder(layout, light);
  std::vector<std::uint32_t> edges;
  for (std::uint32_t i = 0; i < layout.texels.size(); ++i)
    if (finder.isEdge(i)) edges.push_back(i);
  return edges;
}

}  // namespace prelight
