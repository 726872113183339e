#include "techniques/horizons/horizon_bands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace prelight {

namespace {

using std::numbers::pi;

/// A sky in SH of order 3 as a polynomial of the direction w: even + linear . w + w . square w.
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
  const double difference = 0.25 * second * c[8];  // coefficient of x^2 - y^2
  world.square = {{difference - axial * c[6], xy, xz},
                  {xy, -difference - axial * c[6], yz},
                  {xz, yz, 2.0 * axial * c[6]}};
  return {world.even, glm::transpose(frame) * world.linear, glm::transpose(frame) * world.square * frame};
}

/// Integrals over elevations above a horizon of products of u, the sine of the elevation, and c, its cosine.
/// Each includes another factor u for the receiver's cosine; the measure is du.
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

HeightIntegrals operator-(const HeightIntegrals& a, const HeightIntegrals& b) {
  return {a.one - b.one, a.c - b.c, a.u - b.u, a.cc - b.cc, a.cu - b.cu, a.uu - b.uu};
}

HeightIntegrals operator+(const HeightIntegrals& a, const HeightIntegrals& b) {
  return {a.one + b.one, a.c + b.c, a.u + b.u, a.cc + b.cc, a.cu + b.cu, a.uu + b.uu};
}

double meanOpenness(std::span<const SectorRays> rays) {
  double sum = 0.0;
  for (const SectorRays& sector : rays) sum += sector.open;
  return std::clamp(sum / static_cast<double>(rays.size()), 0.0, 1.0);
}

/// Returns the openness of a sector when its odds are multiplied by `factor`. Missing rays of a sector are
/// replaced by the mean.
double openness(const SectorRays& sector, double factor, double mean) {
  constexpr double enough = 0.25;  // share of the mean number of rays per sector
  const double open = std::max(sector.open, 0.0), closed = std::max(sector.closed, 0.0);
  const double missing = std::max(enough - open - closed, 0.0);
  const double escaped = factor * (open + missing * mean), met = closed + missing * (1.0 - mean);
  return escaped + met > 0.0 ? escaped / (escaped + met) : mean;
}

/// Returns the factor of the odds for which all sectors together are as open as the mean of their rays.
double oddsFactor(std::span<const SectorRays> rays) {
  constexpr int halvings = 40;
  constexpr double mostFactor = 8.0;
  const double mean = meanOpenness(rays);
  double low = -std::log(mostFactor), high = -low;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    double sum = 0.0;
    for (const SectorRays& sector : rays) sum += openness(sector, std::exp(middle), mean);
    (sum < mean * static_cast<double>(rays.size()) ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

/// Returns the squared sine of a band's foot for the given openness. Cosine-weighted rays are uniform in the
/// squared sine of their elevation, so that the mean of a band of `closed` is half of that above its foot. As
/// few rays locate the band imprecisely, and light must not leak below objects on the surface or, near the
/// normal, through a roof, bands that may stand on the surface have foot 0, and bands that end near the
/// normal are extended to it.
double footOf(const SectorRays& sector, double open) {
  constexpr double hanging = 0.5, atTheNormal = 0.85;
  if (!(open > 0.0) || !(open < 1.0) || !(sector.closed > 0.0)) return 0.0;
  const double place = (sector.height / sector.closed - 0.5 * (1.0 - open)) / open;
  return place < hanging ? 0.0 : open * std::min(place / atTheNormal, 1.0);
}

}  // namespace

double horizonOfOpenness(double open) { return std::acos(std::sqrt(std::clamp(open, 0.0, 1.0))); }

void closedBands(std::span<const SectorRays> rays, std::span<float> feet, std::span<float> horizons) {
  const double factor = oddsFactor(rays);
  const double mean = meanOpenness(rays);
  for (std::size_t s = 0; s < rays.size(); ++s) {
    const double open = openness(rays[s], factor, mean);
    const double foot = footOf(rays[s], open);
    feet[s] = static_cast<float>(std::asin(std::sqrt(foot)));
    horizons[s] = static_cast<float>(horizonOfOpenness(open - foot));
  }
}

double accessibilityOf(std::span<const float> feet, std::span<const float> horizons) {
  double sum = 0.0;
  for (const float horizon : horizons) sum += std::pow(std::cos(double{horizon}), 2);
  for (const float foot : feet) sum += std::pow(std::sin(double{foot}), 2);
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
                            std::span<const float> feet, std::span<const float> horizons) {
  std::array<SkyPolynomial, 3> channels;
  for (int channel = 0; channel < 3; ++channel) channels[channel] = polynomialOf(sky, channel, frame);
  const auto sectors = static_cast<double>(horizons.size());
  glm::dvec3 sum(0.0);
  for (std::size_t s = 0; s < horizons.size(); ++s) {
    const double from = 2.0 * pi * static_cast<double>(s) / sectors, to = from + 2.0 * pi / sectors;
    HeightIntegrals h = heightIntegrals(horizons[s]);
    if (!feet.empty() && feet[s] > 0.0f) h = h + (heightIntegrals(0.0) - heightIntegrals(feet[s]));
    // Integrals over the azimuth of cosine, sine and their products.
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

double diskPastBand(double height, double radius, double foot, double horizon) {
  if (!(foot > 0.0)) return diskAboveHorizon(height - horizon, radius);
  const auto above = [&](double edge) {
    return std::clamp(0.5 + (height - edge) / (2.0 * radius), 0.0, 1.0);
  };
  return 1.0 - (above(foot) - above(horizon));
}

}  // namespace prelight
