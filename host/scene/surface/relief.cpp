#include "scene/surface/relief.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"

namespace prelight {

namespace {

using std::numbers::pi;

/// Returns the mean slopes of the texels of each cell: rise along the tangent and along the bitangent, which
/// points up in the texture.
std::vector<glm::dvec2> slopesOf(const Image& normals, double scale, int width, int height) {
  constexpr double steepest = 20.0;
  std::vector<glm::dvec2> slopes(static_cast<std::size_t>(width * height));
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const int left = column * normals.width / width, right = (column + 1) * normals.width / width;
      const int top = row * normals.height / height, bottom = (row + 1) * normals.height / height;
      glm::dvec2 sum(0.0);
      for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x) {
          const std::uint8_t* texel = &normals.rgba[4 * static_cast<std::size_t>(y * normals.width + x)];
          const glm::dvec3 n = glm::dvec3(texel[0], texel[1], texel[2]) / 127.5 - 1.0;
          sum += glm::clamp(-scale * glm::dvec2(n) / std::max(n.z, 1e-3), -steepest, steepest);
        }
      slopes[static_cast<std::size_t>(row * width + column)] = sum / double((right - left) * (bottom - top));
    }
  return slopes;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

Relief::Relief(const Image& normals, const TextureRef& use, double scale)
    : width_(std::min(normals.width, mostCells)),
      height_(std::min(normals.height, mostCells)),
      repeatsAcross_(use.wrapS == WrapMode::Repeat),
      repeatsDown_(use.wrapT == WrapMode::Repeat) {
  integrate(slopesOf(normals, scale, width_, height_));
  findHorizons();
}

int Relief::columnOf(int column) const {
  return repeatsAcross_ ? (column % width_ + width_) % width_ : std::clamp(column, 0, width_ - 1);
}

int Relief::rowOf(int row) const {
  return repeatsDown_ ? (row % height_ + height_) % height_ : std::clamp(row, 0, height_ - 1);
}

/// Computes heights by least squares: between neighbours, heights differ by the mean of their slopes
/// (Poisson's equation, by conjugate gradients).
void Relief::integrate(const std::vector<glm::dvec2>& slopes) {
  const std::size_t count = slopes.size();
  const auto at = [&](int column, int row) {
    return static_cast<std::size_t>(rowOf(row) * width_ + columnOf(column));
  };
  const auto forEdges = [&](const auto& use) {
    for (int row = 0; row < height_; ++row)
      for (int column = 0; column < width_; ++column) {
        const std::size_t here = at(column, row), right = at(column + 1, row), down = at(column, row + 1);
        if (right != here) use(here, right, 0.5 * (slopes[here].x + slopes[right].x));
        if (down != here) use(here, down, -0.5 * (slopes[here].y + slopes[down].y));
      }
  };
  heights_.assign(count, 0.0);
  std::vector<double> residual(count, 0.0), product(count);
  forEdges([&](std::size_t a, std::size_t b, double rise) {
    residual[a] -= rise;
    residual[b] += rise;
  });
  std::vector<double> direction = residual;
  double square = dot(residual, residual);
  const double enough = 1e-12 * square;
  for (int step = 0; step < 4 * mostCells && square > enough; ++step) {
    std::fill(product.begin(), product.end(), 0.0);
    forEdges([&](std::size_t a, std::size_t b, double) {
      const double difference = direction[b] - direction[a];
      product[a] -= difference;
      product[b] += difference;
    });
    const double length = square / dot(direction, product);
    for (std::size_t i = 0; i < count; ++i) {
      heights_[i] += length * direction[i];
      residual[i] -= length * product[i];
    }
    const double next = dot(residual, residual);
    for (std::size_t i = 0; i < count; ++i) direction[i] = residual[i] + next / square * direction[i];
    square = next;
  }
}

double Relief::heightAt(double column, double row) const {
  const double left = std::floor(column), top = std::floor(row), x = column - left, y = row - top;
  const int c = static_cast<int>(left), r = static_cast<int>(top);
  const auto at = [&](int i, int j) {
    return heights_[static_cast<std::size_t>(rowOf(j) * width_ + columnOf(i))];
  };
  return (1.0 - y) * ((1.0 - x) * at(c, r) + x * at(c + 1, r)) +
         y * ((1.0 - x) * at(c, r + 1) + x * at(c + 1, r + 1));
}

/// Computes the horizons along each azimuth from samples at distances that grow by an eighth, up to half the
/// texture.
void Relief::findHorizons() {
  constexpr double first = 1.0, growth = 1.125;
  const double farthest = 0.5 * std::max(width_, height_);
  horizons_.resize(heights_.size() * azimuths);
  parallelRanges(static_cast<std::size_t>(height_), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row)
      for (int column = 0; column < width_; ++column)
        for (int k = 0; k < azimuths; ++k) {
          const double turn = 2.0 * pi * k / azimuths, x = std::cos(turn), y = -std::sin(turn);
          const std::size_t cell = row * static_cast<std::size_t>(width_) + static_cast<std::size_t>(column);
          double steepest = 0.0;
          for (double distance = first; distance <= farthest; distance *= growth)
            steepest = std::max(
                steepest,
                (heightAt(column + distance * x, double(row) + distance * y) - heights_[cell]) / distance);
          horizons_[cell * azimuths + static_cast<std::size_t>(k)] =
              static_cast<float>(steepest / std::sqrt(1.0 + steepest * steepest));
        }
  });
}

const float* Relief::horizonAt(const glm::dvec2& uv) const {
  constexpr double most = 1e8;  // beyond it, integers overflow
  const glm::dvec2 place = glm::clamp(uv * glm::dvec2(width_, height_), -most, most);
  const int column = columnOf(static_cast<int>(std::floor(place.x))),
            row = rowOf(static_cast<int>(std::floor(place.y)));
  return &horizons_[static_cast<std::size_t>((row * width_ + column) * azimuths)];
}

}  // namespace prelight
