#include <algorithm>
#include <cmath>
#include <numbers>

#include "basis/ch.h"
#include "basis/haar.h"
#include "basis/quadrature.h"
#include "benchmarks/lab/quincunx.h"
#include "benchmarks/suites/stability/cases.h"

namespace prelight::benchmarks::stability {

namespace {

/// Returns the m-th derivative of the Chebyshev polynomial T_l: 2^(m-1) (m-1)! l times Gegenbauer's C^(m) of
/// degree l - m, by its own recurrence in extended precision.
long double chebyshevDerivative(int l, int m, long double z) {
  if (m == 0) return std::cos(static_cast<long double>(l) * std::acos(z));
  if (l < m) return 0.0L;
  long double before = 0.0L, value = 1.0L;
  for (int n = 1; n <= l - m; ++n) {
    const long double a = 2.0L * (n + m - 1) * z, b = static_cast<long double>(n + 2 * m - 2);
    const long double next = (a * value - b * before) / n;
    before = value;
    value = next;
  }
  return std::ldexp(std::tgamma(static_cast<long double>(m)), m - 1) * static_cast<long double>(l) * value;
}

double chebyshevFunction(const glm::dvec3& d, int l, int m) {
  const int n = std::abs(m);
  const long double z = std::clamp(static_cast<long double>(d.z), -1.0L, 1.0L);
  const long double ring = std::hypot(static_cast<long double>(d.x), static_cast<long double>(d.y));
  const long double turn = std::atan2(static_cast<long double>(d.y), static_cast<long double>(d.x));
  const long double wave = m < 0 ? std::sin(n * turn) : std::cos(n * turn);
  return static_cast<double>(static_cast<long double>(ch::constant(l, n)) * std::pow(ring, n) *
                             chebyshevDerivative(l, n, z) * wave);
}

std::vector<glm::dvec3> someDirections() {
  Random random(21);
  std::vector<glm::dvec3> directions = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}};
  for (int i = 0; i < 200; ++i) directions.push_back(random.direction());
  for (const double sine : {1e-3, 1e-8, 1e-150})
    directions.emplace_back(sine, 0.5 * sine, std::sqrt(1.0 - 1.25 * sine * sine));
  return directions;
}

void evaluateCh(int order, Trials& trials) {
  std::vector<double> values(static_cast<std::size_t>(order * order));
  Differences differences;
  for (const glm::dvec3& d : someDirections()) {
    const glm::dvec3 unit = glm::normalize(d);
    ch::evaluate(unit, order, values);
    for (int l = 0; l < order; ++l)
      for (int m = -l; m <= l; ++m) {
        const double truth = chebyshevFunction(unit, l, m);
        differences.add(values[static_cast<std::size_t>(l * (l + 1) + m)], truth,
                        std::max(std::abs(truth), 1.0));
      }
  }
  trials.record("functions at random directions and next to the poles", differences,
                32.0 * order * order * 0x1p-53, {"order", double(order)});
}

void normsOfCh(int order, Trials& trials) {
  const auto n = static_cast<std::size_t>(order * order);
  std::vector<double> values(n), norms(n, 0.0);
  for (const SphereSample& sample : sphereQuadrature(2 * order)) {
    ch::evaluate(sample.direction, order, values);
    for (std::size_t i = 0; i < n; ++i) norms[i] += sample.weight * values[i] * values[i];
  }
  Differences differences;
  for (const double norm : norms) differences.add(norm, 1.0);
  trials.record("norms over the sphere", differences, 64.0 * order * 0x1p-53, {"order", double(order)});
}

/// Converts from SH to CH and back, directly and through moments.
void roundTripOfCh(int order, double scale, const char* stress, Trials& trials) {
  const auto n = static_cast<std::size_t>(order * order);
  const ch::Basis basis(order);
  Random random(23);
  std::vector<double> function(n), there(n), back(n), dual(n);
  double largest = 0.0;
  for (double& value : function) {
    value = random.between(-scale, scale);
    largest = std::max(largest, std::abs(value));
  }
  basis.fromSh(function, there);
  basis.toSh(there, back);
  Differences differences;
  for (std::size_t i = 0; i < n; ++i) differences.add(back[i] / scale, function[i] / scale, largest / scale);
  basis.momentsFromSh(function, dual);
  basis.dualFromMoments(dual, dual);
  for (std::size_t i = 0; i < n; ++i) differences.add(dual[i] / scale, there[i] / scale, largest / scale);
  const double condition = 0.9 * std::sqrt(double(order)) + 1.0;
  trials.record(stress, differences, condition * condition * 4.0 * order * 0x1p-53, {"order", double(order)});
}

