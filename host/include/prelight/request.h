#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "prelight/picture.h"

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

/// Spherical harmonics of transfer.
struct ShRequest {
  int order = 0;  ///< 0: none; 1..BakeRequest::maxShOrder
};

/// "Cpherical" harmonics of transfer.
struct ChRequest {
  int order = 0;       ///< 0: none; 1..BakeRequest::maxShOrder
  bool naive = false;  ///< store inner products instead of dual coefficients, to show what that costs
};

/// Shadows of lamps within the scene, from how far the rays of SH or CH transfer went; of the greater of
/// their orders, one of which it needs.
struct NearLampsRequest {
  int shells = 0;  ///< of distance; 0: none; 2..BakeRequest::maxShells
};

/// Horizons of sectors of azimuth around every vertex's normal.
struct HorizonsRequest {
  int sectors = 0;  ///< 0: none; BakeRequest::minSectors..BakeRequest::maxSectors
};

/// Haar wavelets of transfer, on cube maps.
struct HaarRequest {
  int size = 0;         ///< 0: none; a power of two up to BakeRequest::maxHaarSize
  double error = 0.02;  ///< relative L2 error that sparse storage may make, 0..1
};

/// Matrices from incident to reflected radiance.
struct GlossyRequest {
  int order = 0;  ///< 0: none; 1..BakeRequest::maxGlossyOrder
};

/// Transfer of the scene's own lights.
struct LightGroupsRequest {
  bool wanted = false;
  std::vector<LightGroupRequest> named = {};  ///< lights that none of these names are groups of their own

  explicit operator bool() const { return wanted; }
};

/// Vector occluders.
struct OccluderRequest {
  bool wanted = false;
  OccluderKind kind = OccluderKind::Node;
  double records = 8.0;          ///< Auto: records a vertex, in the mean, > 0
  double leastFormFactor = 0.0;  ///< occluders that hide less of the sky than this are dropped, 0..1

  explicit operator bool() const { return wanted; }
};

/// SH transfer of points in the air; of the order of SH, which it needs.
struct VolumeRequest {
  int size = 0;  ///< voxels along the scene's longest side; 0: none
};

/// SH transfer at the texels of charts, with the normals of normal maps; of the order of SH, which it needs.
struct ChartTransferRequest {
  int size = 0;         ///< texels along the largest chart; 0: none
  bool relief = false;  ///< bumps of normal textures shadow one another
};

/// How the radiosity equation is solved (docs/radiosity.md).
enum class RadiosityMethod : std::uint8_t { Jacobi, Chebyshev, GaussSeidel, Southwell };

constexpr std::array<std::string_view, 4> radiosityMethodNames = {"jacobi", "chebyshev", "gauss-seidel",
                                                                  "southwell"};

/// Irradiance of the scene's static lights at every vertex, by the radiosity equation. A bake's effort and
/// seed count too.
struct RadiosityRequest {
  bool wanted = false;
  double patchSize = 0.0;  ///< m, longest edge of an element at most; 0: from the scene's surface
  RadiosityMethod method = RadiosityMethod::GaussSeidel;
  double tolerance = 1e-4;  ///< residual, of the direct light's power, in (0, 1)
  std::shared_ptr<const Environment> environment = nullptr;  ///< nullptr: no sky
  double skyRotation = 0.0;                                  ///< radians, counter-clockwise seen from above

  explicit operator bool() const { return wanted; }
};

/// Irradiance of the scene's static lights, texel by texel.
struct LightMapRequest {
  bool wanted = false;
  double texelSize = 0.0;     ///< side of its texels, m, with an error of the smallest; 0: chosen
  double error = 0.0;         ///< that interpolation may make, relative; 0: texels of one size
  bool caustics = false;      ///< which need a light map
  std::uint64_t photons = 0;  ///< 0: chosen by its texels
  bool denoise = false;       ///< by Open Image Denoise, which must be there (docs/denoising.md)

  explicit operator bool() const { return wanted; }
};

/// Incident light of texels and vertices in other forms (docs/encodings.md); of light maps, which it needs.
struct EncodedLightRequest {
  std::vector<std::string> encodings;  ///< names, each once; none: not wanted

  explicit operator bool() const { return !encodings.empty(); }
};

/// How long a bake goes on.
struct Effort {
  std::uint64_t rays = 1024;  ///< rays a vertex, on average; ignored with error or seconds
  std::optional<double> error =
      {};  ///< stop when AO's estimated standard error is below this at every vertex
  std::optional<double> seconds = {};  ///< stop after this time
};

/// Where rays begin and end, and how occlusion fades; metres, >= 0.
struct OcclusionLimits {
  double nearest = 0.0;     ///< what is nearer to a receiver occludes nothing
  double farthest = 0.0;    ///< what is farther occludes nothing; 0: no limit
  double obscurance = 0.0;  ///< occlusion fades out linearly up to this distance; 0: it does not
};

/// What the user asked a bake for: a part a technique, and what all of them share.
struct BakeRequest {
  bool ao = false;     ///< ambient occlusion and bent normal
  bool cones = false;  ///< how wide the cone about the bent normal is that is open; needs ao
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
  bool specular =
      false;  ///< rays that meet glass, mirrors and metal go on from there in all that carries light
  bool glossyBounces = false;  ///< with `specular`: from rough lobes of all other materials, too
  bool subsurface = false;  ///< what comes through surfaces diffusely and through the insides of bodies is
                            ///< kept, in AO, SH, CH and Haar wavelets
  OcclusionLimits limits = {};
  std::vector<ShadowSetRequest> shadowSets = {};  ///< nodes that none of these name see everything
  Effort effort = {};
  std::uint64_t seed = 0;

  /// Bytes that the program may take for the bake: what has no room is kept in a file, and a bake that takes
  /// more all the same is refused. None: 400 bytes a triangle and 300 MB, defaultMemory for what memory()
  /// bounds, and no bake is refused.
  std::optional<std::uint64_t> maxMemory = std::nullopt;
  static constexpr std::uint64_t defaultMemory = std::uint64_t{2} << 30;
  std::uint64_t memory() const { return maxMemory.value_or(defaultMemory); }

  /// Anything that light is carried by, other than AO.
  bool carriesLight() const {
    return sh.order > 0 || ch.order > 0 || haar.size > 0 || glossy.order > 0 || lightGroups.wanted;
  }

  /// Anything that is projected from the hemispheres of receivers.
  bool castsReceivers() const { return ao || horizons.sectors > 0 || occluders.wanted || carriesLight(); }
  bool anything() const { return castsReceivers() || radiosity.wanted || lightMap.wanted; }

  /// The same, with nothing to make.
  BakeRequest withoutTechniques() const;

  static constexpr int maxShOrder = 32;
  static constexpr int maxShells = 32;
  static constexpr int minSectors = 3;
  static constexpr int maxSectors = 64;
  static constexpr int maxGlossyOrder = 8;
  static constexpr int maxHaarSize = 128;
  static constexpr int maxVolumeSize = 64;
  static constexpr int maxChartSize = 4096;
  static constexpr int maxBounces = 16;
  static constexpr std::uint64_t maxRays = 1u << 20;
};

}  // namespace prelight
