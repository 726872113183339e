#include "transfer/horizons.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace prelight {

namespace {

using std::numbers::pi;

/// A sky in SH of order 3 as a polynomial of the direction: even + linear . w + w . square w.
struct SkyPolynomial {
  double even = 0.0;
  glm::dvec3 linear{0.0};
  glm::dmat3 square{0.0};
};

SkyPolynomial polynomialOf(std::span<const glm::dvec3> sky, int channel, const glm::dmat3& frame) {
  std::array<double, 9> c{};
  for (std::size_t i = 0; i < c.size(); ++i) c[i] = sky[i][channel];
  const double first = std::sqrt(3.0 / (4.0 * pi)), second = std::sqrt(15.0 / pi);
  const double axial = std::sqrt(5.0 / (16.0 * pi));
  SkyPolynomial world;
  world.even = std::sqrt(1.0 / (4.0 * pi)) * c[0];
  world.linear = first * glm::dvec3(c[3], c[1], c[2]);
  const double xy = 0.25 * second * c[4], yz = 0.25 * second * c[5], xz = 0.25 * second * c[7];
  const double difference = 0.25 * second * c[8];  // of x^2 and y^2
  world.square = {{difference - axial * c[6], xy, xz},
                  {xy, -difference - axial * c[6], yz},
                  {xz, yz, 2.0 * axial * c[6]}};
  return {world.even, glm::transpose(frame) * world.linear, glm::transpose(frame) * world.square * frame};
}

/// Integrals over heights above a horizon of products of u, the sine of the height, and c, its cosine. Each
/// has a factor u more, for the receiver's cosine; du is what a band of the sphere weighs.
struct HeightIntegrals {
  double one, c, u, cc, cu, uu;
};

HeightIntegrals heightIntegrals(double horizon) {
  const double u = std::sin(horizon), c = std::cos(horizon);
  return {0.5 * c * c,
          c * c * c / 3.0,
          (1.0 - u * u * u) / 3.0,
          0.25 * c * c * c * c,
          0.125 * (0.5 * pi - horizon + u * c * (1.0 - 2.0 * u * u)),
          0.25 * (1.0 - u * u * u * u)};
}

}  // namespace

double horizonOfOpenness(double open) { return std::acos(std::sqrt(std::clamp(open, 0.0, 1.0))); }

void horizonsOfOpenness(std::span<const double> open, std::span<float> horizons) {
  constexpr int halvings = 40;
  const auto meanWith = [&](double shift) {
    double sum = 0.0;
    for (const double value : open) sum += std::clamp(value + shift, 0.0, 1.0);
    return sum / static_cast<double>(open.size());
  };
  double mean = 0.0;
  for (const double value : open) mean += value / static_cast<double>(open.size());
  const auto [least, most] = std::minmax_element(open.begin(), open.end());
  double low = 0.0, high = 0.0;
  if (*least < 0.0 || *most > 1.0) {
    low = -std::max(1.0, *most);
    high = std::max(1.0, 1.0 - *least);
  }
  for (int i = 0; i < halvings && low < high; ++i) {
    const double middle = 0.5 * (low + high);
    (meanWith(middle) < mean ? low : high) = middle;
  }
  for (std::size_t s = 0; s < open.size(); ++s)
    horizons[s] = static_cast<float>(horizonOfOpenness(open[s] + 0.5 * (low + high)));
}

double accessibilityOf(std::span<const float> horizons) {
  double sum = 0.0;
  for (const float horizon : horizons) sum += std::pow(std::cos(double{horizon}), 2);
  return sum / static_cast<double>(horizons.size());
}

double horizonTowards(std::span<const float> horizons, double turn) {
  const auto sectors = static_cast<double>(horizons.size());
  const double around = turn / (2.0 * pi);
  const double place = (around - std::floor(around)) * sectors - 0.5, low = std::floor(place);
  const auto first = static_cast<std::size_t>(low + sectors) % horizons.size();
  const double share = place - low;
  return (1.0 - share) * horizons[first] + share * horizons[(first + 1) % horizons.size()];
}

glm::dvec3 skyAboveHorizons(std::span<const glm::dvec3> sky, const glm::dmat3& frame,
                            std::span<const float> horizons) {
  std::array<SkyPolynomial, 3> channels;
  for (int channel = 0; channel < 3; ++channel) channels[channel] = polynomialOf(sky, channel, frame);
  const auto sectors = static_cast<double>(horizons.size());
  glm::dvec3 sum(0.0);
  for (std::size_t s = 0; s < horizons.size(); ++s) {
    const double from = 2.0 * pi * static_cast<double>(s) / sectors, to = from + 2.0 * pi / sectors;
    const HeightIntegrals h = heightIntegrals(horizons[s]);
    // Integrals over the azimuth of its cosine, sine and their products.
    const double width = to - from, cosine = std::sin(to) - std::sin(from),
                 sine = std::cos(from) - std::cos(to);
    const double turned = 0.25 * (std::sin(2.0 * to) - std::sin(2.0 * from));
    const double mixed = 0.25 * (std::cos(2.0 * from) - std::cos(2.0 * to));
    for (int channel = 0; channel < 3; ++channel) {
      const auto& [even, linear, square] = channels[channel];
      sum[channel] += width * (even * h.one + linear.z * h.u + square[2][2] * h.uu) +
                      (linear.x * cosine + linear.y * sine) * h.c +
                      2.0 * (square[0][2] * cosine + square[1][2] * sine) * h.cu +
                      (square[0][0] * (0.5 * width + turned) + square[1][1] * (0.5 * width - turned) +
                       2.0 * square[0][1] * mixed) *
                          h.cc;
    }
  }
  return sum / pi;
}

double diskAboveHorizon(double height, double radius) {
  const double x = std::clamp(height / radius, -1.0, 1.0);
  return 0.5 + (x * std::sqrt(1.0 - x * x) + std::asin(x)) / pi;
}

}  // namespace prelight
