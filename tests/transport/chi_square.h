#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "transport/bsdf_probe.h"

namespace prelight::test {

/// Directions over the sphere on a grid of equal solid angles.
inline std::vector<glm::vec4> sphereGrid(int rings, int sectors) {
  std::vector<glm::vec4> directions;
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < sectors; ++s)
      directions.push_back(
          directionOf(2.0 * (r + 0.5) / rings - 1.0, 2.0 * std::numbers::pi * ((s + 0.5) / sectors - 0.5)));
  return directions;
}

/// Chi-square test of a surface's samples against its density, over cells of equal solid angle, with expected
/// counts by quadrature of the density. The number of samples that go nowhere must match the missing part of
/// the density.
inline void expectSamplesToFollowDensity(const BsdfProbe& surface, double cosine) {
  constexpr int rings = 24, sectors = 16, fine = 24;
  constexpr std::size_t count = 1 << 17;
  const glm::vec4 wo = directionOf(cosine, 1.0);
  const auto cellOf = [](const glm::vec4& w) {
    const double turn =
        std::atan2(static_cast<double>(w.y), static_cast<double>(w.x)) / (2.0 * std::numbers::pi) + 0.5;
    const int ring =
        std::clamp(static_cast<int>((static_cast<double>(w.z) + 1.0) / 2.0 * rings), 0, rings - 1);
    return static_cast<std::size_t>(ring * sectors + std::min(sectors - 1, static_cast<int>(turn * sectors)));
  };
  std::vector<double> found(rings * sectors, 0.0), expected(rings * sectors, 0.0);
  double lost = 0.0, all = 0.0;
  for (const ProbedSample& drawn : surface.sample(wo, count))
    ++(drawn.goesOn() ? found[cellOf(drawn.direction)] : lost);
  const std::vector<glm::vec4> wi = sphereGrid(rings * fine, sectors * fine);
  const Probed probed = surface.probe(std::vector<glm::vec4>(wi.size(), wo), wi);
  const double cell = 4.0 * std::numbers::pi / static_cast<double>(wi.size()) * count;
  for (std::size_t i = 0; i < wi.size(); ++i) {
    expected[cellOf(wi[i])] += static_cast<double>(probed.densities[i]) * cell;
    all += static_cast<double>(probed.densities[i]) * cell;
  }
  double chiSquare = 0.0;
  int cells = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (expected[i] < 50.0) continue;
    chiSquare += (found[i] - expected[i]) * (found[i] - expected[i]) / expected[i];
    ++cells;
  }
  // Low-discrepancy points scatter less than random ones; the upper bound is that of random points at 4
  // sigma.
  EXPECT_LT(chiSquare, cells + 4.0 * std::sqrt(2.0 * cells)) << "cosine " << cosine;
  EXPECT_GT(cells, 10);
  EXPECT_NEAR(all, count - lost, 4.0 * std::sqrt(static_cast<double>(count))) << "cosine " << cosine;
}

}  // namespace prelight::test
