#pragma once

#include <chrono>
#include <memory>
#include <span>
#include <string_view>

#include "base/stage_clock.h"
#include "cast/light_groups.h"
#include "cast/shell_caster.h"
#include "cast/specular_caster.h"
#include "gpu/tracer.h"
#include "occluders/occluder_groups.h"
#include "plan/shadow_sets.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/plan.h"
#include "prelight/progress.h"
#include "prelight/scene.h"
#include "receivers/fit_mesh.h"
#include "scene/gltf/charts.h"
#include "scene/lobes.h"

namespace prelight {

class ReceiverCast;

/// What every technique of a bake works on. All of it outlives the projectors.
struct BakeContext {
  const CompiledScene& scene;
  const Scene* source;   ///< that `scene` was compiled from; nullptr: not at hand
  const Charts* charts;  ///< whose texels get transfer; nullptr: none
  const BakeRequest& request;
  const Plan& plan;
  const Device& device;
  const FitMesh& mesh;
  const ShadowSets& sets;
  Tracer& tracer;
  std::span<Tracer> setTracers;                 ///< [set - 1]
  std::chrono::steady_clock::time_point start;  ///< of this run of the bake
  StageClock& clock;
  BakeReport& report;
};

/// What techniques ask of the rays that all of them share, beyond accessibility and the bands of SH that the
/// request names (castOrder). What is pointed to outlives the cast.
struct CastNeeds {
  bool bentNormal = false;
  const GroupedLights* lights = nullptr;      ///< whose direct light is fitted
  const OccluderGroups* occluders = nullptr;  ///< that hits are told apart by
  int texelFaceSize = 0;                      ///< of a cube map that rays are kept on; 0: they are not
  ShellShape shells;                          ///< of distance that hits are told apart by
  std::uint32_t sectors = 0;                  ///< of azimuth whose openness is fitted; 0: none
  bool receivers = false;                     ///< where bounces are: keep those of stored rows
  bool reflected = false;  ///< where bounces are: keep what surfaces reflect (SlotTransfer)
};

/// Where a bake's rays go on from mirrors and glass, with light of the sky in bands of SH of that order, and
/// within bodies.
inline SpecularWays specularWaysOf(const BakeContext& context, int order) {
  const bool mirrors = context.plan.runs(Pass::SpecularTransport);
  const bool subsurface = context.plan.runs(Pass::SubsurfaceTransport) && context.plan.runs(Pass::Bounces);
  const bool media = (mirrors || subsurface) && anyHasInside(context.scene);
  if (!mirrors && !media) return {};
  return {mirrors, media, mirrors ? order : 0, context.source != nullptr ? &context.source->images : nullptr,
          context.request.glossyBounces};
}

/// What a technique does in a bake. Projectors are made before the first ray and run one after the other.
class Projector {
 public:
  virtual ~Projector() = default;

  /// The stage of the report that its time belongs to; empty: it files its time itself.
  virtual std::string_view stage() const = 0;

  /// Adds what it needs of the shared cast.
  virtual void addNeeds(CastNeeds& /*needs*/) const {}

  /// Comes before the first ray.
  virtual void prepare(Progress& /*progress*/) {}

  /// Adds its part to the bake. `cast` has run; nullptr where the request needs none. What takes long
  /// is kept by parts of the work (base/kept_work.h). Throws Interrupted.
  virtual void run(ReceiverCast* cast, Bake& bake, Progress& progress) = 0;
};

}  // namespace prelight
