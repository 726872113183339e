#include "basis/sky_lobes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "base/parallel.h"
#include "basis/quadrature.h"

namespace prelight {

namespace {

using std::numbers::pi;
using LobeNumber = std::complex<double>;

constexpr int mostLobeBands = 384;
constexpr int mostLobeColumns = 512;
constexpr double leastFactor = 1e-5;

/// Calls use(cosine, weight) for directions of a lobe; the sum of the weights is 1. Half vectors at the angle
/// atan(alpha sinh(s)) from the axis are distributed by 1 / cosh^2 s (Walter et al. 2007, Eq. 35), which
/// spreads nodes evenly over the core of a lobe and its long tail.
template <typename Use>
void forLobe(double alpha, std::vector<LineSample> samples, const Use& use) {
  const double end = std::asinh(1.0 / alpha);  // a half angle of 45 degrees
  double sum = 0.0;
  for (LineSample& sample : samples) {
    const double s = 0.5 * end * (sample.position + 1.0), tangent = alpha * std::sinh(s);
    const double cosine = 2.0 / (1.0 + tangent * tangent) - 1.0;
    sample.position = cosine;
    sample.weight *= cosine * std::tanh(s) / (std::cosh(s) * std::cosh(s));
    sum += sample.weight;
  }
  for (const LineSample& sample : samples) use(sample.position, sample.weight / sum);
}

/// Legendre functions of one m, normalised with e^(i m azimuth) over the sphere, by their recurrence in l.
class LegendreColumn {
 public:
  LegendreColumn(int m, int order) : m_(m) {
    for (int l = m + 2; l < order; ++l) {
      const double l2 = double(l) * l, m2 = double(m) * m, before2 = double(l - 1) * (l - 1);
      const double scale = std::sqrt((4.0 * l2 - 1.0) / (l2 - m2));
      steps_.push_back({scale, scale * std::sqrt((before2 - m2) / (4.0 * before2 - 1.0))});
    }
    for (int k = 1; k <= m; ++k) logOfFirst_ += 0.5 * std::log((2.0 * k + 1.0) / (2.0 * k));
    logOfFirst_ += 0.5 * std::log(1.0 / (4.0 * pi));
  }

  /// Calls use(l - m, value) for l from m to `end` - 1, at polar angles with this cosine and sine.
  template <typename Use>
  void at(double cosine, double sine, int end, const Use& use) const {
    if (m_ >= end) return;
    double before = 0.0, value = std::exp(logOfFirst_ + m_ * std::log(sine));
    use(std::size_t{0}, value);
    if (m_ + 1 >= end) return;
    before = std::exchange(value, std::sqrt(2.0 * m_ + 3.0) * cosine * value);
    use(std::size_t{1}, value);
    for (std::size_t i = 2; i < static_cast<std::size_t>(end - m_); ++i) {
      const auto [scale, back] = steps_[i - 2];
      before = std::exchange(value, scale * cosine * value - back * before);
      use(i, value);
    }
  }

 private:
  struct Step {
    double scale, back;
  };
  int m_;
  double logOfFirst_ = 0.0;
  std::vector<Step> steps_;
};

/// Returns how many m matter at polar angles with this sine: Legendre functions vanish where l sine is well
/// below m.
int orderAt(double sine, int order) { return std::min(order, static_cast<int>(order * sine) + 40); }

/// Cosines and sines of the multiples of a full turn over `count`.
std::vector<LobeNumber> turnsOf(int count) {
  std::vector<LobeNumber> turns;
  for (int i = 0; i < count; ++i) turns.push_back(std::polar(1.0, 2.0 * pi * i / count));
  return turns;
}

/// Flux of a sky, radiance times solid angle, as points: large skies are averaged to mostLobeColumns columns
/// and half as many rows, and texels of small ones are divided, as points must lie closer than the narrowest
/// lobe is wide.
struct SkyFlux {
  int width, height;
  std::vector<glm::dvec3> flux;

  explicit SkyFlux(const Environment& sky) {
    const int parts = (mostLobeColumns + sky.width - 1) / sky.width;  // of a texel's sides
    const int fineWidth = parts * sky.width, fineHeight = parts * sky.height;
    width = std::min(fineWidth, mostLobeColumns);
    height = std::min(fineHeight, mostLobeColumns / 2);
    flux.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), glm::dvec3(0.0));
    for (int y = 0; y < fineHeight; ++y) {
      const double solidAngle =
          2.0 * pi / fineWidth * (std::cos(pi * y / fineHeight) - std::cos(pi * (y + 1.0) / fineHeight));
      glm::dvec3* row = flux.data() + placeIn(y, fineHeight, height) * static_cast<std::size_t>(width);
      const glm::vec3* texels = sky.radiance.data() + static_cast<std::ptrdiff_t>(y / parts) * sky.width;
      for (int x = 0; x < fineWidth; ++x)
        row[placeIn(x, fineWidth, width)] += solidAngle * glm::dvec3(texels[x / parts]);
    }
  }

  /// Returns which of `cells` the middle of part i of `count` equal parts lies in.
  static std::size_t placeIn(int i, int count, int cells) {
    return static_cast<std::size_t>((2 * std::int64_t{i} + 1) * cells / (2 * std::int64_t{count}));
  }

