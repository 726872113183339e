#include "scene/compile/texture_means.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/colour.h"
#include "scene/compile/compile_parts.h"
#include "scene/surface/triangles.h"

namespace prelight {

namespace {

constexpr int blockTexels = 32;    ///< texels per block of Level::blockSums
constexpr int finestSquare = 4;    ///< texels per side of the squares of the finest bounds
constexpr int mostSquares = 8;     ///< greatest number of squares per side that are read for one bound
constexpr double farthest = 1e12;  ///< texels from the image's corner
constexpr double leastShare =
    1e-9;  ///< least area of a triangle, as a share of its squared extent, for it to be integrated
constexpr int samplesASide = 32;
constexpr int shrinking = 4;  ///< ratio of the sides of successive levels

/// Returns linear values as devices store them, [byte].
const std::array<double, 256>& linearBytes() {
  static const std::array<double, 256> table = [] {
    std::array<double, 256> linear{};
    for (std::size_t byte = 0; byte < linear.size(); ++byte)
      linear[byte] = std::round(65535.0 * linearFromSrgb(static_cast<std::uint8_t>(byte))) / 65535.0;
    return linear;
  }();
  return table;
}

int wrapped(double i, int size, WrapMode mode) {
  if (mode == WrapMode::ClampToEdge) return static_cast<int>(std::clamp(i, 0.0, size - 1.0));
  const double period = mode == WrapMode::MirroredRepeat ? 2.0 * size : size;
  const int at = static_cast<int>(i - period * std::floor(i / period));
  return at < size ? at : static_cast<int>(period) - 1 - at;
}

/// Returns the wrapped texels of an axis for the texels `first` to `last`: ranges that include both ends.
std::vector<std::array<int, 2>> wrappedRanges(double first, double last, int size, WrapMode mode) {
  if (mode == WrapMode::ClampToEdge) return {{wrapped(first, size, mode), wrapped(last, size, mode)}};
  if (last - first + 1.0 >= (mode == WrapMode::MirroredRepeat ? 2.0 : 1.0) * size) return {{0, size - 1}};
  std::vector<std::array<int, 2>> ranges;
  for (double at = first; at <= last;) {
    const double end = std::min(last, (std::floor(at / size) + 1.0) * size - 1.0);
    const int a = wrapped(at, size, mode), b = wrapped(end, size, mode);
    ranges.push_back({std::min(a, b), std::max(a, b)});
    at = end + 1.0;
  }
  return ranges;
}

/// First and last grid line beyond which texels repeat for ever, so that nothing changes.
struct Lines {
  double first = -std::numeric_limits<double>::infinity(), last = -first;
};

Lines linesOf(WrapMode mode, int size) {
  return mode == WrapMode::ClampToEdge ? Lines{0.0, double(size)} : Lines{};
}

double linesAcross(double way, const Lines& lines) { return std::min(way, lines.last - lines.first + 1.0); }

/// Iterates over the positions along an edge, as shares of it, at which the edge crosses the lines of a grid.
class Crossings {
 public:
  Crossings(double from, double way, const Lines& lines) : from_(from), way_(way), lines_(lines) {
    line_ = way > 0.0 ? std::max(std::floor(from) + 1.0, lines.first)
                      : std::min(std::ceil(from) - 1.0, lines.last);
  }

  double next() const {
    const bool any = way_ != 0.0 && line_ >= lines_.first && line_ <= lines_.last;
    return any ? (line_ - from_) / way_ : 2.0;
  }
  void pass() { line_ += way_ > 0.0 ? 1.0 : -1.0; }

