#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "denoise/guides.h"
#include "integrators/film.h"
#include "prelight/compiled_scene.h"
#include "prelight/device.h"
#include "prelight/error.h"
#include "prelight/picture.h"
#include "prelight/plan.h"
#include "prelight/progress.h"
#include "prelight/scene.h"

namespace prelight::reference {

/// Which paths of light a picture holds; docs/reference.md defines them.
enum class Integrator : std::uint8_t { Whitted, Distributed, Path, Instant };

/// Reads "whitted", "distributed", "path" or "instant". Throws UsageError naming the known ones.
Integrator parseIntegrator(std::string_view name);
std::string_view integratorName(Integrator integrator);

/// How light is found: both ways weighted against each other, or one of them alone. All have the same mean
/// where one alone can find all light.
enum class Estimator : std::uint8_t { Both, LightsOnly, ScatterOnly };

struct ReferenceRequest {
  Integrator integrator = Integrator::Path;
  Estimator estimator = Estimator::Both;
  int depth = 16;  ///< most segments of a path, camera to light: 1 shows lights alone, 2 adds direct light
  int leastDepth = 1;           ///< least segments of paths that count: light of 1 or 2 is direct
  int rouletteDepth = 8;        ///< from this vertex on, paths that carry little end by chance, without bias
  std::uint64_t samples = 256;  ///< a pixel; ignored with error or seconds
  std::optional<double> error;  ///< stop when Film::relativeError() is below this
  std::optional<double> seconds;     ///< stop at the end of the first pass beyond this time
  std::uint32_t samplesPerPass = 0;  ///< of a pixel, a divisor of `samples`; 0: chosen
  std::uint64_t lightPaths = 32;     ///< a pass, that leave virtual lights; Instant
  std::uint64_t seed = 0;
  int width = 0;
  int height = 0;
  bool guides = false;  ///< those of a denoiser are wanted, too
  bool parts = false;   ///< and what the picture is a sum of (images/picture_parts.h)

  static constexpr std::uint64_t maxSamples = std::uint64_t{1} << 32;
};

/// What is drawn. The referents outlive the call.
struct ReferenceInputs {
  const CompiledScene& scene;
  const std::vector<Image>& images;  ///< Scene::images
  std::vector<Light> lights;         ///< punctual ones, world space
  Camera camera;
  const Environment* sky = nullptr;
  double skyRotation = 0.0;  ///< radians, counter-clockwise about +Y seen from above
};

struct ReferenceReport {
  std::vector<PlannedPass> plan;  ///< which code the scene needs, and why the rest is left out
  std::uint64_t rays = 0;         ///< traced since the start, not before a resumption
  double seconds = 0.0;           ///< of tracing
  Guides guides;                  ///< where they were asked for
  Warnings notes;
};

/// Samples a pixel that one pass takes: a divisor of `samples`, so that all passes are alike, and small
/// enough that there are passes to estimate the variance from.
std::uint32_t samplesPerPass(const ReferenceRequest& request);

/// Draws until the request is met, from where `film` stands. Throws Interrupted between blocks; the film then
/// holds what was done. Blocks are kept, and gone on with in place of the film.
void renderReference(const ReferenceInputs& inputs, const ReferenceRequest& request, const Device& device,
                     Progress& progress, Film& film, ReferenceReport& report);

}  // namespace prelight::reference
