#pragma once

#include <string>

#include "benchmarks/plot_parts.h"

/// Charts of errors against time, size or number, as SVG.
namespace prelight::benchmarks {

/// Error of ambient occlusion against time.
std::string errorPlot(const Results& results, const std::string& subtitle);

/// Error of the reference renderer against time.
std::string referencePlot(const Results& results, const std::string& subtitle);

/// Error of pictures with all light against time.
std::string globalIlluminationPlot(const Results& results, const std::string& subtitle);

/// Error of indirect light against time by how it is gathered.
std::string gatherPlot(const Results& results, const std::string& subtitle);

/// What indirect light tends to beside its truth, by way of gathering.
std::string gatherBiasPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle);

/// Error of lighting by Haar wavelets against coefficients of the light.
std::string waveletsPlot(const Results& results, const std::string& subtitle);

/// Error of compressed transfer against its size.
std::string compressPlot(const Results& results, const std::string& subtitle);

/// Residual of the radiosity equation against work.
std::string radiosityPlot(const Results& results, const std::string& subtitle);

/// Error of irradiance from photons against their number.
std::string photonsPlot(const Results& results, const std::string& subtitle);

/// Errors of bodies, measured materials and reliefs against time.
std::string materialsPlot(const Results& results, const std::string& subtitle);

/// Error of light maps against their texels.
std::string lightMapsPlot(const Results& results, const std::string& subtitle);

}  // namespace prelight::benchmarks
