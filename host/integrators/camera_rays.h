#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "device/context.h"
#include "gpu/transport_scene.h"
#include "gpu/work_queue.h"
#include "integrators/reference.h"
#include "prelight/compiled_scene.h"
#include "prelight/plan.h"
#include "prelight/scene.h"
#include "shared/reference_types.h"

namespace prelight::reference {

/// Sets the camera's part of the parameters, without a lens.
void setCamera(const Camera& camera, const CompiledScene& scene, int width, int height,
               device::ReferenceParameters& parameters);

/// Sets the lens, which must be focused().
void setLens(const Lens& lens, device::ReferenceParameters& parameters);

/// Sets the parameters that all paths of a picture share, other than the camera.
void setPathParameters(const ReferenceRequest& request, const TransportScene& scene,
                       device::ReferenceParameters& parameters);

/// Returns the kernel features of a picture as passes with reasons.
std::vector<PlannedPass> explainFeatures(const ShadeFeatures& features, const ReferenceRequest& request);

/// Returns the build options of kernels/integrate, added to those of the scene. `cachedLight` is
/// CachedLight::meetsLights, or none without cached light.
BuildOptions buildOptions(const ReferenceRequest& request, std::optional<bool> cachedLight,
                          BuildOptions sceneOptions);

/// Continues camera rays through backs of one-sided surfaces, which pictures do not show
/// (docs/conventions.md, "Sides").
class CulledBacks {
 public:
  /// Device buffers of a step of paths; hits are those of its rays.
  struct Step {
    const Buffer<device::ReferenceParameters>& parameters;
    std::uint32_t count = 0;
    const Buffer<device::Ray>& rays;  ///< the first `count` are valid
    Buffer<device::Hit>& hits;
    const Buffer<std::uint32_t>& numbers;
    const Buffer<device::PathState>& paths;
  };

  /// Supports steps of at most `most` rays. `file` and `options` are those of the program that contains its
  /// kernels.
  CulledBacks(TransportScene& scene, const char* file, const BuildOptions& options, std::uint32_t most);

  /// Replaces hits on culled backs by the hits behind them.
  void lookThrough(const Step& step, Buffer<std::uint8_t>& marks, WorkQueue& queue);

  std::uint64_t rays() const { return rays_; }

 private:
  /// Buffers of continued rays, made when the first one occurs.
  struct Beyond {
    Buffer<device::Ray> rays, listed;
    Buffer<device::Hit> hits;
  };

  using Parameters = Buffer<device::ReferenceParameters>;
  using Rays = Buffer<device::Ray>;
  using Hits = Buffer<device::Hit>;
  using Numbers = Buffer<std::uint32_t>;

  TransportScene& scene_;
  std::uint32_t most_;
  std::uint64_t rays_ = 0;
  Beyond beyond_;
  Kernel<Parameters, std::uint32_t, Buffer<device::SurfaceLine>, Buffer<device::ShadingLine>, Rays, Hits,
         Numbers, Buffer<device::PathState>, Rays, Buffer<std::uint8_t>>
      list_;
  Kernel<std::uint32_t, std::uint32_t, Numbers, Hits, Hits> keep_;
};

}  // namespace prelight::reference