 private:
  double from_, way_, line_ = 0.0;
  Lines lines_;
};

}  // namespace

TextureMeans::TextureMeans(const Image& image, const TextureRef& use)
    : image_(image), use_(use), middle_(use.filter == TextureFilter::Nearest ? 0.0 : 0.5) {
  levels_.push_back({image.width, image.height, {}, {}, {}, 0});
  sumRows(levels_.back());
  boundLuminance();
}

glm::dvec3 TextureMeans::texel(const Level& level, int column, int row) const {
  const std::size_t at = static_cast<std::size_t>(row) * static_cast<std::size_t>(level.width) +
                         static_cast<std::size_t>(column);
  if (!level.texels.empty()) return glm::dvec3(level.texels[at]);
  const std::uint8_t* rgba = &image_.rgba[4 * at];
  const std::array<double, 256>& linear = linearBytes();
  return {linear[rgba[0]], linear[rgba[1]], linear[rgba[2]]};
}

glm::dvec3 TextureMeans::wrappedTexel(const Level& level, double column, double row) const {
  return texel(level, wrapped(column, level.width, use_.wrapS), wrapped(row, level.height, use_.wrapT));
}

void TextureMeans::sumRows(Level& level) const {
  level.blocksARow = static_cast<std::size_t>((level.width + blockTexels - 1) / blockTexels);
  level.blockSums.reserve(level.blocksARow * static_cast<std::size_t>(level.height));
  for (int row = 0; row < level.height; ++row) {
    glm::dvec3 sum(0.0);
    for (int column = 0; column < level.width; ++column) {
      if (column % blockTexels == 0) level.blockSums.push_back(sum);
      sum += texel(level, column, row);
    }
    level.rowSums.push_back(sum);
  }
}

/// Adds the next smaller level, whose texels are the means of those that they cover; odd sizes cover some in
/// part.
void TextureMeans::addSmaller() {
  const Level& from = levels_.back();
  Level to{std::max(1, from.width / shrinking), std::max(1, from.height / shrinking), {}, {}, {}, 0};
  const double acrossX = double(from.width) / to.width, acrossY = double(from.height) / to.height;
  for (int row = 0; row < to.height; ++row)
    for (int column = 0; column < to.width; ++column) {
      glm::dvec3 sum(0.0);
      const double top = row * acrossY, bottom = top + acrossY, left = column * acrossX,
                   right = left + acrossX;
      for (int y = static_cast<int>(top); y < std::min(bottom, double(from.height)); ++y)
        for (int x = static_cast<int>(left); x < std::min(right, double(from.width)); ++x)
          sum += (std::min(bottom, y + 1.0) - std::max(top, double(y))) *
                 (std::min(right, x + 1.0) - std::max(left, double(x))) * texel(from, x, y);
      to.texels.emplace_back(sum / (acrossX * acrossY));
    }
  sumRows(to);
  levels_.push_back(std::move(to));
}

void TextureMeans::boundLuminance() {
  const auto squares = [](int texels, int side) { return (texels + side - 1) / side; };
  for (int side = finestSquare;; side *= 2) {
    Bounds bounds{side, squares(image_.width, side), squares(image_.height, side), {}};
    bounds.most.assign(static_cast<std::size_t>(bounds.columns) * static_cast<std::size_t>(bounds.rows),
                       0.0f);
    const auto grow = [&](int column, int row, float most) {
      float& bound = bounds.most[static_cast<std::size_t>(row) * static_cast<std::size_t>(bounds.columns) +
                                 static_cast<std::size_t>(column)];
      bound = std::max(bound, most);
    };
    if (bounds_.empty()) {
      for (int y = 0; y < image_.height; ++y)
        for (int x = 0; x < image_.width; ++x)
          grow(x / side, y / side, static_cast<float>(luminance(texel(levels_[0], x, y))));
    } else {
      const Bounds& finer = bounds_.back();
      for (int y = 0; y < finer.rows; ++y)
        for (int x = 0; x < finer.columns; ++x)
          grow(x / 2, y / 2,
               finer.most[static_cast<std::size_t>(y) * static_cast<std::size_t>(finer.columns) +
                          static_cast<std::size_t>(x)]);
    }
    bounds_.push_back(std::move(bounds));
    if (std::max(bounds_.back().columns, bounds_.back().rows) == 1) return;
  }
}

glm::dvec2 TextureMeans::placeIn(const Level& level, const glm::dvec2& point) const {
  return point * glm::dvec2(level.width, level.height) - middle_;
}

ImageCorners TextureMeans::placesIn(const Level& level, const ImageCorners& corners) const {
  return {placeIn(level, corners[0]), placeIn(level, corners[1]), placeIn(level, corners[2])};
}

/// Returns the sum of the texels of a wrapped row from 0 to before `column`; negative for columns below 0.
glm::dvec3 TextureMeans::sumBefore(const Level& level, double column, int row) const {
  const auto within = [&](int end) {  // [0, width]
    const auto first = static_cast<std::size_t>(row) * level.blocksARow;
    if (end == level.width) return level.rowSums[static_cast<std::size_t>(row)];
    glm::dvec3 sum = level.blockSums[first + static_cast<std::size_t>(end / blockTexels)];
    for (int i = end / blockTexels * blockTexels; i < end; ++i) sum += texel(level, i, row);
    return sum;
  };
  const glm::dvec3& all = level.rowSums[static_cast<std::size_t>(row)];
  const int width = level.width;
  if (use_.wrapS == WrapMode::ClampToEdge) {
    if (column < 0.0) return column * texel(level, 0, row);
    if (column > width) return all + (column - width) * texel(level, width - 1, row);
    return within(static_cast<int>(column));
  }
  const bool mirrored = use_.wrapS == WrapMode::MirroredRepeat;
  const double period = mirrored ? 2.0 * width : width;
  const double turns = std::floor(column / period);
  const int rest = static_cast<int>(column - turns * period);
  const glm::dvec3 whole = turns * (mirrored ? 2.0 : 1.0) * all;
  return rest <= width ? whole + within(rest) : whole + 2.0 * all - within(2 * width - rest);
}

/// Returns the integral along a row from texel `first` to x, which lies between texel `column` and the next
/// one.
glm::dvec3 TextureMeans::rowIntegral(const Level& level, double first, double column, double x,
                                     int row) const {
  const auto at = [&](double c) { return texel(level, wrapped(c, level.width, use_.wrapS), row); };
  const double f = x - column;
  const glm::dvec3 here = at(column), sum = sumBefore(level, column, row) - sumBefore(level, first, row);
  if (use_.filter == TextureFilter::Nearest) return sum + f * here;
  return sum + 0.5 * (here - at(first)) + f * here + 0.5 * f * f * (at(column + 1.0) - here);
}

/// Returns the integral over y, along an edge, of the colour's integral over x from texel `first` on. Between
/// the lines of the texel grid the integrand is of degree 3 along the edge, which two points of Gauss and
/// Legendre integrate exactly.
glm::dvec3 TextureMeans::alongEdge(const Level& level, const glm::dvec2& a, const glm::dvec2& b,
                                   double first) const {
  const glm::dvec2 way = b - a;
  glm::dvec3 sum(0.0);
  if (way.y == 0.0) return sum;
  Crossings columns(a.x, way.x, linesOf(use_.wrapS, level.width)),
      rows(a.y, way.y, linesOf(use_.wrapT, level.height));
  for (double from = 0.0; from < 1.0;) {
    const double to = std::min({columns.next(), rows.next(), 1.0});
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    const glm::dvec2 cell = glm::floor(a + middle * way);
    const int row = wrapped(cell.y, level.height, use_.wrapT);
    const int below = wrapped(cell.y + 1.0, level.height, use_.wrapT);
    for (const double side : {-std::numbers::inv_sqrt3, std::numbers::inv_sqrt3}) {
      if (!(half > 0.0)) break;
      const glm::dvec2 point = a + (middle + side * half) * way;
      glm::dvec3 value = rowIntegral(level, first, cell.x, point.x, row);
      if (use_.filter == TextureFilter::Linear)
        value = glm::mix(value, rowIntegral(level, first, cell.x, point.x, below), point.y - cell.y);
      sum += half * way.y * value;
    }
    if (columns.next() <= to) columns.pass();
    if (rows.next() <= to) rows.pass();
    from = to;
  }
  return sum;
}

glm::dvec3 TextureMeans::lookUp(const Level& level, const glm::dvec2& place) const {
  if (!std::isfinite(place.x) || !std::isfinite(place.y)) return glm::dvec3(0.0);
  const glm::dvec2 base = glm::floor(place), f = place - base;
  if (use_.filter == TextureFilter::Nearest) return wrappedTexel(level, base.x, base.y);
  const glm::dvec3 above =
      glm::mix(wrappedTexel(level, base.x, base.y), wrappedTexel(level, base.x + 1.0, base.y), f.x);
  const glm::dvec3 below = glm::mix(wrappedTexel(level, base.x, base.y + 1.0),
                                    wrappedTexel(level, base.x + 1.0, base.y + 1.0), f.x);
  return glm::mix(above, below, f.y);
}

glm::dvec3 TextureMeans::at(const glm::dvec2& point) const {
  return lookUp(levels_[0], placeIn(levels_[0], point));
}

/// Returns the mean over the centres of equal parts of the triangle.
glm::dvec3 TextureMeans::meanOfSamples(const ImageCorners& corners) const {
  glm::dvec3 sum(0.0);
  int count = 0;
  for (int row = 0; row < samplesASide; ++row)
    for (int column = 0; column + row < samplesASide; ++column)
      for (const double third : {1.0, 2.0}) {
        const double u = (column + third / 3.0) / samplesASide, v = (row + third / 3.0) / samplesASide;
        if (u + v > 1.0) continue;
        sum += at(corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]));
        ++count;
      }
  return sum / double(count);
}

