#pragma once

#include <cstdint>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "denoise/guides.h"
#include "gi/global_illumination.h"
#include "images/picture_parts.h"
#include "prelight/compiled_scene.h"
#include "prelight/picture.h"
#include "prelight/progress.h"
#include "prelight/scene.h"

namespace prelight {

/// Which photons of indirect light are sent.
enum class PhotonChoice : std::uint8_t {
  Power,       ///< by what lights send
  Importance,  ///< by what the picture needs, which importons tell (photon/importons.h)
};

/// A picture with all light: direct light and mirrors traced at every pixel, indirect light gathered
/// beforehand, caustics from photons.
struct GlobalIlluminationPictureRequest {
  int width = 0;
  int height = 0;
  std::uint32_t samples = 8;  ///< a pixel, 1 to 64
  std::optional<std::uint32_t>
      texels;  ///< of the light map that holds indirect light, about; none: by pixels
  IndirectRequest indirect{.longWay = 4};
  std::optional<std::uint32_t> gatherRays;  ///< from a texel; none: by `indirect`, or by `samples`
  PhotonChoice photonsBy = PhotonChoice::Power;
  std::optional<std::uint64_t> causticPhotons;  ///< towards what makes caustics; none: by pixels
  int depth = 64;                               ///< mirrors and glass before a camera's path ends
  std::uint64_t seed = 0;
  bool guides = false;  ///< those of a denoiser are wanted, too
  bool parts = false;   ///< and what the picture is a sum of

  /// What is made where none is asked for: a texel for 32 pixels, 4096 to 65,536, and a caustic photon for
  /// each, 160,000 to a million, so that a larger picture is sharper at a cost that stays in proportion.
  std::uint32_t mapTexels() const;
  /// Filters take a pixel's noise away, not blotches of the map: with guides, more samples have more rays.
  /// Under a sky its direct light is what errs most.
  std::uint32_t raysOfTexels(bool sky) const;
  std::uint64_t photonsOfCaustics() const;
};

struct GlobalIlluminationPictureReport {
  std::vector<PlannedPass> plan;
  std::vector<std::pair<std::string, double>> stageSeconds;
  std::uint64_t rays = 0;
  PhotonReport photons;
  PhotonReport causticPhotons;
  std::size_t texels = 0;
  std::size_t gatheredAt = 0;      ///< of these, by rays; the others lie between
  Guides guides;                   ///< where they were asked for
  std::vector<PartPicture> parts;  ///< the same
};

/// `surface`: of GlobalIlluminationPictureRequest::mapTexels(); may still be in the making, while a device is
/// opened and photons fly. Throws what making it does, and Interrupted between blocks.
Picture renderGlobalIllumination(const LitScene& lit, const Camera& camera,
                                 const GlobalIlluminationPictureRequest& request,
                                 std::future<LitSurface> surface, const Device& device, Progress& progress,
                                 GlobalIlluminationPictureReport& report);

/// With a surface of its own.
Picture renderGlobalIllumination(const Scene& scene, const LitScene& lit, const Camera& camera,
                                 const GlobalIlluminationPictureRequest& request, const Device& device,
                                 Progress& progress, GlobalIlluminationPictureReport& report);

}  // namespace prelight
