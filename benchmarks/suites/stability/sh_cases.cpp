#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "basis/ch.h"
#include "basis/cube_map.h"
#include "basis/haar.h"
#include "basis/sh_evaluate.h"
#include "basis/sh_projection.h"
#include "basis/sh_rotation.h"
#include "benchmarks/lab/harmonic_sums.h"
#include "benchmarks/lab/sh_device.h"
#include "benchmarks/suites/stability/cases.h"
#include "relight/device/light_projector.h"

namespace prelight::benchmarks::stability {

namespace {

struct DirectionSet {
  const char* stress;
  std::vector<glm::vec3> directions;
};

/// Returns directions as near to a pole, or to the equator, as floats allow.
std::vector<glm::vec3> nearPlanes(bool poles) {
  std::vector<glm::vec3> directions;
  Random random(3);
  for (const double offset : {1e-2, 1e-4, 1e-7, 1e-12, 1e-20, 1e-37, 1e-40})
    for (int i = 0; i < 8; ++i) {
      const double turn = 2.0 * std::numbers::pi * random.unit(), side = i % 2 == 0 ? 1.0 : -1.0;
      const double sine = poles ? offset : std::sqrt(1.0 - offset * offset);
      const double z = side * (poles ? std::sqrt(1.0 - offset * offset) : offset);
      directions.emplace_back(sine * std::cos(turn), sine * std::sin(turn), z);
    }
  return directions;
}

std::vector<DirectionSet> directionSets() {
  Random random(1);
  std::vector<DirectionSet> sets = {{"random directions", {}},
                                    {"axes, with zeros of both signs and denormal numbers", {}},
                                    {"next to the poles", nearPlanes(true)},
                                    {"next to the equator", nearPlanes(false)}};
  for (int i = 0; i < 500; ++i) sets[0].directions.emplace_back(random.direction());
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {1.0f, -1.0f})
      for (const float rest : {0.0f, -0.0f, 1e-40f, -1e-44f}) {
        glm::vec3 d(rest);
        d[axis] = side;
        sets[1].directions.push_back(d);
      }
  return sets;
}

/// Returns the largest value of a band's functions.
double bandScale(int band) { return std::sqrt((2.0 * band + 1.0) / (4.0 * std::numbers::pi)); }

int bandOf(std::size_t i) { return static_cast<int>(std::sqrt(double(i) + 0.5)); }

/// Returns normalised associated Legendre functions in extended precision: by the standard library, or, next
/// to the poles, where it computes the sine from the cosine, by the recurrence in l.
long double legendre(int l, int m, long double z, long double ring) {
  if (ring > 1e-2L)
    return (m % 2 == 0 ? 1.0L : -1.0L) *  // undoes the Condon-Shortley phase
           std::sph_legendrel(static_cast<unsigned>(l), static_cast<unsigned>(m), std::atan2(ring, z));
  long double value = std::sqrt(0.25L / std::numbers::pi_v<long double>), before = 0.0L;
  for (int k = 1; k <= m; ++k) value *= ring * std::sqrt((2.0L * k + 1.0L) / (2.0L * k));
  for (int k = m + 1; k <= l; ++k) {
    const long double n = k, o = k - 1, mm = static_cast<long double>(m) * m;
    const long double next = std::sqrt((4.0L * n * n - 1.0L) / (n * n - mm)) *
                             (z * value - std::sqrt((o * o - mm) / (4.0L * o * o - 1.0L)) * before);
    before = value;
    value = next;
  }
  return value;
}

double legendreSh(const glm::dvec3& d, int l, int m) {
  using Long = long double;
  const Long x = d.x, y = d.y;
  const Long turn = std::atan2(y, x), root2 = std::sqrt(2.0L);
  const int n = std::abs(m);
  const Long wave = m == 0  ? 1.0L
                    : m > 0 ? root2 * std::cos(Long(n) * turn)
                            : root2 * std::sin(Long(n) * turn);
  return static_cast<double>(legendre(l, n, d.z, std::sqrt(x * x + y * y)) * wave);
}

void compareHostSh(const DirectionSet& set, int order, Trials& trials) {
  Differences differences;
  std::vector<double> values(static_cast<std::size_t>(order * order));
  for (const glm::vec3& direction : set.directions) {
    const glm::dvec3 d = glm::normalize(glm::dvec3(direction));
    sh::evaluate(d, order, values);
    for (int l = 0; l < order; ++l)
      for (int m = -l; m <= l; ++m)
        differences.add(values[static_cast<std::size_t>(l * (l + 1) + m)], legendreSh(d, l, m), bandScale(l));
  }
  // The recurrence in l is stable. Y_l changes with the l-th power of the direction's length, whose error is
  // 2^-53.
  trials.record(set.stress, differences, 16.0 * (order + 1) * 0x1p-53, {"order", double(order)});
}

void rotateOnDevice(int order, const glm::dmat3& turn, double scale, const char* stress, Trials& trials) {
  constexpr std::size_t functions = 16;
  const auto n = static_cast<std::size_t>(order * order);
  const std::vector<float> values = Random(7).floats(functions * n, scale);
  BandRotator rotator(trials.context(), order);
  rotator.setRotation(turn);
  const Buffer<float> in(trials.context(), std::span<const float>(values));
  Buffer<float> out(trials.context(), functions * n);
  rotator.rotate(in, out, functions);
  const std::vector<float> got = out.read();
  const sh::ShRotation rotation(order, turn);
  Differences differences;
  for (int l = 0; l < order; ++l) {
    const std::vector<double> matrix = rotation.bandMatrix(l);
    const auto width = static_cast<std::size_t>(2 * l + 1), first = static_cast<std::size_t>(l * l);
    for (std::size_t f = 0; f < functions; ++f)
      for (std::size_t row = 0; row < width; ++row) {
        double truth = 0.0, magnitude = 0.0;
        for (std::size_t k = 0; k < width; ++k) {
          const double term = matrix[row * width + k] * double(values[f * n + first + k]);
          truth += term;
          magnitude += std::abs(term);
        }
        differences.add(got[f * n + first + row], truth, magnitude);
      }
  }
  trials.record(stress, differences, sumBound(2.0 * order + 1.0), {"order", double(order)});
}

/// Compares `onDevice` and `onHost`, which evaluate a family of functions.
template <class OnDevice, class OnHost>
void compareEvaluation(Trials& trials, const OnDevice& onDevice, const OnHost& onHost) {
  for (const DirectionSet& set : directionSets())
    for (const int order : trials.options().orders) {
      const std::size_t count = set.directions.size(), n = static_cast<std::size_t>(order * order);
      const std::vector<float> got = onDevice(trials.device(), set.directions, order);
      std::vector<double> truth(n);
      Differences differences;
      for (std::size_t d = 0; d < count; ++d) {
        onHost(glm::normalize(glm::dvec3(set.directions[d])), order, truth);
        for (std::size_t i = 0; i < n; ++i)
          differences.add(got[i * count + d], truth[i], bandScale(bandOf(i)));
      }
      trials.record(set.stress, differences, 8.0 * unitRoundoff, {"order", double(order)});
    }
}

void compareSums(const HarmonicWayName& way, int order, const DirectionSet& set, Trials& trials) {
  std::vector<WeightedDirection> directions;
  for (std::size_t i = 0; i < HarmonicSums::blockSize; ++i)
    directions.push_back({set.directions[i % set.directions.size()], i % 3 == 0 ? -1.0f : 0.5f});
  HarmonicSums device(trials.context(), way.way, order, directions);
  device.run();
  const std::vector<float> got = device.sums();
  std::vector<double> values(got.size()), truth(got.size(), 0.0);
  double magnitude = 0.0;
  for (const WeightedDirection& d : directions) {
    const glm::dvec3 w = glm::normalize(glm::dvec3(d.towards));
    way.isCh ? ch::evaluate(w, order, values) : sh::evaluate(w, order, values);
    for (std::size_t i = 0; i < truth.size(); ++i) truth[i] += d.weight * values[i];
    magnitude += std::abs(d.weight) * bandScale(order - 1);
  }
  Differences differences;
  for (std::size_t i = 0; i < truth.size(); ++i) differences.add(got[i], truth[i], magnitude);
  trials.record(std::string(way.name) + ", " + set.stress, differences,
                sumBound(HarmonicSums::blockSize) + 8.0 * order * unitRoundoff, {"order", double(order)});
}

}  // namespace

