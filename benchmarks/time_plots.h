#pragma once

#include <string>

#include "benchmarks/plot_parts.h"

/// Charts of the time that bakes, frames and kernels take, as SVG.
namespace prelight::benchmarks {

/// Seconds of a bake, by stage.
std::string bakePlot(const Results& results, const std::string& subtitle);

/// Bytes a second of relighting, against copying.
std::string relightPlot(const Results& results, const std::string& subtitle);

/// Milliseconds of a frame in which light follows what moves.
std::string updatePlot(const Results& results, const std::string& subtitle);

/// Milliseconds of a frame of the window at each size, by scene and shading.
std::string viewerPlot(const Results& results, const std::string& subtitle);

/// What a frame of the window costs, by part, at the largest size.
std::string viewerPartsPlot(const Results& results, const std::string& subtitle);

/// Milliseconds from an input to the finished picture at the largest size, by scene, shading and input.
std::string viewerLatencyPlot(const Results& results, const std::string& subtitle);

}  // namespace prelight::benchmarks
