#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "prelight/picture.h"
#include "prelight/scene.h"

namespace prelight {

class Device;
class Progress;
struct LoadedScene;

/// How a picture is made (docs/reference.md, docs/global-illumination.md).
enum class RenderMethod : std::uint8_t {
  Path,                ///< path tracing: all light, without bias, with noise
  Distributed,         ///< path tracing with one diffuse bounce
  Whitted,             ///< path tracing with no diffuse bounce
  GlobalIllumination,  ///< photons, final gathering and caustics: little noise, small bias
};

struct RenderOptions {
  RenderMethod method = RenderMethod::Path;
  int width = 0;               ///< pixels, up to maxSize; 0: as the camera's aspect has it
  int height = 360;            ///< pixels, 1 to maxSize
  std::uint32_t samples = 64;  ///< a pixel, from 1 on; 64 at most with GlobalIllumination
  int depth = 16;  ///< segments of a path at most, 1 to maxDepth: 1 shows lights, 2 adds direct light
  std::uint64_t seed = 0;
  bool denoise = false;               ///< by Open Image Denoise, which must be there (docs/denoising.md)
  std::optional<Camera> camera = {};  ///< none: the scene's first, or one that frames the scene
  std::optional<std::vector<Light>> lights = {};  ///< punctual ones, world space; none: the scene's
  const Environment* sky = nullptr;               ///< nullptr: black
  double skyRotation = 0.0;                       ///< radians, counter-clockwise seen from above
  const Device* device = nullptr;                 ///< nullptr: the default one, opened for the call
  Progress* progress = nullptr;                   ///< nullptr: nobody is told, nothing interrupts

  static constexpr int maxSize = 16384;
  static constexpr int maxDepth = 1024;
};

/// Draws a scene: linear radiance, W/(m2 sr). Needs no display and no OpenGL. The same scene, options and
/// device give the same picture. Throws UsageError for options out of their range, InputError for a scene
/// without triangles, Error where the device or the denoiser fails, Interrupted when `progress` asks.
Picture render(const LoadedScene& scene, const RenderOptions& options = {});

/// When a reference picture is good enough. Without either, RenderOptions::samples decide.
struct ReferenceGoal {
  std::optional<double> error = {};    ///< ReferencePicture::error is below this, 1e-6 to 1
  std::optional<double> seconds = {};  ///< the first pass that ends beyond this time
};

/// A picture with all that is known of its noise.
struct ReferencePicture {
  Picture picture;
  std::vector<float> variance;  ///< [row][column], of the mean luminance of pixels; empty: of one pass
  double error = 0.0;           ///< RMS standard error of a pixel's luminance, over the picture's mean;
                                ///< infinite after one pass
  std::uint64_t samples = 0;    ///< a pixel
  std::uint64_t rays = 0;
  double seconds = 0.0;  ///< of tracing
};

/// Draws a scene by paths until it is good enough (docs/reference.md). Throws as render(), and UsageError for
/// RenderMethod::GlobalIllumination, whose bias no number of samples takes away.
ReferencePicture drawReference(const LoadedScene& scene, const RenderOptions& options = {},
                               const ReferenceGoal& goal = {});

}  // namespace prelight
