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

  /// Replaces the suite's own values by those that the command line gives.
  void takeGiven();
};

/// Error and time of the reference renderer for growing numbers of samples, and the error that it reports.
void runReference(const Device& device, const PicturesOptions& options, SuiteRun& run);

/// Error and time of pictures with all light, by samples per pixel, against path tracing to the same error.
void runFull(const Device& device, const PicturesOptions& options, SuiteRun& run);

/// How far pictures are from path-traced ones where objects that were put into scenes shade them, by how
/// their shadows are found, and what each takes when an object moves. Needs OpenGL.
void runObjects(const Device& device, const PicturesOptions& options, SuiteRun& run);

/// Errors of pictures of bodies that scatter light and of measured materials against path-traced ones, and of
/// the light in grooves of a normal texture against marching along its heights, over the time that they take.
/// Needs OpenGL.
void runMaterials(const Device& device, const PicturesOptions& options, SuiteRun& run);

std::unique_ptr<Suite> picturesSuite();

}  // namespace prelight::benchmarks
