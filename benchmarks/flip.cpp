#include "benchmarks/flip.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <numbers>

#include "base/parallel.h"

namespace prelight::benchmarks {

namespace {

using std::numbers::pi;

// Exponents and the point from which colour differences are compressed ([1], section 4.1.4), and the exponent
// and width of features, degrees (4.2).
constexpr double colorExponent = 0.7;
constexpr double compressedFrom = 0.4;
constexpr double compressedTo = 0.95;
constexpr double featureExponent = 0.5;
constexpr double featureWidth = 0.082;

const glm::dvec3 whitePoint(0.950428545, 1.0, 1.088900371);  // D65, as the rows below sum up to

struct Image {
  int width = 0;
  int height = 0;
  std::vector<glm::dvec3> pixels;

  /// Beyond the border lies the border.
  const glm::dvec3& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(std::clamp(y, 0, height - 1)) * width +
                  std::clamp(x, 0, width - 1)];
  }
};

Image mapped(const Image& image, const std::function<glm::dvec3(const glm::dvec3&)>& function) {
  Image result = image;
  parallelRanges(result.pixels.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) result.pixels[i] = function(result.pixels[i]);
  });
  return result;
}

double decodeSrgb(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// IEC 61966-2-1, linear.
glm::dvec3 xyzOf(const glm::dvec3& rgb) {
  return {0.41238656 * rgb.r + 0.35759149 * rgb.g + 0.18045049 * rgb.b,
          0.21263682 * rgb.r + 0.71518298 * rgb.g + 0.0721802 * rgb.b,
          0.01933062 * rgb.r + 0.11919716 * rgb.g + 0.95037259 * rgb.b};
}

glm::dvec3 rgbOf(const glm::dvec3& xyz) {
  static const glm::dmat3 inverse =
      glm::inverse(glm::dmat3(xyzOf({1, 0, 0}), xyzOf({0, 1, 0}), xyzOf({0, 0, 1})));
  return inverse * xyz;
}

/// The linearised opponent space YCxCz ([1], section 4.1.1).
glm::dvec3 opponentOf(const glm::dvec3& rgb) {
  const glm::dvec3 q = xyzOf(rgb) / whitePoint;
  return {116.0 * q.y - 16.0, 500.0 * (q.x - q.y), 200.0 * (q.y - q.z)};
}

glm::dvec3 rgbOfOpponent(const glm::dvec3& c) {
  const double y = (c.x + 16.0) / 116.0;
  return rgbOf(whitePoint * glm::dvec3(y + c.y / 500.0, y, y - c.z / 200.0));
}

/// CIELAB with chroma scaled by lightness after Hunt ([1], section 4.1.2).
glm::dvec3 huntLabOf(const glm::dvec3& rgb) {
  const auto f = [](double t) {
    constexpr double delta = 6.0 / 29.0;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3.0 * delta * delta) + 4.0 / 29.0;
  };
  const glm::dvec3 q = xyzOf(rgb) / whitePoint;
  const double lightness = 116.0 * f(q.y) - 16.0;
  return {lightness, 0.01 * lightness * 500.0 * (f(q.x) - f(q.y)),
          0.01 * lightness * 200.0 * (f(q.y) - f(q.z))};
}

