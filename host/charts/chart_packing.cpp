#include "charts/chart_packing.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "receivers/surface_sampler.h"
#include "scene/surface/triangles.h"

namespace prelight {

namespace {

// Cells of the bitmap in which places are searched.
constexpr std::size_t mostBitmapCells = std::size_t{1} << 20;
// Up to so many masks are packed several times, and the best packing is kept.
constexpr std::size_t fewMasks = 600;

/// A mask in 64-bit words, at the granularity of the bitmap.
struct BitMask {
  int width = 0;
  int height = 0;
  int words = 0;                    ///< per row
  std::vector<std::uint64_t> bits;  ///< [row][word], least significant bit first

  std::uint64_t word(int row, int k) const {
    return bits[static_cast<std::size_t>(row) * static_cast<std::size_t>(words) +
                static_cast<std::size_t>(k)];
  }
};

BitMask bitsOf(const ChartMask& mask, int grain) {
  BitMask result;
  result.width = (mask.width + grain - 1) / grain;
  result.height = (mask.height + grain - 1) / grain;
  result.words = (result.width + 63) / 64;
  result.bits.assign(static_cast<std::size_t>(result.words) * static_cast<std::size_t>(result.height), 0);
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x) {
      if (mask.cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.width) +
                     static_cast<std::size_t>(x)] == 0)
        continue;
      const int column = x / grain, row = y / grain;
      result.bits[static_cast<std::size_t>(row) * static_cast<std::size_t>(result.words) +
                  static_cast<std::size_t>(column / 64)] |= std::uint64_t{1} << (column % 64);
    }
  return result;
}

/// The atlas during packing; it grows downwards.
class Bitmap {
 public:
  explicit Bitmap(int width) : width_(width), words_(static_cast<std::size_t>(width) / 64 + 2) {}

  /// Returns the first free place at or below row `from`.
  glm::ivec2 find(const BitMask& mask, int from) {
    for (int y = from;; ++y) {
      while (rows() < y + mask.height) bits_.resize(bits_.size() + words_, 0);
      for (int x = 0; x + mask.width <= width_; ++x)
        if (isFree(mask, x, y)) return {x, y};
    }
  }

  void take(const BitMask& mask, const glm::ivec2& at) {
    for (int row = 0; row < mask.height; ++row)
      for (int k = 0; k < mask.words; ++k) {
        const std::uint64_t bits = mask.word(row, k);
        const auto x = static_cast<std::size_t>(at.x + 64 * k);
        std::uint64_t* to = &bits_[static_cast<std::size_t>(at.y + row) * words_ + x / 64];
        to[0] |= bits << (x % 64);
        if (x % 64 != 0) to[1] |= bits >> (64 - x % 64);
      }
    used_ = std::max(used_, at.y + mask.height);
  }

  int usedRows() const { return used_; }

 private:
  int rows() const { return static_cast<int>(bits_.size() / words_); }

  std::uint64_t window(int y, std::size_t x) const {
    const std::uint64_t* from = &bits_[static_cast<std::size_t>(y) * words_ + x / 64];
    return x % 64 == 0 ? from[0] : from[0] >> (x % 64) | from[1] << (64 - x % 64);
  }

  bool isFree(const BitMask& mask, int x, int y) const {
    for (int row = 0; row < mask.height; ++row)
      for (int k = 0; k < mask.words; ++k)
        if ((window(y + row, static_cast<std::size_t>(x + 64 * k)) & mask.word(row, k)) != 0) return false;
    return true;
  }

  int width_;
  std::size_t words_;  ///< per row, one more than its texels need
  std::vector<std::uint64_t> bits_;
  int used_ = 0;
};

/// Returns the size class of a mask: where no place was found for one, none of its class is tried again.
std::size_t classOf(const BitMask& mask) {
  const auto log = [](int n) { return static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(n))); };
  return log(mask.width) * 32 + log(mask.height);
}

