#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "prelight/request.h"

namespace prelight {

/// Passes of a bake or a picture; passNames has their names.
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
};

/// Names of passes in files and messages, [Pass].
constexpr std::array<std::string_view, 53> passNames = {"cast",
                                                        "shadow sets",
                                                        "ambient occlusion",
                                                        "sh transfer",
                                                        "ch transfer",
                                                        "haar transfer",
                                                        "glossy transfer",
                                                        "light groups",
                                                        "vector occluders",
                                                        "caustic vectors",
                                                        "specular vectors",
                                                        "volume",
                                                        "texels",
                                                        "bounces",
                                                        "radiosity",
                                                        "form factors",
                                                        "light map",
                                                        "texel sizes",
                                                        "direct light of the map",
                                                        "sky light of the map",
                                                        "indirect light of the map",
                                                        "caustics of the map",
                                                        "directions of the map",
                                                        "encoded light",
                                                        "back faces",
                                                        "translucent senders",
                                                        "alpha test",
                                                        "albedo textures",
                                                        "specular transport",
                                                        "indirect light",
                                                        "caustic photons",
                                                        "rays to large emitters",
                                                        "backs of one-sided surfaces",
                                                        "direct light",
                                                        "further vertices",
                                                        "virtual lights",
                                                        "punctual lights",
                                                        "emitters",
                                                        "sky",
                                                        "mirrors",
                                                        "glossy lobes",
                                                        "glass",
                                                        "light through surfaces",
                                                        "absorption",
                                                        "textures",
                                                        "shadow maps",
                                                        "environment maps",
                                                        "occlusion cones",
                                                        "instances",
                                                        "near lamps",
                                                        "horizons",
                                                        "subsurface transport",
                                                        "object cubes"};

constexpr std::string_view nameOf(Pass pass) { return passNames[static_cast<std::size_t>(pass)]; }

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