double hyAb(const glm::dvec3& a, const glm::dvec3& b) {
  return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

/// A separable filter, its weights along one axis from -radius to radius for each channel.
struct Filter {
  std::vector<glm::dvec3> weights;
  int radius() const { return static_cast<int>(weights.size() / 2); }
};

Image filtered(const Image& image, const Filter& across, const Filter& down) {
  const auto pass = [](const Image& from, const Filter& filter, int stepX, int stepY) {
    Image to = from;
    parallelRanges(static_cast<std::size_t>(from.height), 4, [&](std::size_t begin, std::size_t end) {
      for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
        for (int x = 0; x < from.width; ++x) {
          glm::dvec3 sum(0.0);
          for (int k = -filter.radius(); k <= filter.radius(); ++k)
            sum += filter.weights[static_cast<std::size_t>(k + filter.radius())] *
                   from.at(x + k * stepX, y + k * stepY);
          to.pixels[static_cast<std::size_t>(y) * from.width + x] = sum;
        }
    });
    return to;
  };
  return pass(pass(image, across, 1, 0), down, 0, 1);
}

/// A term a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees, of the contrast sensitivity functions ([1], Table
/// 1).
struct Gaussian {
  double a;
  double b;
};
constexpr std::array<Gaussian, 2> sensitivityTerms[3] = {
    {{{1.0, 0.0047}, {0.0, 1e-5}}}, {{{1.0, 0.0053}, {0.0, 1e-5}}}, {{{34.1, 0.04}, {13.5, 0.025}}}};
constexpr double widestSensitivity = 0.04;

/// What the eye does not resolve is blurred away. The blue-yellow channel's filter is a sum of two Gaussians:
/// each of them is separable, their sum is not, so that the terms are filtered one after the other.
Image seenFromAfar(const Image& opponent, double pixelsPerDegree) {
  const int radius =
      static_cast<int>(std::ceil(3.0 * std::sqrt(widestSensitivity / (2.0 * pi * pi)) * pixelsPerDegree));
  Image result = opponent;
  std::fill(result.pixels.begin(), result.pixels.end(), glm::dvec3(0.0));
  glm::dvec3 total(0.0);
  for (std::size_t term = 0; term < 2; ++term) {
    Filter filter;
    glm::dvec3 height(0.0), sum(0.0);
    for (int k = -radius; k <= radius; ++k) {
      glm::dvec3 weight(0.0);
      const double x = k / pixelsPerDegree;
      for (int c = 0; c < 3; ++c) weight[c] = std::exp(-pi * pi * x * x / sensitivityTerms[c][term].b);
      filter.weights.push_back(weight);
      sum += weight;
    }
    for (int c = 0; c < 3; ++c)
      height[c] = sensitivityTerms[c][term].a * std::sqrt(pi / sensitivityTerms[c][term].b);
    total += height * sum * sum;
    const Image part = filtered(opponent, filter, filter);
    for (std::size_t i = 0; i < result.pixels.size(); ++i) result.pixels[i] += height * part.pixels[i];
  }
  for (glm::dvec3& pixel : result.pixels) pixel /= total;
  return result;
}

/// [1], section 4.1.3 and 4.1.4: 0 to 1.
double colorDifference(const glm::dvec3& first, const glm::dvec3& second) {
  static const double largest =
      std::pow(hyAb(huntLabOf({0.0, 1.0, 0.0}), huntLabOf({0.0, 0.0, 1.0})), colorExponent);
  const double difference = std::pow(hyAb(first, second), colorExponent), knee = compressedFrom * largest;
  return difference < knee ? compressedTo / knee * difference
                           : compressedTo + (difference - knee) / (largest - knee) * (1.0 - compressedTo);
}

/// Weights whose positive ones sum up to 1 and whose negative ones to -1.
void balance(std::vector<double>& weights) {
  double above = 0.0, below = 0.0;
  for (const double w : weights) (w > 0.0 ? above : below) += std::abs(w);
  for (double& w : weights) w /= w > 0.0 ? above : below;
}

/// Strength of edges (x) and of points and thin lines (y) of an achromatic picture: first and second
/// derivatives of Gaussians
/// ([1], section 4.2).
std::vector<glm::dvec2> featuresOf(const Image& opponent, double pixelsPerDegree) {
  const double deviation = 0.5 * featureWidth * pixelsPerDegree;
  const int radius = static_cast<int>(std::ceil(3.0 * deviation));
  std::vector<double> smooth, slope, bend;
  double sum = 0.0;
  for (int k = -radius; k <= radius; ++k) {
    const double g = std::exp(-0.5 * k * k / (deviation * deviation));
    smooth.push_back(g);
    sum += g;
    slope.push_back(-k * g);
    bend.push_back((k * k / (deviation * deviation) - 1.0) * g);
  }
  for (double& w : smooth) w /= sum;
  balance(slope);
  balance(bend);
  // Two derivatives go through one filter, in channels of their own.
  Filter derivatives, smoothing;
  for (std::size_t k = 0; k < smooth.size(); ++k) {
    derivatives.weights.emplace_back(slope[k], bend[k], 0.0);
    smoothing.weights.emplace_back(smooth[k], smooth[k], 0.0);
  }
  const Image grey = mapped(opponent, [](const glm::dvec3& c) { return glm::dvec3((c.x + 16.0) / 116.0); });
  const Image across = filtered(grey, derivatives, smoothing), down = filtered(grey, smoothing, derivatives);
  std::vector<glm::dvec2> features;
  for (std::size_t i = 0; i < grey.pixels.size(); ++i)
    features.emplace_back(std::hypot(across.pixels[i].x, down.pixels[i].x),
                          std::hypot(across.pixels[i].y, down.pixels[i].y));
  return features;
}

/// A picture as differences are taken of it.
struct Seen {
  Image lab;
  std::vector<glm::dvec2> features;

  Seen(std::span<const glm::vec3> encoded, int width, int height, double pixelsPerDegree) {
    Image image{width, height, {}};
    for (const glm::vec3& p : encoded)
      image.pixels.push_back(opponentOf({decodeSrgb(p.r), decodeSrgb(p.g), decodeSrgb(p.b)}));
    features = featuresOf(image, pixelsPerDegree);
    lab = mapped(seenFromAfar(image, pixelsPerDegree), [](const glm::dvec3& c) {
      return huntLabOf(glm::clamp(rgbOfOpponent(c), glm::dvec3(0.0), glm::dvec3(1.0)));
    });
  }
};

}  // namespace

std::vector<float> flipMap(std::span<const glm::vec3> first, std::span<const glm::vec3> second, int width,
                           int height, double pixelsPerDegree) {
  assert(first.size() == static_cast<std::size_t>(width) * height && second.size() == first.size());
  const Seen a(first, width, height, pixelsPerDegree), b(second, width, height, pixelsPerDegree);
  std::vector<float> map;
  map.reserve(first.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    const double color = colorDifference(a.lab.pixels[i], b.lab.pixels[i]);
    const glm::dvec2 features = glm::abs(a.features[i] - b.features[i]);
    const double feature = std::pow(std::max(features.x, features.y) / std::numbers::sqrt2, featureExponent);
    map.push_back(static_cast<float>(std::clamp(std::pow(color, 1.0 - feature), 0.0, 1.0)));
  }
  return map;
}

double flip(std::span<const glm::vec3> first, std::span<const glm::vec3> second, int width, int height,
            double pixelsPerDegree) {
  double sum = 0.0;
  for (const float value : flipMap(first, second, width, height, pixelsPerDegree)) sum += value;
  return sum / static_cast<double>(first.size());
}

}  // namespace prelight::benchmarks
