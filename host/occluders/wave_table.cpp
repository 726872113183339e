#include "occluders/wave_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace prelight {

namespace {

/// A plane wave of the train.
struct Wave {
  int first = 0, second = 0;  ///< periods along the table's sides
  double phase = 0.0;         ///< radians
  double amplitude = 1.0;     ///< decreases with shorter waves, as on the sea
  glm::dvec3 axis{0.0};       ///< unit, direction of the displacement
};

/// Returns a uniform number in [0,1) that is the same with every compiler.
double uniform(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }

std::vector<Wave> makeTrain() {
  std::mt19937 random(7);
  std::vector<Wave> train;
  for (int i = 0; i <= 3; ++i) {
    for (int j = -3; j <= 3; ++j) {
      if (i == 0 && j <= 0) continue;  // equals another wave
      const double z = 2.0 * uniform(random) - 1.0, angle = 2.0 * std::numbers::pi * uniform(random);
      const double radius = std::sqrt(1.0 - z * z);
      train.push_back({i,
                       j,
                       2.0 * std::numbers::pi * uniform(random),
                       1.0 / std::hypot(i, j),
                       {radius * std::cos(angle), radius * std::sin(angle), z}});
    }
  }
  return train;
}

double fraction(double x) { return x - std::floor(x); }

}  // namespace

std::vector<glm::vec4> makeWaveTable() {
  const std::vector<Wave> train = makeTrain();
  std::vector<glm::dvec4> sums;
  double longest = 0.0, strongest = 0.0;
  for (int row = 0; row < waveTableSide; ++row) {
    for (int column = 0; column < waveTableSide; ++column) {
      glm::dvec4 sum(0.0);
      for (const Wave& wave : train) {
        const double turns = double(wave.first * column + wave.second * row) / waveTableSide;
        const double angle = 2.0 * std::numbers::pi * turns + wave.phase;
        sum += wave.amplitude * glm::dvec4(wave.axis * std::cos(angle), std::sin(angle));
      }
      sums.push_back(sum);
      longest = std::max(longest, glm::length(glm::dvec3(sum)));
      strongest = std::max(strongest, std::abs(sum.w));
    }
  }
  std::vector<glm::vec4> table;
  for (const glm::dvec4& sum : sums)
    table.emplace_back(glm::vec3(glm::dvec3(sum) / longest), float(sum.w / strongest));
  return table;
}

glm::dvec4 waveAt(std::span<const glm::vec4> table, double first, double second) {
  const double x = fraction(first) * waveTableSide, y = fraction(second) * waveTableSide;
  const int column = std::min(static_cast<int>(x), waveTableSide - 1);
  const int row = std::min(static_cast<int>(y), waveTableSide - 1);
  glm::dvec4 sum(0.0);
  for (int corner = 0; corner < 4; ++corner) {
    const int dx = corner % 2, dy = corner / 2;
    const double weight = (dx == 1 ? x - column : 1.0 - (x - column)) * (dy == 1 ? y - row : 1.0 - (y - row));
    const int at = (row + dy) % waveTableSide * waveTableSide + (column + dx) % waveTableSide;
    sum += weight * glm::dvec4(table[static_cast<std::size_t>(at)]);
  }
  return sum;
}

double effectMoment(double seconds) { return fraction(seconds / effectPeriod); }

}  // namespace prelight