glm::dvec3 TextureMeans::mean(const ImageCorners& corners, double outline) {
  for (std::size_t i = 0;; ++i) {
    const ImageCorners p = placesIn(levels_[i], corners);
    const glm::dvec2 a = glm::abs(p[1] - p[0]), b = glm::abs(p[2] - p[1]), c = glm::abs(p[0] - p[2]);
    const glm::dvec2 size = glm::max(a, glm::max(b, c)), low = glm::min(p[0], glm::min(p[1], p[2]));
    const double area = 0.5 * cross(p[1] - p[0], p[2] - p[0]), extent = std::max(size.x, size.y);
    const double reach = std::max({-low.x, -low.y, low.x + size.x, low.y + size.y});
    if (!(reach < farthest) || !(std::abs(area) > leastShare * extent * extent))
      return meanOfSamples(corners);
    const Lines columns = linesOf(use_.wrapS, levels_[i].width),
                rows = linesOf(use_.wrapT, levels_[i].height);
    double crossed = 0.0;
    for (const glm::dvec2& edge : {a, b, c})
      crossed += linesAcross(edge.x, columns) + linesAcross(edge.y, rows);
    if (crossed > outline) {
      if (std::max(levels_[i].width, levels_[i].height) == 1) return texel(levels_[i], 0, 0);
      if (i + 1 == levels_.size()) addSmaller();
      continue;
    }
    glm::dvec3 sum(0.0);
    for (std::size_t k = 0; k < 3; ++k) sum += alongEdge(levels_[i], p[k], p[(k + 1) % 3], std::floor(low.x));
    return glm::max(sum / area, 0.0);
  }
}

