#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "prelight/picture.h"

/// Parts of the request of a bake, BakeRequest (prelight/techniques.h): options of techniques that have more
/// than one, and options that all techniques share.
namespace prelight {

/// A group of lights: those whose name, or whose node's name, matches a pattern (* and ? are wildcards).
struct LightGroupRequest {
  std::string name;
  std::vector<std::string> patterns;
};

/// Restricts occlusion: receivers on nodes that match the first patterns are shadowed only by nodes that
/// match the second.
struct ShadowSetRequest {
  std::vector<std::string> receivers;
  std::vector<std::string> occluders;  ///< empty: nothing shadows them
};

/// The part of a scene that counts as one occluder in vector occluders.
enum class OccluderKind : std::uint8_t { Node, Mesh, Material, Auto };

/// Transfer in spherical harmonics.
struct ShRequest {
  int order = 0;  ///< 0: none; 1..BakeRequest::maxShOrder
};

/// Transfer in "cpherical" harmonics.
struct ChRequest {
  int order = 0;       ///< 0: none; 1..BakeRequest::maxShOrder
  bool naive = false;  ///< stores inner products instead of dual coefficients, to show the loss
};

/// Shadows of lamps within the scene, made from the hit distances of the rays of SH, CH, Haar or glossy
/// transfer, one of which is required. The order is the greater of SH and CH, or 6 if neither is requested.
struct NearLampsRequest {
  /// Shells of distance: 0, none, or 2..BakeRequest::maxShells. Not given: BakeRequest::usualShells if a lamp
  /// lies within the bounds of the scene, else none.
  std::optional<int> shells = std::nullopt;
  double farthest = 0.0;  ///< where the last shell ends, m; 0: the diagonal of the scene's bounds
  int order = 0;          ///< of the shells, 1..BakeRequest::maxShOrder; 0: the greatest of the transfer's
};

/// Horizons of sectors of azimuth around every vertex's normal.
struct HorizonsRequest {
  int sectors = 0;  ///< 0: none; BakeRequest::minSectors..BakeRequest::maxSectors
};

/// Transfer in Haar wavelets on cube maps.
struct HaarRequest {
  int size = 0;        ///< 0: none; a power of two up to BakeRequest::maxHaarSize
  double error = 0.1;  ///< relative L2 error that sparse storage may cause, 0..1
};

/// Transfer matrices from incident to reflected radiance.
struct GlossyRequest {
  int order = 0;  ///< 0: none; 1..BakeRequest::maxGlossyOrder
};

/// Transfer of the scene's own lights.
struct LightGroupsRequest {
  bool wanted = false;
  std::vector<LightGroupRequest> named = {};  ///< lights that match none of these form groups of their own

  explicit operator bool() const { return wanted; }
};

/// Vector occluders.
struct OccluderRequest {
  bool wanted = false;
  OccluderKind kind = OccluderKind::Node;
  double records = 8.0;          ///< with Auto: mean number of records per vertex, > 0
  double leastFormFactor = 0.0;  ///< occluders that cover less of the hemisphere than this are dropped, 0..1

  explicit operator bool() const { return wanted; }
};

/// SH transfer at points in the air. Requires SH, whose order it shares.
struct VolumeRequest {
  int size = 0;  ///< voxels along the scene's longest side; 0: none
};

/// SH transfer at the texels of charts, with the normals of normal maps. Requires SH, whose order it shares.
struct ChartTransferRequest {
  int size = 0;         ///< texels along a side of the largest chart; 0: none
  bool relief = false;  ///< whether bumps of normal textures shadow one another
};

/// How the radiosity equation is solved (docs/notes/radiosity.md).
enum class RadiosityMethod : std::uint8_t { Jacobi, Chebyshev, GaussSeidel, Southwell };

constexpr std::array<std::string_view, 4> radiosityMethodNames = {"jacobi", "chebyshev", "gauss-seidel",
                                                                  "southwell"};

/// Irradiance at every vertex due to the scene's static lights, by the radiosity equation. The bake's effort
/// and seed apply.
struct RadiosityRequest {
  bool wanted = false;
  double patchSize = 0.0;  ///< longest edge of an element in m; 0: chosen by the scene's surface
  RadiosityMethod method = RadiosityMethod::GaussSeidel;
  double tolerance = 1e-4;  ///< residual relative to the direct light's power, in (0, 1)
  std::shared_ptr<const Environment> environment = nullptr;  ///< nullptr: no sky
  double skyRotation = 0.0;                                  ///< radians, counter-clockwise seen from above

  explicit operator bool() const { return wanted; }
};

/// Irradiance per texel due to the scene's static lights.
struct LightMapRequest {
  bool wanted = false;
  double texelSize = 0.0;     ///< side of a texel in m, or of the smallest ones with `error`; 0: chosen
  double error = 0.0;         ///< relative error that interpolation may make; 0: texels of one size
  bool caustics = false;      ///< adds caustics
  std::uint64_t photons = 0;  ///< 0: chosen by the number of texels
  bool denoise = false;       ///< by Open Image Denoise, which must be installed (docs/denoising.md)

  explicit operator bool() const { return wanted; }
};

/// Encodings of incident light at texels and vertices (docs/notes/encodings.md). Requires a light map.
struct EncodedLightRequest {
  std::vector<std::string> encodings;  ///< distinct names; empty: none

  explicit operator bool() const { return !encodings.empty(); }
};

/// How receivers find out which directions are open.
enum class Visibility : std::uint8_t {
  Rays,    ///< rays are traced
  Raster,  ///< their views are drawn, by a HemisphereRenderer (prelight/hemisphere_renderer.h)
};

/// When a bake stops casting rays.
struct Effort {
  std::uint64_t rays = 1024;  ///< rays per vertex on average; ignored with `error` or `seconds`
  /// Stop when the estimated standard error of AO is below this at every vertex.
  std::optional<double> error = {};
  std::optional<double> seconds = {};  ///< stop after this time
};

/// Distances in metres, >= 0, that limit occlusion.
struct OcclusionLimits {
  double nearest = 0.0;     ///< nearer surfaces do not occlude
  double farthest = 0.0;    ///< farther surfaces do not occlude; 0: no limit
  double obscurance = 0.0;  ///< occlusion fades out linearly up to this distance; 0: it does not fade
};

}  // namespace prelight
