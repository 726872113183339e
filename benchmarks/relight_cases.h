#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/suite.h"
#include "prelight/device.h"

namespace prelight::benchmarks {

/// One kind of relighting, ready to run on random transfer.
struct RelightCase {
  std::string name;
  std::size_t items = 0;      ///< vertices, or texels of a sky
  std::size_t bytes = 0;      ///< read and written by a run
  double error = 0.0;         ///< RMS against the double reference, relative
  std::function<void()> run;  ///< launches and waits
};

/// Dense, compressed, clustered, keyed, light-group, Haar and glossy relighting of so many vertices.
std::vector<RelightCase> transferCases(const Device& device, std::size_t vertices);

/// Projection of a sky of so many rows onto SH and Haar, and rotation of its coefficients.
std::vector<RelightCase> lightCases(const Device& device, int rows);

}  // namespace prelight::benchmarks
