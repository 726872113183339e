#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "prelight/light_map.h"
#include "prelight/request.h"
#include "prelight/transfer.h"

/// Techniques as users see them: what is asked of each, what a bake holds of it, and how it is drawn. No
/// other public header lists them.
namespace prelight {

/// The request of a bake: a part per technique, and options that all techniques share.
struct BakeRequest {
  bool ao = false;         ///< ambient occlusion and bent normal
  bool cones = false;      ///< aperture of the unoccluded cone about the bent normal; requires `ao`
  bool thickness = false;  ///< thickness of bodies
  HorizonsRequest horizons = {};
  ShRequest sh = {};
  ChRequest ch = {};
  NearLampsRequest nearLamps = {};
  HaarRequest haar = {};
  GlossyRequest glossy = {};
  LightGroupsRequest lightGroups = {};
  OccluderRequest occluders = {};
  VolumeRequest volume = {};
  ChartTransferRequest chartTransfer = {};
  RadiosityRequest radiosity = {};
  LightMapRequest lightMap = {};
  EncodedLightRequest encodedLight = {};

  int bounces = 0;  ///< diffuse interreflections, 0..16
  /// Rays that meet glass, mirrors or metal continue from there, in all techniques that carry light.
  bool specular = false;
  /// With `specular`: rays also continue from rough lobes of all other materials.
  bool glossyBounces = false;
  /// Keeps light that comes through surfaces diffusely and through the insides of bodies, for AO, SH, CH and
  /// Haar wavelets.
  bool subsurface = false;
  /// How the hemispheres of receivers are seen. Drawn ones serve AO, cones, SH and CH, without bounces.
  Visibility visibility = Visibility::Rays;
  OcclusionLimits limits = {};
  /// Nodes that match none of these are shadowed by everything.
  std::vector<ShadowSetRequest> shadowSets = {};
  Effort effort = {};
  std::uint64_t seed = 0;

  /// Bytes that the bake may take: data without room is kept in a file, and a bake that needs more all the
  /// same is refused. None: 400 bytes per triangle and 300 MB, defaultMemory for what memory() bounds, and no
  /// bake is refused.
  std::optional<std::uint64_t> maxMemory = std::nullopt;
  static constexpr std::uint64_t defaultMemory = std::uint64_t{2} << 30;
  std::uint64_t memory() const { return maxMemory.value_or(defaultMemory); }

  /// Returns whether any requested technique carries light, which AO does not.
  bool carriesLight() const {
    return sh.order > 0 || ch.order > 0 || haar.size > 0 || glossy.order > 0 || lightGroups.wanted;
  }

  /// Returns whether any requested technique is projected from the hemispheres of receivers.
  bool castsReceivers() const {
    return ao || thickness || horizons.sectors > 0 || occluders.wanted || carriesLight();
  }
  bool anything() const { return castsReceivers() || radiosity.wanted || lightMap.wanted; }

  /// Returns a request with the same shared options, which asks for no technique.
  BakeRequest withoutTechniques() const;

