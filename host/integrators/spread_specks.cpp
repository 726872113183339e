#include "integrators/spread_specks.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

#include "base/colour.h"

namespace prelight {
namespace {

constexpr int levelReach = 3, spreadReach = 6;  // pixels
constexpr double brighterShare = 0.2;           // of the pixels around a speck, at most, are as bright
constexpr double leastContrast = 1.5;           // of a speck and the light that it may keep
constexpr double mostTaken = 2.0;  // brighter pixels take no more than such a multiple of a speck

/// The pixels within a reach, a square that the picture's borders cut.
struct Window {
  int x0, x1, y0, y1;

  Window(const Picture& picture, int x, int y, int reach)
      : x0(std::max(x - reach, 0)),
        x1(std::min(x + reach, picture.width - 1)),
        y0(std::max(y - reach, 0)),
        y1(std::min(y + reach, picture.height - 1)) {}

  template <typename Visit>
  void each(int width, const Visit& visit) const {
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) visit(std::size_t(y) * std::size_t(width) + std::size_t(x));
  }
};

class SpeckSpreader {
 public:
  SpeckSpreader(std::span<const float> excess, const Picture& picture) : picture_(picture) {
    luminances_.reserve(picture.pixels.size());
    for (const glm::vec3& pixel : picture.pixels) {
      kept_.emplace_back(pixel);
      luminances_.push_back(luminance(glm::dvec3(pixel)));
    }
    for (std::size_t i = 0; i < kept_.size(); ++i) keepLess(i, double(excess[i]));
  }

  /// Returns the picture with what specks don't keep spread.
  std::vector<glm::dvec3> spread() const {
    std::vector<glm::dvec3> result = kept_;
    for (const std::size_t speck : specks_) give(speck, result);
    return result;
  }

 private:
  Window around(std::size_t i, int reach) const {
    const auto width = std::size_t(picture_.width);
    return {picture_, int(i % width), int(i / width), reach};
  }

  /// Returns the luminance that few pixels around exceed.
  double levelAround(std::size_t i) {
    window_.clear();
    around(i, levelReach).each(picture_.width, [&](std::size_t j) { window_.push_back(luminances_[j]); });
    const auto rank = window_.begin() + std::ptrdiff_t(brighterShare * double(window_.size()));
    std::nth_element(window_.begin(), rank, window_.end(), std::greater<>());
    return *rank;
  }

  void keepLess(std::size_t i, double excess) {
    const double whole = luminances_[i], alike = whole - excess;
    if (!(whole > leastContrast * alike)) return;
    const double kept = std::max(alike, levelAround(i));
    if (!(whole > leastContrast * kept)) return;
    kept_[i] *= std::max(kept, 0.0) / whole;
    specks_.push_back(i);
  }

  void give(std::size_t speck, std::vector<glm::dvec3>& result) const {
    const glm::dvec3 most = mostTaken * kept_[speck];
    glm::dvec3 sum(0.0);
    const Window window = around(speck, spreadReach);
    window.each(picture_.width, [&](std::size_t j) { sum += glm::min(kept_[j], most); });
    const glm::dvec3 given = glm::dvec3(picture_.pixels[speck]) - kept_[speck];
    for (int c = 0; c < 3; ++c) {
      if (!(sum[c] > 0.0))
        result[speck][c] += given[c];
      else
        window.each(picture_.width, [&](std::size_t j) {
          result[j][c] += given[c] * std::min(kept_[j][c], most[c]) / sum[c];
        });
    }
  }

  const Picture& picture_;
  std::vector<double> luminances_, window_;
  std::vector<glm::dvec3> kept_;  ///< [pixel], without what is spread
  std::vector<std::size_t> specks_;
};

}  // namespace

void spreadSpecks(std::span<const float> excess, Picture& picture, std::span<PartPicture> parts) {
  const std::vector<glm::dvec3> spread = SpeckSpreader(excess, picture).spread();
  for (std::size_t i = 0; i < spread.size(); ++i) {
    const glm::dvec3 before(picture.pixels[i]);
    if (spread[i] == before) continue;
    for (int c = 0; c < 3; ++c) {
      const double factor = before[c] > 0.0 ? spread[i][c] / before[c] : 1.0;
      for (PartPicture& part : parts) part.pixels[i][c] = float(factor * double(part.pixels[i][c]));
      if (before[c] > 0.0) picture.pixels[i][c] = float(spread[i][c]);
    }
  }
}

}  // namespace prelight
