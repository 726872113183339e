#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "prelight/request.h"

namespace prelight {

/// Passes of a bake or a picture; nameOf() returns their names.
enum class Pass : std::uint8_t {
  Cast,
  ShadowSets,
  AmbientOcclusion,
  ShTransfer,
  ChTransfer,
  HaarTransfer,
  GlossyTransfer,
  LightGroups,
  VectorOccluders,
  CausticVectors,
  SpecularVectors,
  Volume,
  ChartTransfer,
  Bounces,
  Radiosity,
  FormFactors,
  LightMap,
  TexelSizes,
  DirectLightOfTheMap,
  SkyLightOfTheMap,
  IndirectLightOfTheMap,
  CausticsOfTheMap,
  DirectionsOfTheMap,
  EncodedLight,
  BackFaces,
  TranslucentSenders,
  AlphaTest,
  AlbedoTextures,
  SpecularTransport,
  IndirectLight,
  CausticPhotons,
  RaysToLargeEmitters,
  BacksOfOneSidedSurfaces,
  DirectLight,
  FurtherVertices,
  VirtualLights,
  PunctualLights,
  Emitters,
  Sky,
  Mirrors,
  GlossyLobes,
  Glass,
  LightThroughSurfaces,
  Absorption,
  Textures,
  ShadowMaps,
  EnvironmentMaps,
  OcclusionCones,
  Instances,
  NearLamps,
  Horizons,
  SubsurfaceTransport,
  ObjectCubes,
  Count,  ///< their number, no pass
};

/// Returns the name of a pass in files and messages.
std::string_view nameOf(Pass pass);

/// Returns the pass of a name in a file, or nothing for an unknown name.
std::optional<Pass> passNamed(std::string_view name);

/// A pass, and why it runs or is skipped.
struct PlannedPass {
  Pass pass = Pass::Cast;
  bool runs = false;
  std::string reason;

  bool operator==(const PlannedPass&) const = default;
};

/// The passes of a bake, chosen by scene and request, and the memory that they take.
struct Plan {
  std::vector<PlannedPass> passes;
  std::uint64_t hostBytes = 0;
  std::uint64_t deviceBytes = 0;
  std::uint64_t transportBytes = 0;  ///< included above: stored hits that feed the bounces
  std::uint64_t texelBytes = 0;      ///< included above: rays that are kept per texel
  std::uint64_t recordBytes = 0;     ///< included above: records of receivers, for errors and bounces
  bool parks = false;                ///< whether sums lie in a temporary file while they are not needed

  bool runs(Pass pass) const;
  bool operator==(const Plan&) const = default;
};

}  // namespace prelight
