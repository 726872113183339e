#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "plan/radiosity_request.h"

namespace prelight {

/// Lights that are to be one group: those whose name, or whose node's, a pattern matches (* and ?).
struct LightGroupRequest {
  std::string name;
  std::vector<std::string> patterns;
};

/// Receivers of the nodes that the first patterns match are shadowed by those that the second match.
struct ShadowSetRequest {
  std::vector<std::string> receivers;
  std::vector<std::string> occluders;  ///< none: nothing shadows them
};

/// What makes an occluder of vector occluders.
enum class OccluderKind : std::uint8_t { Node, Mesh, Material, Auto };

/// What the user asked a bake for.
struct BakeRequest {
  bool ao = false;           ///< ambient occlusion and bent normal
  int shOrder = 0;           ///< 0: none; 1..maxShOrder
  int chOrder = 0;           ///< 0: none; 1..maxShOrder
  bool chNaive = false;      ///< store inner products instead of dual coefficients, to show what that costs
  int haarSize = 0;          ///< 0: none; a power of two up to maxHaarSize
  double haarError = 0.02;   ///< relative L2 error that sparse storage may make, 0..1
  int glossyOrder = 0;       ///< 0: none; 1..maxGlossyOrder
  bool lightGroups = false;  ///< transfer of the scene's own lights
  std::vector<LightGroupRequest> namedGroups;  ///< lights that none of these names are groups of their own
  bool occluders = false;                      ///< vector occluders
  OccluderKind occluderKind = OccluderKind::Node;
  double occluderRecords = 8.0;  ///< Auto: records a vertex, in the mean, > 0
  double leastFormFactor = 0.0;  ///< occluders that hide less of the sky than this are dropped, 0..1
  int volumeSize = 0;  ///< voxels along the scene's longest side; 0: none; needs shOrder, which is its order
  int texelSize = 0;   ///< texels along the largest light map, 0: none; needs shOrder, which is its order
  bool radiosity = false;           ///< irradiance of the scene's static lights at every vertex
  RadiosityRequest radiosityShape;  ///< what it is solved with
  bool lightMap = false;            ///< irradiance of the scene's static lights, texel by texel
  double lightMapTexel = 0.0;       ///< side of its texels, m, with an error of the smallest; 0: chosen
  double lightMapError = 0.0;  ///< that interpolation may make, see TexelSizeRequest; 0: texels of one size
  bool caustics = false;       ///< in the light map, which it needs
  std::uint64_t photons = 0;   ///< of the light map; 0: chosen by its texels
  int bounces = 0;             ///< diffuse interreflections, 0..16
  double nearLimit = 0.0;      ///< m, >= 0; what is nearer to a receiver occludes nothing
  double farLimit = 0.0;       ///< m; what is farther occludes nothing; 0: no limit
  double obscurance = 0.0;     ///< m; occlusion fades out linearly up to this distance; 0: it does not
  std::vector<ShadowSetRequest> shadowSets;  ///< nodes that none of these name see everything
  std::uint64_t rays = 1024;                 ///< rays a vertex, on average; ignored with error or seconds
  std::optional<double> error;    ///< stop when AO's estimated standard error is below this at every vertex
  std::optional<double> seconds;  ///< stop after this time
  std::uint64_t seed = 0;
  std::uint64_t maxMemory = std::uint64_t{2} << 30;  ///< bytes that the bake's own buffers may take

  /// Anything that light is carried by, other than AO.
  bool carriesLight() const {
    return shOrder > 0 || chOrder > 0 || haarSize > 0 || glossyOrder > 0 || lightGroups;
  }

  /// Anything that is projected from the hemispheres of receivers.
  bool castsReceivers() const { return ao || occluders || carriesLight(); }
  bool anything() const { return castsReceivers() || radiosity || lightMap; }

  /// The same effort, limits and seed, with nothing to make.
  BakeRequest withoutTechniques() const;

  static constexpr int maxShOrder = 32;
  static constexpr int maxGlossyOrder = 8;
  static constexpr int maxHaarSize = 128;
  static constexpr int maxVolumeSize = 64;
  static constexpr int maxTexelSize = 4096;
  static constexpr int maxBounces = 16;
  static constexpr std::uint64_t maxRays = 1u << 20;
};

/// Bands of SH that bounces carry, for every technique that has them: 0 when only AO or lights are asked for.
int transferOrder(const BakeRequest& request);

/// Bands of SH that rays are projected to.
int castOrder(const BakeRequest& request);

}  // namespace prelight