double TextureMeans::mostWithin(const std::array<int, 2>& columns, const std::array<int, 2>& rows) const {
  double most = 0.0;
  if (std::max(columns[1] - columns[0], rows[1] - rows[0]) < mostSquares) {
    for (int y = rows[0]; y <= rows[1]; ++y)
      for (int x = columns[0]; x <= columns[1]; ++x)
        most = std::max(most, luminance(texel(levels_[0], x, y)));
    return most;
  }
  const auto few = [&](const Bounds& b) {
    return std::max(columns[1] / b.side - columns[0] / b.side, rows[1] / b.side - rows[0] / b.side) <
           mostSquares;
  };
  const auto found = std::find_if(bounds_.begin(), bounds_.end(), few);
  const Bounds& b = found == bounds_.end() ? bounds_.back() : *found;
  for (int y = rows[0] / b.side; y <= rows[1] / b.side; ++y)
    for (int x = columns[0] / b.side; x <= columns[1] / b.side; ++x)
      most = std::max(most, double(b.most[static_cast<std::size_t>(y) * static_cast<std::size_t>(b.columns) +
                                          static_cast<std::size_t>(x)]));
  return most;
}

double TextureMeans::mostLuminance(const ImageCorners& corners) const {
  const Level& level = levels_[0];
  const ImageCorners p = placesIn(level, corners);
  const glm::dvec2 low = glm::min(p[0], glm::min(p[1], p[2])), high = glm::max(p[0], glm::max(p[1], p[2]));
  if (!(std::max({-low.x, -low.y, high.x, high.y}) < farthest))
    return mostWithin({0, level.width - 1}, {0, level.height - 1});
  const glm::dvec2 first = glm::floor(low), last = glm::floor(high) + 2.0 * middle_;
  // Between four texels, no point exceeds the corners of the triangle's box.
  if (middle_ > 0.0 && last == first + 1.0)
    return std::max({luminance(lookUp(level, low)), luminance(lookUp(level, high)),
                     luminance(lookUp(level, {low.x, high.y})), luminance(lookUp(level, {high.x, low.y}))});
  double most = 0.0;
  for (const auto& columns : wrappedRanges(first.x, last.x, level.width, use_.wrapS))
    for (const auto& rows : wrappedRanges(first.y, last.y, level.height, use_.wrapT))
      most = std::max(most, mostWithin(columns, rows));
  return most;
}

}  // namespace prelight
