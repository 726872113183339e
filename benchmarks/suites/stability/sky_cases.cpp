#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "basis/cube_map.h"
#include "basis/haar.h"
#include "basis/sh_projection.h"
#include "benchmarks/lab/light_projector.h"
#include "benchmarks/suites/stability/cases.h"

namespace prelight::benchmarks::stability {

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

/// Flux over 4 pi, a channel: coefficients are at most a band's greatest value times the flux.
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
  // A row adds up in 16 lanes, the rows in runs of 32, the runs one after the other; then a rotation to the
  // world's axes, whose rows have 2 l + 1 entries of which squares add up to 1.
  const double terms = rows / 8.0 + 5.0 + 32.0 + rows / 32.0 + 2.0;
  const double rotation = (2.0 * order + 1.0) * std::sqrt(2.0 * order + 1.0);
  trials.record(stress, differences, sumBound(terms + rotation), std::move(growth));
}

void sampleSky(Sky kind, const char* stress, int rows, int faceSize, Trials& trials) {
  const Environment sky = makeSky(kind, rows);
  LightProjector projector(trials.context(), sky.width, sky.height, 1);
  projector.setSky(sky);
  constexpr int samples = 4;
  const std::vector<float> got = projector.projectHaar(faceSize, samples);
  const std::size_t texels = cubeTexelCount(faceSize), face = static_cast<std::size_t>(faceSize * faceSize);
  // Points computed in double precision. Those that rounding may take to the neighbouring texel of the sky
  // have no one right value: what they may change is taken off the difference.
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
  trials.record(stress, differences, sumBound(terms * faceSize), {"texels a side", double(faceSize)});
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