/// Returns nothing if the packing needs more than `mostRows` rows.
std::optional<MaskPacking> packInto(std::span<const BitMask> masks, std::span<const std::uint32_t> order,
                                    int width, std::int64_t mostRows) {
  Bitmap bitmap(width);
  MaskPacking packing{width, 0, std::vector<glm::ivec2>(masks.size())};
  std::array<int, 32 * 32> startRow{};
  for (const std::uint32_t i : order) {
    int& start = startRow[classOf(masks[i])];
    const glm::ivec2 at = bitmap.find(masks[i], start);
    start = at.y;
    bitmap.take(masks[i], at);
    if (bitmap.usedRows() > mostRows) return std::nullopt;
    packing.origins[i] = at;
  }
  packing.height = bitmap.usedRows();
  return packing;
}

std::vector<std::uint32_t> orderBy(std::span<const BitMask> masks, bool byHeight) {
  std::vector<std::uint32_t> order(masks.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const BitMask &m = masks[a], &n = masks[b];
    const auto area = [](const BitMask& mask) { return std::int64_t{mask.width} * mask.height; };
    if (byHeight) return m.height != n.height ? m.height > n.height : m.width > n.width;
    return area(m) != area(n) ? area(m) > area(n) : m.width > n.width;
  });
  return order;
}

}  // namespace

std::optional<MaskPacking> packMasks(std::span<const ChartMask> masks, int mostSide) {
  if (masks.empty()) return MaskPacking{1, 1, {}};
  std::size_t needed = 0;
  int widest = 1;
  for (const ChartMask& mask : masks) {
    needed +=
        mask.cells.size() - static_cast<std::size_t>(std::count(mask.cells.begin(), mask.cells.end(), 0));
    widest = std::max({widest, mask.width});
  }
  const auto most = static_cast<std::size_t>(mostSide);
  if (widest > mostSide || needed > most * most) return std::nullopt;
  int grain = 1;
  while (needed / static_cast<std::size_t>(grain * grain) > mostBitmapCells) grain *= 2;
  std::vector<BitMask> bits;
  bits.reserve(masks.size());
  double cells = 0.0;
  for (const ChartMask& mask : masks) {
    bits.push_back(bitsOf(mask, grain));
    for (const std::uint64_t word : bits.back().bits) cells += std::popcount(word);
  }
  const int least = (widest + grain - 1) / grain, limit = mostSide / grain;
  constexpr std::array<double, 8> widths = {1.05, 1.0, 1.02, 1.08, 1.12, 1.2, 1.3, 0.9};
  const std::size_t tries = masks.size() <= fewMasks ? widths.size() : 1;
  std::optional<MaskPacking> best;
  for (std::size_t i = 0; i < tries; ++i)
    for (const bool byHeight : {false, true}) {
      if (byHeight && tries == 1) continue;
      const int width = std::clamp(static_cast<int>(std::ceil(std::sqrt(cells) * widths[i])), least,
                                   std::max(least, limit));
      // Packings with as many texels as the best so far are given up early.
      const std::int64_t better = best ? (std::int64_t{best->width} * best->height - 1) / width : limit;
      std::optional<MaskPacking> packing =
          packInto(bits, orderBy(bits, byHeight), width, std::min<std::int64_t>(better, limit));
      if (packing) best = std::move(packing);
    }
  if (!best && tries == 1) best = packInto(bits, orderBy(bits, true), limit, limit);
  if (!best || best->height > limit) return std::nullopt;
  best->width *= grain;
  best->height *= grain;
  for (glm::ivec2& origin : best->origins) origin *= grain;
  return best;
}