/// Returns, per coefficient, the sum of magnitudes under its support divided by the support's side, to which
/// its rounding error is relative.
std::vector<double> haarScales(const std::vector<float>& texels, int faceSize) {
  std::vector<double> scales(texels.size());
  const auto side = static_cast<std::size_t>(faceSize);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const haar::Wavelet w = haar::waveletOf(static_cast<std::uint32_t>(i), faceSize);
    double sum = 0.0;
    for (int r = 0; r < w.size; ++r)
      for (int c = 0; c < w.size; ++c)
        sum += std::abs(double(
            texels[(static_cast<std::size_t>(w.face) * side + static_cast<std::size_t>(w.row + r)) * side +
                   static_cast<std::size_t>(w.column + c)]));
    scales[i] = sum / w.size;
  }
  return scales;
}

void transformHaar(const std::vector<float>& texels, int faceSize, const char* stress, Trials& trials) {
  const std::vector<double> scales = haarScales(texels, faceSize);
  std::vector<float> coefficients = texels;
  haar::forward(std::span<float>(coefficients), faceSize);
  Differences differences;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const haar::Wavelet w = haar::waveletOf(static_cast<std::uint32_t>(i), faceSize);
    double truth = 0.0;
    for (int r = w.row; r < w.row + w.size; ++r)
      for (int c = w.column; c < w.column + w.size; ++c)
        truth += haar::valueAt(w, r, c) * double(texels[(static_cast<std::size_t>(w.face * faceSize + r)) *
                                                            static_cast<std::size_t>(faceSize) +
                                                        static_cast<std::size_t>(c)]);
    differences.add(coefficients[i], truth, scales[i]);
  }
  trials.record(stress, differences, sumBound(3.0 * std::log2(double(faceSize))),
                {"texels per side", double(faceSize)});
}

void quincunxRoundTrip(int intervals, double scale, const char* stress, Trials& trials) {
  const QuincunxLattice lattice(intervals);
  Random random(29);
  std::vector<double> values(lattice.size());
  for (double& value : values) value = random.between(-scale, scale);
  std::vector<double> back = values;
  lattice.forward(back);
  lattice.inverse(back);
  Differences differences;
  for (std::size_t i = 0; i < values.size(); ++i) differences.add(back[i] / scale, values[i] / scale, 1.0);
  trials.record(stress, differences, 64.0 * std::log2(2.0 * intervals) * 0x1p-53,
                {"intervals per side", double(intervals)});
}

}  // namespace

std::vector<float> hardTexels(int faceSize, TexelStress stress) {
  const std::size_t count =
      std::size_t{6} * static_cast<std::size_t>(faceSize) * static_cast<std::size_t>(faceSize);
  Random random(31);
  std::vector<float> texels(count, 0.0f);
  for (std::size_t i = 0; i < count; ++i) {
    const double unit = random.unit();
    switch (stress) {
      case TexelStress::Even:
        texels[i] = static_cast<float>(1e6);
        break;
      case TexelStress::Sun:
        texels[i] = i == count / 3 ? 1e6f : static_cast<float>(1e-6 * unit);
        break;
      case TexelStress::Denormal:
        texels[i] = static_cast<float>(1e-40 * unit);
        break;
      default:
        texels[i] = static_cast<float>(unit);
    }
  }
  return texels;
}

void runCh(Trials& trials) {
  for (const int order : trials.options().orders) {
    evaluateCh(order, trials);
    normsOfCh(order, trials);
    roundTripOfCh(order, 1.0, "from SH and back", trials);
    roundTripOfCh(order, 1e-300, "from SH and back, functions of 1e-300", trials);
    roundTripOfCh(order, 1e300, "from SH and back, functions of 1e300", trials);
  }
}

void runHaar(Trials& trials) {
  for (const int size : trials.options().faceSizes) {
    transformHaar(hardTexels(size, TexelStress::Random), size, "random texels", trials);
    transformHaar(hardTexels(size, TexelStress::Even), size, "even texels of 1e6", trials);
    transformHaar(hardTexels(size, TexelStress::Sun), size, "a sun of 1e6 over texels of 1e-6", trials);
    transformHaar(hardTexels(size, TexelStress::Denormal), size, "denormal texels", trials);
  }
}

void runQuincunx(Trials& trials) {
  for (const int size : trials.options().faceSizes) {
    quincunxRoundTrip(size, 1.0, "there and back", trials);
    quincunxRoundTrip(size, 1e300, "there and back, values of 1e300", trials);
  }
}

}  // namespace prelight::benchmarks::stability
