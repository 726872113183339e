#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/run/suite.h"

namespace prelight::benchmarks {

/// Options of the suite `visibility`; its table says what each means.
struct VisibilityOptions : RunOptions {
  std::vector<std::string> voScenes;
  std::uint64_t voRays;
  std::size_t voLights;
  std::size_t voPoints;
  std::uint64_t voCostRays;
  int voCostRounds;
  int voShadingRounds;
  std::uint64_t voShadingVertices;
  std::vector<std::size_t> voLightCounts;
  std::vector<std::string> nearLampScenes;
  int nearLampOrder;
  int nearLampShells;
  std::uint64_t nearLampRays;
  int nearLampWidth;
  int nearLampHeight;
  int nearLampSamples;
  std::vector<std::string> screenScenes;
  int screenWidth;
  int screenHeight;
  int screenRays;
  int screenFrames;
  std::vector<std::string> rasterisedScenes;
  std::size_t rasterisedReceivers;
  int rasterisedOrder;
  std::uint32_t rasterisedTruthRays;
  std::vector<int> rasterisedSides;

  static const OptionTable<VisibilityOptions>& table();

  /// Replaces the suite's own values by those of the command line.
  void takeGiven();
};

/// Error of the shadows of vector occluders by formula and records, compared with traced ones; processor time
/// that they add to a bake, and that of shading by the number of lights.
void runVo(const Device& device, const VisibilityOptions& options, SuiteRun& run);

/// Error of the direct light of point and area lights within the scene scenes, with shadows by shells of
/// distance and without, against shadow rays; what shells change about far lights and cost in rays. Needs
/// OpenGL.
void runNearLamps(const Device& device, const VisibilityOptions& options, SuiteRun& run);

/// Error of screen-space occlusion, compared with traced accessibility, and time per frame, by technique.
/// Writes its pictures into options.folder. Needs OpenGL.
void runScreen(const Device& device, const VisibilityOptions& options, SuiteRun& run);

/// Errors and processor time of SH of visibility and of gathers by each rasterised map, compared with rays.
/// Needs OpenGL.
void runRasterised(const Device& device, const VisibilityOptions& options, SuiteRun& run);

std::unique_ptr<Suite> visibilitySuite();

}  // namespace prelight::benchmarks