namespace {

/// Distance, in texels, between a chart's edge and the centres of its outer texels: look-ups that the
/// hardware rounds to 1/256 of a texel then still meet no other chart.
constexpr double margin = 1.0 / 64.0;
/// Distance from a texel's centre, in texels, within which look-ups give it a noticeable weight.
constexpr double reachOfTexel = 0.999;
constexpr double noDistance = 1e30;

/// The texel centres along a side of `length` texels: their number, the scale of the side, and its start.
struct Span {
  int steps = 1;
  double scale = 1.0;  ///< factor of lengths in texels
  double start = 0.5;
};

Span spanOf(double length) {
  const double inner = 1.0 - 2.0 * margin;
  Span span;
  if (length <= inner) {
    span.start = 0.5 + 0.5 * (1.0 - length);
  } else if (length < 2.0) {
    span.steps = 2;
    span.start = 0.5 + 0.5 * (2.0 - length);
    if (length > 1.0 + inner) {
      span.scale = (1.0 + inner) / length;
      span.start = 0.5 + margin;
    }
  } else {
    span.steps = static_cast<int>(std::lround(length));
    span.scale = (span.steps - 2.0 * margin) / length;
    span.start = 0.5 + margin;
  }
  return span;
}

/// Returns true when a triangle reaches into the square of side 2 around a point, where look-ups meet that
/// texel (separating axes).
bool comesNear(const std::array<glm::dvec2, 3>& c, const glm::dvec2& centre) {
  for (int i = 0; i < 3; ++i) {
    const glm::dvec2 edge = c[(i + 1) % 3] - c[i];
    const glm::dvec2 normal(-edge.y, edge.x);
    const double reach = reachOfTexel * (std::abs(normal.x) + std::abs(normal.y));
    if (reach == 0.0) continue;
    double low = 1e300, high = -1e300;
    for (const glm::dvec2& p : c) {
      const double d = glm::dot(p - centre, normal);
      low = std::min(low, d);
      high = std::max(high, d);
    }
    if (low >= reach || high <= -reach) return false;
  }
  return true;
}

struct Nearest {
  double distance = noDistance;
  glm::dvec2 weights{1.0 / 3.0};  ///< barycentric weights of corners 1 and 2
};

/// Returns the nearest point of a triangle.
Nearest nearestOn(const std::array<glm::dvec2, 3>& c, const glm::dvec2& p) {
  const double area = cross(c[1] - c[0], c[2] - c[0]);
  if (std::abs(area) > 1e-12) {
    const double second = cross(p - c[0], c[2] - c[0]) / area, third = cross(c[1] - c[0], p - c[0]) / area;
    if (std::min({1.0 - second - third, second, third}) >= 0.0) return {0.0, {second, third}};
  }
  Nearest best;
  for (int i = 0; i < 3; ++i) {
    const int k = (i + 1) % 3;
    const glm::dvec2 edge = c[k] - c[i];
    const double squared = glm::dot(edge, edge);
    const double s = squared > 0.0 ? std::clamp(glm::dot(p - c[i], edge) / squared, 0.0, 1.0) : 0.0;
    const double distance = glm::distance(p, c[i] + s * edge);
    if (distance >= best.distance) continue;
    glm::dvec3 weights(0.0);
    weights[i] = 1.0 - s;
    weights[k] = s;
    best = {distance, {weights.y, weights.z}};
  }
  return best;
}

/// Finds the nearest triangle for every texel of a rectangle.
class TexelFinder {
 public:
  TexelFinder(int width, int height)
      : width_(width),
        height_(height),
        nearest_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
        triangle_(nearest_.size(), 0) {}

  void add(std::uint32_t triangle, const std::array<glm::dvec2, 3>& c) {
    const glm::dvec2 low = glm::min(c[0], glm::min(c[1], c[2])), high = glm::max(c[0], glm::max(c[1], c[2]));
    const auto first = [](double coordinate) {
      return std::max(0, static_cast<int>(std::floor(coordinate - 1.5)));
    };
    const auto last = [](double coordinate, int count) {
      return std::min(count - 1, static_cast<int>(std::ceil(coordinate + 0.5)));
    };
    for (int y = first(low.y); y <= last(high.y, height_); ++y)
      for (int x = first(low.x); x <= last(high.x, width_); ++x) {
        const glm::dvec2 centre(x + 0.5, y + 0.5);
        if (centre.x <= low.x - reachOfTexel || centre.x >= high.x + reachOfTexel ||
            centre.y <= low.y - reachOfTexel || centre.y >= high.y + reachOfTexel)
          continue;
        const std::size_t at =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
        if (nearest_[at].distance == 0.0 || !comesNear(c, centre)) continue;
        const Nearest found = nearestOn(c, centre);
        if (found.distance >= nearest_[at].distance) continue;
        nearest_[at] = found;
        triangle_[at] = triangle;
      }
  }

