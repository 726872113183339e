#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/run/suite.h"

namespace prelight::benchmarks {

/// Options of the suite `pictures`; its table says what each means.
struct PicturesOptions : RunOptions {
  int referenceSize;
  std::vector<std::uint64_t> referenceSamples;
  std::uint64_t referenceLongRun;
  std::vector<std::uint64_t> materialRays;
  std::vector<int> materialOrders;
  std::vector<std::uint64_t> materialSamples;
  std::uint64_t materialTruthSamples;
  int materialWidth;
  int materialHeight;
  std::vector<std::string> objectModels;
  std::uint64_t objectRays;
  int objectMoves;
  std::uint64_t objectSamples;
  int objectWidth;
  int objectHeight;

  static const OptionTable<PicturesOptions>& table();

  /// Replaces the suite's own values by those of the command line.
  void takeGiven();
};

/// Error and time of the reference renderer by the number of samples, and the error that it reports.
void runReference(const Device& device, const PicturesOptions& options, SuiteRun& run);

/// Error and time of pictures with all light by samples per pixel, compared with path tracing to the same
/// error.
void runFull(const Device& device, const PicturesOptions& options, SuiteRun& run);

/// Errors of pictures around objects that were put into baked scenes, compared with path-traced ones, and the
/// time of a move, by how shadows are computed. Needs OpenGL.
void runObjects(const Device& device, const PicturesOptions& options, SuiteRun& run);

/// Errors and time of pictures of scattering bodies and measured materials, compared with path-traced ones,
/// and of light in grooves of a normal texture, compared with marching along its heights. Needs OpenGL.
void runMaterials(const Device& device, const PicturesOptions& options, SuiteRun& run);

std::unique_ptr<Suite> picturesSuite();

}  // namespace prelight::benchmarks
