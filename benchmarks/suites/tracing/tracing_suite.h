#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "benchmarks/run/suite.h"

namespace prelight::benchmarks {

/// Options of the suite `tracing`; its table says what each means.
struct TracingOptions : RunOptions {
  std::uint64_t castRays;
  std::uint64_t rayCount;
  int rayRounds;
  std::vector<std::uint64_t> rayTriangles;
  std::vector<std::uint64_t> scalingTriangles;

  static const OptionTable<TracingOptions>& table();
};

/// Rays per second through the tree of each built-in scene, in bake order and at random, against the other
/// tree layout.
void runCast(const Device& device, const TracingOptions& options, SuiteRun& run);

/// Rays per second of several kinds through detailed rooms of growing size, against Embree.
void runRays(const Device& device, const TracingOptions& options, SuiteRun& run);

/// Seconds, bytes and steps per ray of the tree of each build quality.
void runTrees(const Device& device, const TracingOptions& options, SuiteRun& run);

/// Seconds and bytes of the trees over detailed rooms, against Embree.
void runBuild(const Device& device, const TracingOptions& options, SuiteRun& run);

/// Rays per second and seconds and bytes of the tree, from a thousand to ten million triangles, against
/// Embree.
void runScaling(const Device& device, const TracingOptions& options, SuiteRun& run);

std::unique_ptr<Suite> tracingSuite();

}  // namespace prelight::benchmarks
