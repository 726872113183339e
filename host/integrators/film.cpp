#include "integrators/film.h"

#include "base/colour.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace prelight::reference {

Film::Film(int pictureWidth, int pictureHeight, bool withParts)
    : width(pictureWidth),
      height(pictureHeight),
      sums(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), glm::dvec3(0.0)),
      means(sums.size(), 0.0),
      squares(sums.size(), 0.0),
      blurs(sums.size(), 0.0),
      blurSquares(sums.size(), 0.0),
      parts(withParts ? tracedParts * sums.size() : 0, glm::dvec3(0.0)) {}

void Film::add(std::span<const glm::vec4> passMeans, std::span<const glm::vec4> partMeans) {
  assert(parts.empty() || partMeans.size() == tracedParts * passMeans.size());
  assert(blockPixels + passMeans.size() <= pixelCount());
  const double n = static_cast<double>(passes + 1);
  for (std::size_t i = 0; i < passMeans.size(); ++i) {
    const std::size_t pixel = blockPixels + i;
    const glm::dvec3 radiance{glm::vec3(passMeans[i])};
    const double y = luminance(radiance);
    const double deviation = y - means[pixel];
    sums[pixel] += radiance;
    means[pixel] += deviation / n;
    squares[pixel] += deviation * (y - means[pixel]);
    const double blur = passMeans[i].w;
    blurs[pixel] += blur;
    blurSquares[pixel] += blur * blur;
  }
  for (std::size_t i = 0; i < partMeans.size() && !parts.empty(); ++i) {
    const std::size_t part = i / passMeans.size(), pixel = blockPixels + i % passMeans.size();
    parts[part * pixelCount() + pixel] += glm::vec3(partMeans[i]);
  }
  blockPixels += passMeans.size();
  if (blockPixels == pixelCount()) {
    ++passes;
    blockPixels = 0;
  }
}

Picture Film::picture() const {
  Picture picture{width, height, std::vector<glm::vec3>(pixelCount())};
  for (std::size_t i = 0; i < pixelCount(); ++i)
    picture.pixels[i] = glm::vec3(sums[i] / static_cast<double>(count(i)));
  return picture;
}

std::vector<PartPicture> Film::partPictures() const {
  std::vector<PartPicture> pictures;
  for (std::size_t first = 0; first < parts.size(); first += pixelCount()) {
    PartPicture& part = pictures.emplace_back();
    part.part = static_cast<PicturePart>(first / pixelCount());
    for (std::size_t i = 0; i < pixelCount(); ++i)
      part.pixels.emplace_back(parts[first + i] / static_cast<double>(count(i)));
  }
  return pictures;
}

std::vector<float> Film::variance() const {
  if (passes < 2) return {};
  std::vector<float> variance(pixelCount());
  for (std::size_t i = 0; i < pixelCount(); ++i) {
    const auto n = static_cast<double>(count(i));
    variance[i] = static_cast<float>(squares[i] / (n * (n - 1.0)));
  }
  return variance;
}

double Film::meanLuminance() const {
  double mean = 0.0;
  for (const double pixel : means) mean += pixel;
  return mean / static_cast<double>(pixelCount());
}

double Film::relativeError() const {
  if (passes < 2) return std::numeric_limits<double>::infinity();
  double variance = 0.0;
  for (std::size_t i = 0; i < pixelCount(); ++i) {
    const auto n = static_cast<double>(count(i));
    variance += squares[i] / (n * (n - 1.0));
  }
  const double mean = meanLuminance();
  if (mean == 0.0) return 0.0;
  return std::hypot(std::sqrt(variance / static_cast<double>(pixelCount())) / mean, relativeBlur());
}

/// Averages the squared blurs of pixels, minus the contribution of their scatter.
double Film::relativeBlur() const {
  if (passes < 2) return 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < pixelCount(); ++i) {
    const auto n = static_cast<double>(count(i));
    const double mean = blurs[i] / n;
    sum += mean * mean - (blurSquares[i] / n - mean * mean) / (n - 1.0);
  }
  const double mean = meanLuminance();
  return mean > 0.0 ? std::sqrt(std::max(sum, 0.0) / static_cast<double>(pixelCount())) / mean : 0.0;
}

}  // namespace prelight::reference
