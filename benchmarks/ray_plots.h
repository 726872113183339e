#pragma once

#include <string>

#include "benchmarks/plot_parts.h"

/// Charts of the suites about rays and the trees they go through, as SVG.
namespace prelight::benchmarks {

/// Rays a second through each tree.
std::string castPlot(const Results& results, const std::string& subtitle);

/// Rays a second through detailed rooms.
std::string raysPlot(const Results& results, const std::string& subtitle);

/// Seconds to build the tree over detailed rooms.
std::string buildPlot(const Results& results, const std::string& subtitle);

/// Steps of a ray through the tree.
std::string treesPlot(const Results& results, const std::string& subtitle);

/// Rays a second as scenes grow.
std::string scalingPlot(const Results& results, const std::string& subtitle);

/// Seconds to build the tree as scenes grow.
std::string scalingBuildPlot(const Results& results, const std::string& subtitle);

}  // namespace prelight::benchmarks
