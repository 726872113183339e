#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "prelight/techniques.h"

namespace prelight {

/// A pass of a bake or a picture, by its name in files and messages. A technique may define further ones in
/// its folder.
struct Pass {
  std::string_view name;

  operator std::string() const { return std::string(name); }

  static const Pass Cast;
  static const Pass ShadowSets;
  static const Pass AmbientOcclusion;
  static const Pass ShTransfer;
  static const Pass ChTransfer;
  static const Pass HaarTransfer;
  static const Pass GlossyTransfer;
  static const Pass LightGroups;
  static const Pass VectorOccluders;
  static const Pass CausticVectors;
  static const Pass SpecularVectors;
  static const Pass Volume;
  static const Pass ChartTransfer;
  static const Pass Bounces;
  static const Pass Radiosity;
  static const Pass FormFactors;
  static const Pass LightMap;
  static const Pass TexelSizes;
  static const Pass DirectLightOfTheMap;
  static const Pass SkyLightOfTheMap;
  static const Pass IndirectLightOfTheMap;
  static const Pass CausticsOfTheMap;
  static const Pass DirectionsOfTheMap;
  static const Pass EncodedLight;
  static const Pass BackFaces;
  static const Pass TranslucentSenders;
  static const Pass AlphaTest;
  static const Pass AlbedoTextures;
  static const Pass SpecularTransport;
  static const Pass IndirectLight;
  static const Pass CausticPhotons;
  static const Pass RaysToLargeEmitters;
  static const Pass BacksOfOneSidedSurfaces;
  static const Pass DirectLight;
  static const Pass FurtherVertices;
  static const Pass VirtualLights;
  static const Pass PunctualLights;
  static const Pass Emitters;
  static const Pass Sky;
  static const Pass Mirrors;
  static const Pass GlossyLobes;
  static const Pass Glass;
  static const Pass LightThroughSurfaces;
  static const Pass Absorption;
  static const Pass Textures;
  static const Pass ShadowMaps;
  static const Pass EnvironmentMaps;
  static const Pass OcclusionCones;
  static const Pass Instances;
  static const Pass NearLamps;
  static const Pass Horizons;
  static const Pass SubsurfaceTransport;
  static const Pass ObjectCubes;
};
inline constexpr Pass Pass::Cast{"cast"};
inline constexpr Pass Pass::ShadowSets{"shadow sets"};
inline constexpr Pass Pass::AmbientOcclusion{"ambient occlusion"};
inline constexpr Pass Pass::ShTransfer{"sh transfer"};
inline constexpr Pass Pass::ChTransfer{"ch transfer"};
inline constexpr Pass Pass::HaarTransfer{"haar transfer"};
inline constexpr Pass Pass::GlossyTransfer{"glossy transfer"};
inline constexpr Pass Pass::LightGroups{"light groups"};
inline constexpr Pass Pass::VectorOccluders{"vector occluders"};
inline constexpr Pass Pass::CausticVectors{"caustic vectors"};
inline constexpr Pass Pass::SpecularVectors{"specular vectors"};
inline constexpr Pass Pass::Volume{"volume"};
inline constexpr Pass Pass::ChartTransfer{"texels"};
inline constexpr Pass Pass::Bounces{"bounces"};
inline constexpr Pass Pass::Radiosity{"radiosity"};
inline constexpr Pass Pass::FormFactors{"form factors"};
inline constexpr Pass Pass::LightMap{"light map"};
inline constexpr Pass Pass::TexelSizes{"texel sizes"};
inline constexpr Pass Pass::DirectLightOfTheMap{"direct light of the map"};
inline constexpr Pass Pass::SkyLightOfTheMap{"sky light of the map"};
inline constexpr Pass Pass::IndirectLightOfTheMap{"indirect light of the map"};
inline constexpr Pass Pass::CausticsOfTheMap{"caustics of the map"};
inline constexpr Pass Pass::DirectionsOfTheMap{"directions of the map"};
inline constexpr Pass Pass::EncodedLight{"encoded light"};
inline constexpr Pass Pass::BackFaces{"back faces"};
inline constexpr Pass Pass::TranslucentSenders{"translucent senders"};
inline constexpr Pass Pass::AlphaTest{"alpha test"};
inline constexpr Pass Pass::AlbedoTextures{"albedo textures"};
inline constexpr Pass Pass::SpecularTransport{"specular transport"};
inline constexpr Pass Pass::IndirectLight{"indirect light"};
inline constexpr Pass Pass::CausticPhotons{"caustic photons"};
inline constexpr Pass Pass::RaysToLargeEmitters{"rays to large emitters"};
inline constexpr Pass Pass::BacksOfOneSidedSurfaces{"backs of one-sided surfaces"};
inline constexpr Pass Pass::DirectLight{"direct light"};
inline constexpr Pass Pass::FurtherVertices{"further vertices"};
inline constexpr Pass Pass::VirtualLights{"virtual lights"};
inline constexpr Pass Pass::PunctualLights{"punctual lights"};
inline constexpr Pass Pass::Emitters{"emitters"};
inline constexpr Pass Pass::Sky{"sky"};
inline constexpr Pass Pass::Mirrors{"mirrors"};
inline constexpr Pass Pass::GlossyLobes{"glossy lobes"};
inline constexpr Pass Pass::Glass{"glass"};
inline constexpr Pass Pass::LightThroughSurfaces{"light through surfaces"};
inline constexpr Pass Pass::Absorption{"absorption"};
inline constexpr Pass Pass::Textures{"textures"};
inline constexpr Pass Pass::ShadowMaps{"shadow maps"};
inline constexpr Pass Pass::EnvironmentMaps{"environment maps"};
inline constexpr Pass Pass::OcclusionCones{"occlusion cones"};
inline constexpr Pass Pass::Instances{"instances"};
inline constexpr Pass Pass::NearLamps{"near lamps"};
inline constexpr Pass Pass::Horizons{"horizons"};
inline constexpr Pass Pass::SubsurfaceTransport{"subsurface transport"};
inline constexpr Pass Pass::ObjectCubes{"object cubes"};

/// A pass, and why it runs or is skipped.
struct PlannedPass {
  std::string name;
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
