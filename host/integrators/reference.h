#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/state_file.h"
#include "denoise/denoiser.h"
#include "integrators/film.h"
#include "integrators/lens.h"
#include "prelight/compiled_scene.h"
#include "prelight/device.h"
#include "prelight/error.h"
#include "prelight/options.h"
#include "prelight/picture.h"
#include "prelight/plan.h"
#include "prelight/progress.h"
#include "prelight/scene.h"

namespace prelight::reference {

/// The light paths that a picture includes, as docs/notes/reference.md defines them.
enum class Integrator : std::uint8_t { Whitted, Distributed, Path, Instant };

std::string_view integratorName(Integrator integrator);

/// How light is found: by sampling lights and by scattering, combined with weights, or by one of them alone.
/// All have the same mean where one alone can find all light.
enum class Estimator : std::uint8_t { Both, LightsOnly, ScatterOnly };

/// Options of renderReference().
struct ReferenceRequest {
  Integrator integrator = Integrator::Path;
  Estimator estimator = Estimator::Both;
  int depth = 16;  ///< most segments of a path from camera to light: 1 shows only lights, 2 adds direct light
  int leastDepth = 1;             ///< least segments of paths that count; light of 1 or 2 segments is direct
  int rouletteDepth = 8;          ///< vertex from which Russian roulette may end paths
  std::uint64_t samples = 256;    ///< per pixel; ignored with error or seconds
  std::optional<double> error;    ///< stop when Film::relativeError() is below this
  std::optional<double> seconds;  ///< stop at the end of the first pass beyond this time
  std::uint32_t samplesPerPass = 0;  ///< per pixel, a divisor of `samples`; 0: chosen
  std::uint64_t lightPaths = 32;     ///< light paths per pass that make virtual lights; Instant only
  std::uint64_t seed = 0;
  Lens lens;
  double shutter = 0.0;  ///< s that the shutter is open, with ReferenceInputs::ofPass; 0: a single moment
  int width = 0;
  int height = 0;
  bool guides = false;  ///< whether guides of a denoiser are made, too
  bool parts = false;   ///< whether the parts of the picture are made, too (images/picture_parts.h)

  static constexpr std::uint64_t maxSamples = std::uint64_t{1} << 32;
};

/// The scene of a picture. The referents must outlive the call.
struct ReferenceInputs {
  const CompiledScene& scene;
  const std::vector<Image>& images;  ///< Scene::images
  std::vector<Light> lights;         ///< punctual lights in world space
  Camera camera;
  const Environment* sky = nullptr;
  double skyRotation = 0.0;  ///< radians, counter-clockwise about +Y seen from above
  /// Returns the inputs of a pass, valid until the next call, for a scene that moves while the shutter is
  /// open; the members above are then those of the moment in which it opens. Empty: nothing moves.
  std::function<const ReferenceInputs&(std::uint64_t pass)> ofPass = {};
  std::uint64_t motion = 0;  ///< hash of what moves the scene (Exposure::motion()); 0: nothing moves
};

/// Statistics of renderReference().
struct ReferenceReport {
  std::vector<PlannedPass> plan;  ///< parts of the kernels that the scene needs, and why others are omitted
  std::uint64_t rays = 0;         ///< traced by this call, not before a resumption
  double seconds = 0.0;           ///< time of tracing
  Guides guides;                  ///< if requested
  Warnings notes;
};

/// Returns the samples per pixel and pass: a divisor of `samples`, so that all passes are equal, and small
/// enough to have several passes for the variance.
std::uint32_t samplesPerPass(const ReferenceRequest& request);

/// Renders from the present state of `film` until the request is met. Throws Interrupted between blocks; the
/// film then holds what was done. Finished blocks are kept, and a kept state replaces the film.
void renderReference(const ReferenceInputs& inputs, const ReferenceRequest& request, const Device& device,
                     Progress& progress, Film& film, ReferenceReport& report);

/// Returns the key of everything that a picture's bytes depend on, part by part.
StateKey filmKey(const ReferenceInputs& inputs, const ReferenceRequest& request, const DeviceInfo& device);

/// Writes an unfinished picture, or reads it into a film of the same size with the same parts.
template <typename State>
void exchangeFilm(State& state, Film& film) {
  state.value(film.passes);
  state.value(film.blockPixels);
  state.require(film.blockPixels < film.pixelCount() && film.passes <= ReferenceRequest::maxSamples);
  for (std::vector<glm::dvec3>* colors : {&film.sums, &film.parts}) {
    state.sameSize(*colors);
    state.check([&] {
      return std::all_of(colors->begin(), colors->end(),
                         [](const glm::dvec3& color) { return std::isfinite(color.x + color.y + color.z); });
    });
  }
  for (std::vector<double>* numbers : {&film.means, &film.squares, &film.blurs, &film.blurSquares}) {
    state.sameSize(*numbers);
    state.requireFinite(*numbers);
  }
  state.check([&] {
    return std::all_of(film.squares.begin(), film.squares.end(), [](double s) { return s >= 0.0; });
  });
}

}  // namespace prelight::reference

namespace prelight {

template <>
std::span<const Option<reference::ReferenceRequest>> optionsOf<reference::ReferenceRequest>();

}  // namespace prelight