  void giveTo(ChartTexels& chart) const {
    chart.mask = {width_, height_, std::vector<std::uint8_t>(nearest_.size(), 0)};
    for (std::size_t at = 0; at < nearest_.size(); ++at) {
      if (nearest_[at].distance == noDistance) continue;
      chart.mask.cells[at] = 1;
      chart.places.push_back({static_cast<std::uint32_t>(at % static_cast<std::size_t>(width_)),
                              static_cast<std::uint32_t>(at / static_cast<std::size_t>(width_)),
                              triangle_[at], nearest_[at].weights});
    }
  }

 private:
  int width_, height_;
  std::vector<Nearest> nearest_;
  std::vector<std::uint32_t> triangle_;
};

/// Returns a chart all of whose corners are at the centre of one texel.
ChartTexels singleTexel(const LightMapChart& chart) {
  ChartTexels result;
  result.corners.assign(chart.corners.size(), glm::vec2(0.5f));
  std::uint32_t largest = 0;
  double largestArea = -1.0;
  for (std::uint32_t t = 0; t < chart.triangles.size(); ++t) {
    const glm::vec2* c = &chart.corners[3 * std::size_t{t}];
    const double area = std::abs(cross(glm::dvec2(c[1] - c[0]), glm::dvec2(c[2] - c[0])));
    if (area > largestArea) largest = t, largestArea = area;
  }
  result.places.push_back({0, 0, largest, glm::dvec2(1.0 / 3.0)});
  result.mask = {1, 1, {1}};
  return result;
}

}  // namespace

ChartTexels makeChartTexels(const LightMapChart& chart, double texelSize) {
  const glm::dvec2 size = chart.size / texelSize;
  if (std::max(size.x, size.y) < leastChartAcross) return singleTexel(chart);
  const Span across = spanOf(size.x), down = spanOf(size.y);
  ChartTexels result;
  result.corners.reserve(chart.corners.size());
  for (const glm::vec2& corner : chart.corners) {
    const glm::dvec2 p = glm::dvec2(corner) / texelSize;
    result.corners.emplace_back(across.start + across.scale * p.x, down.start + down.scale * p.y);
  }
  return findChartTexels(std::move(result.corners), across.steps + 1, down.steps + 1);
}

ChartTexels findChartTexels(std::vector<glm::vec2> corners, int width, int height) {
  ChartTexels result;
  result.corners = std::move(corners);
  TexelFinder finder(width, height);
  for (std::uint32_t t = 0; 3 * std::size_t{t} < result.corners.size(); ++t) {
    const glm::vec2* c = &result.corners[3 * std::size_t{t}];
    finder.add(t, {glm::dvec2(c[0]), glm::dvec2(c[1]), glm::dvec2(c[2])});
  }
  finder.giveTo(result);
  return result;
}

LightMapTexel texelOnMap(const CompiledScene& scene, const ChartTexels::Place& place, std::uint32_t face,
                         const glm::ivec2& origin, int width) {
  const glm::dvec2 b = keptOffEdges(scene, face % scene.triangleCount(), place.weights);
  const std::uint32_t x = static_cast<std::uint32_t>(origin.x) + place.x,
                      y = static_cast<std::uint32_t>(origin.y) + place.y;
  return {y * static_cast<std::uint32_t>(width) + x, face, static_cast<float>(b.x), static_cast<float>(b.y)};
}

}  // namespace prelight
