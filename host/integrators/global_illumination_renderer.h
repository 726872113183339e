#pragma once

#include <cstdint>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "denoise/denoiser.h"
#include "gi/global_illumination.h"
#include "images/picture_parts.h"
#include "prelight/compiled_scene.h"
#include "prelight/options.h"
#include "prelight/picture.h"
#include "prelight/progress.h"
#include "prelight/scene.h"
#include "prelight/shading.h"

namespace prelight {

/// Request for a picture with all light: direct light and mirrors are traced per pixel, indirect light is
/// gathered beforehand, and caustics come from photons.
struct GlobalIlluminationPictureRequest {
  int width = 0;
  int height = 0;
  std::uint32_t samples = 8;  ///< per pixel, 1 to 64
  /// Approximate number of texels of the light map for indirect light; none: by the number of pixels.
  std::optional<std::uint32_t> texels;
  IndirectRequest indirect{.longWay = 4};  ///< no number of photons: by the texels
  std::optional<std::uint32_t> gatherRays;  ///< per texel; none: by `indirect` or `samples`
  PhotonChoice photonsBy = PhotonChoice::Power;
  /// Emitted towards objects that make caustics; none: by the number of pixels.
  std::optional<std::uint64_t> causticPhotons;
  int depth = 64;  ///< most mirrors and glass surfaces on a camera path
  std::uint64_t seed = 0;
  bool guides = false;  ///< whether guides of a denoiser are made, too
  bool parts = false;   ///< whether the parts of the picture are made, too

  /// Default when none is requested: one texel per 32 pixels or per four triangles of the scene, whichever
  /// are more, 4096 to 65,536, so that larger pictures are sharper at proportional cost and small parts have
  /// texels of their own.
  std::uint32_t mapTexels(std::uint32_t triangles) const;
  /// Default when none is requested: usualPhotons().
  std::uint64_t photonsOfIndirectLight(std::uint32_t triangles) const;
  /// Returns the rays per texel. Denoisers remove noise of pixels but not blotches of the map, so that with
  /// guides more samples imply more rays. Under a sky the number stays, since the sky's direct light has the
  /// greatest error.
  std::uint32_t raysOfTexels(bool sky) const;
  /// Default when none is requested: one per pixel, 160,000 to a million.
  std::uint64_t photonsOfCaustics() const;
};

template <>
std::span<const Option<GlobalIlluminationPictureRequest>> optionsOf<GlobalIlluminationPictureRequest>();

/// Statistics of renderGlobalIllumination().
struct GlobalIlluminationPictureReport {
  std::vector<PlannedPass> plan;
  std::vector<std::pair<std::string, double>> stageSeconds;
  std::uint64_t rays = 0;
  PhotonReport photons;
  PhotonReport causticPhotons;
  std::size_t texels = 0;
  std::size_t gatheredAt = 0;      ///< texels gathered at by rays; the others are interpolated
  Guides guides;                   ///< if requested
  std::vector<PartPicture> parts;  ///< if requested
};

/// Renders a picture. `surface` has GlobalIlluminationPictureRequest::mapTexels() and may still be under
/// construction while a device is opened and photons are traced. Throws the exceptions of its construction,
/// and Interrupted between blocks.
Picture renderGlobalIllumination(const LitScene& lit, const Camera& camera,
                                 const GlobalIlluminationPictureRequest& request,
                                 std::future<LitSurface> surface, const Device& device, Progress& progress,
                                 GlobalIlluminationPictureReport& report);

/// Renders a picture with a surface that is laid out here.
Picture renderGlobalIllumination(const Scene& scene, const LitScene& lit, const Camera& camera,
                                 const GlobalIlluminationPictureRequest& request, const Device& device,
                                 Progress& progress, GlobalIlluminationPictureReport& report);

}  // namespace prelight