  /// Returns the sum over a row of flux times e^(-i m azimuth), for m below `order`.
  std::vector<std::array<LobeNumber, 3>> row(int y, int order, const std::vector<LobeNumber>& turns) const {
    const auto columns = static_cast<std::size_t>(width);
    const glm::dvec3* texels = flux.data() + static_cast<std::size_t>(y) * columns;
    std::vector<std::array<LobeNumber, 3>> sums(static_cast<std::size_t>(order));
    for (std::size_t m = 0; m < sums.size(); ++m) {
      std::size_t turn = 0;
      glm::dvec3 real(0.0), imaginary(0.0);
      for (std::size_t x = 0; x < columns; ++x) {
        real += turns[turn].real() * texels[x];
        imaginary -= turns[turn].imag() * texels[x];
        turn = (turn + m) % columns;
      }
      const LobeNumber half = std::polar(1.0, -pi * double(m) / width);  // to the texels' centres
      for (int c = 0; c < 3; ++c)
        sums[m][static_cast<std::size_t>(c)] = half * LobeNumber(real[c], imaginary[c]);
    }
    return sums;
  }
};

}  // namespace

std::vector<double> lobeFactors(double alpha, int order) {
  std::vector<double> factors(static_cast<std::size_t>(order), 0.0);
  forLobe(alpha, gaussLegendre(2 * order + 64), [&](double cosine, double weight) {
    double before = 0.0, value = 1.0;
    for (std::size_t l = 0; l < factors.size(); ++l) {
      if (l > 0)
        before = std::exchange(
            value, (cosine * (2.0 * double(l) - 1.0) * value - (double(l) - 1.0) * before) / double(l));
      factors[l] += weight * value;
    }
  });
  while (factors.size() > 1 && std::abs(factors.back()) < leastFactor) factors.pop_back();
  return factors;
}

namespace {

/// Returns 1 less the mean cosine of a lobe; `nodes`: of a quadrature rule on [-1, 1].
double spreadBy(const std::vector<LineSample>& nodes, double alpha) {
  if (alpha <= 0.0) return 0.0;
  double spread = 0.0;
  forLobe(alpha, nodes, [&](double cosine, double weight) { spread += weight * (1.0 - cosine); });
  return spread;
}

constexpr int spreadNodes = 64;

}  // namespace

double lobeSpread(double alpha) { return spreadBy(gaussLegendre(spreadNodes), alpha); }

double alphaOfSpread(double spread) {
  const std::vector<LineSample> nodes = gaussLegendre(spreadNodes);
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (spreadBy(nodes, middle) < spread ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

SkyLobes::SkyLobes(const Environment& sky) : order_(mostLobeBands) {
  const SkyFlux flux(sky);
  const auto rows = static_cast<std::size_t>(flux.height);
  const std::vector<LobeNumber> turns = turnsOf(flux.width);
  std::vector<std::vector<Coefficients>> sums(rows);
  const auto polar = [&](std::size_t y) { return pi * (double(y) + 0.5) / flux.height; };
  parallelRanges(rows, 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y)
      sums[y] = flux.row(static_cast<int>(y), orderAt(std::sin(polar(y)), order_), turns);
  });
  bands_.resize(static_cast<std::size_t>(order_));
  parallelRanges(bands_.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t m = begin; m < end; ++m) {
      const LegendreColumn legendre(static_cast<int>(m), order_);
      bands_[m].resize(bands_.size() - m);
      for (std::size_t y = 0; y < rows; ++y) {
        if (m >= sums[y].size()) continue;
        const Coefficients& sum = sums[y][m];
        legendre.at(std::cos(polar(y)), std::sin(polar(y)), order_, [&](std::size_t i, double value) {
          for (std::size_t c = 0; c < 3; ++c) bands_[m][i][c] += value * sum[c];
        });
      }
    }
  });
}

Environment SkyLobes::map(double alpha, int width) const {
  const std::vector<double> factors = lobeFactors(alpha, order_);
  const int order = static_cast<int>(factors.size()), height = width / 2;
  const auto columns = static_cast<std::size_t>(width);
  std::vector<LegendreColumn> legendre;
  for (int m = 0; m < order; ++m) legendre.emplace_back(m, order);
  const std::vector<LobeNumber> turns = turnsOf(width);
  Environment map{width, height, std::vector<glm::vec3>(columns * static_cast<std::size_t>(height))};
  const auto fillRow = [&](std::size_t y) {
    const double polar = pi * (double(y) + 0.5) / height;
    std::vector<glm::dvec3> row(columns, glm::dvec3(0.0));
    const int used = orderAt(std::sin(polar), order);
    for (int m = 0; m < used; ++m) {
      Coefficients sum{};
      const std::vector<Coefficients>& band = bands_[static_cast<std::size_t>(m)];
      legendre[static_cast<std::size_t>(m)].at(
          std::cos(polar), std::sin(polar), order, [&](std::size_t i, double value) {
            const double factor = value * factors[static_cast<std::size_t>(m) + i];
            for (std::size_t c = 0; c < 3; ++c) sum[c] += factor * band[i][c];
          });
      const LobeNumber half = std::polar(m == 0 ? 1.0 : 2.0, pi * m / width);
      for (LobeNumber& s : sum) s *= half;
      const glm::dvec3 real(sum[0].real(), sum[1].real(), sum[2].real());
      const glm::dvec3 imaginary(sum[0].imag(), sum[1].imag(), sum[2].imag());
      for (std::size_t x = 0, turn = 0; x < columns; ++x) {
        row[x] += turns[turn].real() * real - turns[turn].imag() * imaginary;
        turn = (turn + static_cast<std::size_t>(m)) % columns;
      }
    }
    for (std::size_t x = 0; x < columns; ++x)
      map.radiance[y * columns + x] = glm::vec3(glm::max(row[x], glm::dvec3(0.0)));
  };
  parallelRanges(static_cast<std::size_t>(height), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) fillRow(y);
  });
  return map;
}

}  // namespace prelight