  static constexpr int maxShOrder = 32;
  static constexpr int maxShells = 32;
  static constexpr int usualShells = 8;
  static constexpr int minSectors = 3;
  static constexpr int maxSectors = 64;
  static constexpr int maxGlossyOrder = 8;
  static constexpr int maxHaarSize = 128;
  static constexpr int maxVolumeSize = 64;
  static constexpr int maxChartSize = 4096;
  static constexpr int maxBounces = 16;
  static constexpr std::uint64_t maxRays = 1u << 20;
};

/// Baked values of techniques for every vertex of a CompiledScene, in its vertex order. Techniques that were
/// not requested are empty.
struct TechniqueParts {
  std::vector<float> ao;               ///< [vertex], cosine-weighted accessibility in [0,1], 1 = open
  std::vector<glm::vec3> bentNormals;  ///< [vertex], unit
  /// [vertex], 0..1: cosine of half the opening angle of the cone about the bent normal that lets through as
  /// much as `ao` says.
  std::vector<float> apertures;
  std::vector<float> thickness;  ///< [vertex], mean length of rays through the body below, m; 0: no body
  std::optional<HorizonTransfer> horizons;
  std::optional<HarmonicTransfer> sh;
  std::optional<CompressedTransfer> compressedSh;  ///< in place of `sh`
  std::optional<HarmonicTransfer> ch;
  std::optional<NearLampTransfer> nearLamps;  ///< shadows of lamps within the scene
  /// SH at moments of an animation; `sh` belongs to the rest pose.
  std::optional<AnimatedTransfer> animation;
  std::optional<HaarTransfer> haar;
  /// Light that arrives at the other side of surfaces, for the techniques above.
  std::optional<ThroughTransfer> through;
  std::optional<GlossyTransfer> glossy;
  std::optional<LightGroupTransfer> lightGroups;
  std::optional<OccluderTransfer> occluders;
  std::optional<VolumeTransfer> volume;        ///< at points in the air
  std::optional<ChartTransfer> chartTransfer;  ///< at the texels of charts
  CompressedParts compressedParts;   ///< compressed forms of `animation`, `volume` and `chartTransfer`
  std::optional<LightMap> lightMap;  ///< light of the scene's own lights
  /// [vertex], irradiance in W/m2 due to the scene's static lights.
  std::optional<std::vector<glm::vec3>> irradiance;
  std::vector<EncodedLight> encodedLight;  ///< at the front of vertices, one entry per encoding
};

/// How light reaches a surface in a picture that is drawn (docs/drawing.md).
enum class Shading : std::uint8_t {
  Phong,               ///< direct light without shadows, ambient from the open sky
  Ao,                  ///< Phong with the ambient light occluded by the baked accessibility
  Sh,                  ///< light through the baked SH transfer, compressed or not
  Ch,                  ///< light through the baked CH transfer
  Haar,                ///< light through the baked wavelet transfer
  Glossy,              ///< diffuse and glossy reflection through transfer matrices
  Lights,              ///< the scene's own lights through light-group transfer, with shadows
  Vo,                  ///< lights anywhere with the shadows and the diffuse light of vector occluders
  Radiosity,           ///< the baked irradiance of the scene's own lights, with all diffuse bounces
  LightMap,            ///< the light of the scene's own lights from the texels of a light map
  Cones,               ///< sky, lights and reflections through the baked cone about the bent normal
  GlobalIllumination,  ///< all light: direct with shadow maps, indirect from a map, caustics, mirrors and
                       ///< glass
  Screen,              ///< Ao with an accessibility that is found in the picture itself, without a bake
  Horizons,            ///< sky, lights and reflections above the baked horizons
  Instant,             ///< direct light with shadow maps, indirect light of virtual lights with theirs
  Thickness,           ///< Phong with light that shines through bodies as far as they are thin
};

/// Name for the command line and files; empty for a number that no shading has.
constexpr std::string_view shadingName(Shading shading) {
  switch (shading) {
    case Shading::Phong:
      return "phong";
    case Shading::Ao:
      return "ao";
    case Shading::Sh:
      return "sh";
    case Shading::Ch:
      return "ch";
    case Shading::Haar:
      return "haar";
    case Shading::Glossy:
      return "glossy";
    case Shading::Lights:
      return "lights";
    case Shading::Vo:
      return "vo";
    case Shading::Radiosity:
      return "radiosity";
    case Shading::LightMap:
      return "lightmap";
    case Shading::Cones:
      return "cones";
    case Shading::GlobalIllumination:
      return "full";
    case Shading::Screen:
      return "screen";
    case Shading::Horizons:
      return "horizons";
    case Shading::Instant:
      return "instant";
    case Shading::Thickness:
      return "thickness";
  }
  return {};
}

}  // namespace prelight