void runChEvaluate(Trials& trials) {
  compareEvaluation(
      trials, ch::evaluateOnDevice,
      [](const glm::dvec3& w, int order, std::vector<double>& values) { ch::evaluate(w, order, values); });
}

/// Measures usual orders of bakes, whose sums are in single precision.
void runHarmonicSums(Trials& trials) {
  for (const DirectionSet& set : directionSets())
    for (const int order : trials.options().orders)
      for (const HarmonicWayName& way : harmonicWays())
        if (order <= 6) compareSums(way, order, set, trials);
}

void runHostSh(Trials& trials) {
  for (const DirectionSet& set : directionSets())
    for (const int order : trials.options().orders) compareHostSh(set, order, trials);
}

void runShEvaluate(Trials& trials) {
  compareEvaluation(
      trials, sh::evaluateOnDevice,
      [](const glm::dvec3& w, int order, std::vector<double>& values) { sh::evaluate(w, order, values); });
}

void runShRotation(Trials& trials) {
  const glm::dmat3 oblique{{0.0, 0.6, 0.8}, {1.0, 0.0, 0.0}, {0.0, 0.8, -0.6}};
  const glm::dmat3 tiny{{1.0, 1e-9, 0.0}, {-1e-9, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  for (const int order : trials.options().orders) {
    rotateOnDevice(order, oblique, 1.0, "random functions, an oblique turn", trials);
    rotateOnDevice(order, tiny, 1.0, "a turn of 1e-9", trials);
    rotateOnDevice(order, glm::dmat3(1.0), 1e6, "functions of 1e6, no turn", trials);
    rotateOnDevice(order, oblique, 1e-6, "functions of 1e-6", trials);
    rotateOnDevice(order, oblique, 1e-40, "denormal functions", trials);
  }
}

namespace {

enum class Sky { Even, Noise, Sun, PolarSun, Denormal };

constexpr std::array<std::pair<Sky, const char*>, 5> skies = {{{Sky::Even, "an even sky"},
                                                               {Sky::Noise, "noise"},
                                                               {Sky::Sun, "a sun of 1e6 over texels of 1e-6"},
                                                               {Sky::PolarSun, "a sun of 1e6 at the zenith"},
                                                               {Sky::Denormal, "denormal texels"}}};

Environment makeSky(Sky kind, int rows) {
  Environment sky{2 * rows, rows, {}};
  Random random(12);
  const auto count = static_cast<std::size_t>(2 * rows * rows);
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 noise(random.unit(), random.unit(), random.unit());
    const bool sun = (kind == Sky::Sun && i == count / 3) || (kind == Sky::PolarSun && i == 1);
    glm::dvec3 radiance = kind == Sky::Even ? glm::dvec3(1.0) : noise;
    if (kind == Sky::Sun || kind == Sky::PolarSun) radiance = sun ? glm::dvec3(1e6) : 1e-6 * noise;
    if (kind == Sky::Denormal) radiance = 1e-40 * noise;
    sky.radiance.emplace_back(radiance);
  }
  return sky;
}

/// Returns flux over 4 pi per channel. Coefficients are at most a band's largest value x the flux.
glm::dvec3 fluxOf(const Environment& sky) {
  glm::dvec3 flux(0.0);
  for (int row = 0; row < sky.height; ++row) {
    const double upper = std::cos(std::numbers::pi * row / sky.height),
                 lower = std::cos(std::numbers::pi * (row + 1) / sky.height);
    for (int column = 0; column < sky.width; ++column)
      flux += glm::dvec3(sky.radiance[static_cast<std::size_t>(row * sky.width + column)]) *
              ((upper - lower) * 2.0 * std::numbers::pi / sky.width);
  }
  return flux;
}

void projectSky(Sky kind, const char* stress, int rows, int order, Growth growth, Trials& trials) {
  const Environment sky = makeSky(kind, rows);
  LightProjector projector(trials.context(), sky.width, sky.height, order);
  projector.setSky(sky);
  const std::vector<float> got = projector.projectSh();
  const std::vector<double> truth = sh::projectEnvironment(sky, order);
  const glm::dvec3 flux = fluxOf(sky);
  const auto n = static_cast<std::size_t>(order * order);
  Differences differences;
  for (std::size_t i = 0; i < 3 * n; ++i) {
    const double band = std::floor(std::sqrt(double(i % n) + 0.5));
    const double greatest = std::sqrt((2.0 * band + 1.0) / (4.0 * std::numbers::pi));
    differences.add(got[i], truth[i], greatest * flux[static_cast<int>(i / n)]);
  }
  // A row is summed in 16 lanes, rows in runs of 32, and runs one after the other. Then follows a rotation to
  // the world's axes, whose rows have 2 l + 1 entries with a sum of squares of 1.
  const double terms = rows / 8.0 + 5.0 + 32.0 + rows / 32.0 + 2.0;
  const double rotation = (2.0 * order + 1.0) * std::sqrt(2.0 * order + 1.0);
  trials.record(stress, differences, sumBound(terms + rotation), std::move(growth));
}

void sampleSky(Sky kind, const char* stress, int rows, int faceSize, Trials& trials) {
  const Environment sky = makeSky(kind, rows);
  LightProjector projector(trials.context(), sky.width, sky.height, 1);
  projector.setSky(sky);
  constexpr int samples = 4;
  const std::vector<float> got = projector.projectWavelets(faceSize, samples);
  const std::size_t texels = cubeTexelCount(faceSize), face = static_cast<std::size_t>(faceSize * faceSize);
  // Truth in double precision. For points that rounding may move to the neighbouring texel of the sky, the
  // possible change is subtracted from the difference.
  std::vector<double> truth(texels, 0.0), slack(texels, 0.0);
  for (std::size_t t = 0; t < texels; ++t) {
    double total = 0.0;
    for (int k = 0; k < samples * samples; ++k) {
      const double u =
          (double(t % static_cast<std::size_t>(faceSize)) + (k % samples + 0.5) / samples) / faceSize;
      const double v =
          (double(t % face / static_cast<std::size_t>(faceSize)) + (k / samples + 0.5) / samples) / faceSize;
      const double a = 2.0 * u - 1.0, b = 2.0 * v - 1.0, weight = std::pow(1.0 + a * a + b * b, -1.5);
      const glm::dvec2 at = Environment::coordinates(cubeDirection(static_cast<int>(t / face), u, v)) *
                            glm::dvec2(sky.width, sky.height);
      const auto lookUp = [&](double x, double y) {
        const int column = (static_cast<int>(std::floor(x)) + sky.width) % sky.width;
        const int row = std::clamp(static_cast<int>(std::floor(y)), 0, sky.height - 1);
        return double(sky.radiance[static_cast<std::size_t>(row * sky.width + column)].x);
      };
      const double value = lookUp(at.x, at.y), near = 4e-7 * sky.width;
      double apart = 0.0;
      for (const double dx : {-near, near})
        for (const double dy : {-near, near})
          apart = std::max(apart, std::abs(lookUp(at.x + dx, at.y + dy) - value));
      truth[t] += weight * value;
      slack[t] += weight * apart;
      total += weight;
    }
    truth[t] /= total;
    slack[t] /= total;
  }
  std::vector<double> back(got.begin(), got.begin() + static_cast<std::ptrdiff_t>(texels));
  haar::inverse(std::span<double>(back), faceSize);
  double largest = 0.0;
  for (const double value : truth) largest = std::max(largest, value);
  Differences differences;
  for (std::size_t t = 0; t < texels; ++t) {
    const double off = std::max(std::abs(back[t] - truth[t]) - slack[t], 0.0);
    differences.add(std::isfinite(back[t]) ? truth[t] + off : back[t], truth[t], largest);
  }
  const double terms = samples * samples + 8.0 + 3.0 * std::log2(double(faceSize));
  trials.record(stress, differences, sumBound(terms * faceSize), {"texels per side", double(faceSize)});
}

}  // namespace

void runSkyToSh(Trials& trials) {
  const int rows = trials.options().orders.size() > 4 ? 128 : 16;
  for (const auto& [kind, stress] : skies) {
    for (const int order : trials.options().orders)
      projectSky(kind, stress, rows, order, {"order", double(order)}, trials);
    for (const int more : trials.options().skyRows)
      projectSky(kind, stress, more, 3, {"rows of the sky", double(more)}, trials);
  }
}

void runSkyToHaar(Trials& trials) {
  for (const auto& [kind, stress] : skies)
    for (const int size : trials.options().faceSizes)
      if (size <= 64) sampleSky(kind, stress, 32, size, trials);
}

}  // namespace prelight::benchmarks::stability
