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

/// How a picture is made (docs/notes/reference.md, docs/notes/global-illumination.md).
enum class RenderMethod : std::uint8_t {
  Path,                ///< path tracing: all light, without bias, with noise
  Distributed,         ///< path tracing with one diffuse bounce
  Whitted,             ///< path tracing with no diffuse bounce
  GlobalIllumination,  ///< photons, final gathering and caustics: little noise, small bias
};

/// Options of render() and drawReference().
struct RenderOptions {
  RenderMethod method = RenderMethod::Path;
  int width = 0;               ///< pixels, up to maxSize; 0: follows from the camera's aspect ratio
  int height = 360;            ///< pixels, 1 to maxSize
  std::uint32_t samples = 64;  ///< per pixel, at least 1; at most 64 with GlobalIllumination
  int depth = 16;              ///< most segments per path, 1 to maxDepth: 1 shows lights, 2 adds direct light
  std::uint64_t seed = 0;
  bool denoise = false;               ///< by Open Image Denoise, which must be installed (docs/denoising.md)
  std::optional<Camera> camera = {};  ///< none: the scene's first, or one that frames the scene
  std::optional<std::vector<Light>> lights = {};  ///< punctual lights in world space; none: the scene's
  const Environment* sky = nullptr;               ///< nullptr: black
  double skyRotation = 0.0;                       ///< radians, counter-clockwise seen from above
  const Device* device = nullptr;                 ///< nullptr: the default device, opened for the call
  Progress* progress = nullptr;                   ///< nullptr: no progress reports, no interruption

  static constexpr int maxSize = 16384;
  static constexpr int maxDepth = 1024;
};

/// Renders a scene to linear radiance, W/(m2 sr). Needs no display and no OpenGL. Equal scene, options and
/// device give equal pictures. Throws UsageError for options out of range, InputError for a scene without
/// triangles, Error where the device or the denoiser fails, and Interrupted when `progress` asks to stop.
Picture render(const LoadedScene& scene, const RenderOptions& options = {});

/// When a reference picture is good enough. Without either bound, RenderOptions::samples decides.
struct ReferenceGoal {
  std::optional<double> error = {};    ///< bound of ReferencePicture::error, 1e-6 to 1
  std::optional<double> seconds = {};  ///< tracing ends with the first pass that exceeds this time
};

/// A reference picture with estimates of its noise.
struct ReferencePicture {
  Picture picture;
  std::vector<float> variance;  ///< [row][column], of the pixel's mean luminance; empty after a single pass
  /// RMS standard error of a pixel's luminance over the picture's mean; infinite after a single pass.
  double error = 0.0;
  std::uint64_t samples = 0;  ///< per pixel
  std::uint64_t rays = 0;
  double seconds = 0.0;  ///< time of tracing
};

/// Renders a scene by path tracing until it is good enough (docs/notes/reference.md). Throws as render()
/// does, and UsageError for RenderMethod::GlobalIllumination, whose bias does not vanish with more samples.
ReferencePicture drawReference(const LoadedScene& scene, const RenderOptions& options = {},
                               const ReferenceGoal& goal = {});

}  // namespace prelight
