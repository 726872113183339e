#pragma once

#include <string>
#include <vector>

#include "benchmarks/suite.h"

/// Charts of the suites about baked transfer, as SVG.
namespace prelight::benchmarks {

/// FLIP of every technique, by scene.
std::string techniquesPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle);

/// Errors of shadows of near lamps over those without shadows, by scene and lamp.
std::string nearLampsPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle);

/// Errors of objects' shadows, by scene and how they are found.
std::string objectsPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle);

/// Errors of screen-space occlusion, by scene and technique.
std::string screenPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle);

/// Errors of rasterised SH, by scene and map.
std::string rasterisedPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle);

/// Errors of pictures of live light, by scene and by what its effort is spent on.
std::string liveLightPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle);

/// Error between keys, by scene and choice of keys.
std::string animationPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle);

/// Time of evaluating SH and CH, by order and way.
std::string basisPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle);

/// Errors of encodings of incident light, by scene.
std::string encodingsPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle);

/// What features cost that are present but not needed.
std::string skipPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle);

/// Errors of shadows with lights around each scene.
std::string voPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle);

}  // namespace prelight::benchmarks
