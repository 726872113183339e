#pragma once

#include <chrono>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "base/clocks.h"
#include "cast/hemisphere_column.h"
#include "cast/light_column.h"
#include "cast/specular_column.h"
#include "gpu/tracer.h"
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
  HemisphereRenderer* hemispheres = nullptr;  ///< draws what receivers see; nullptr: rays are traced
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

  /// Adds the columns that it needs of the rays that all techniques share, besides accessibility and the
  /// bands of SH that the request names (castOrder), which `hemisphere` has. They are the projector's.
  virtual void addColumns(const HemisphereColumn& /*hemisphere*/, std::vector<Column*>& /*columns*/) {}

  /// One of its columns, whose light bounces carry, too; nullptr: none.
  virtual const LightColumn* carriedLight() const { return nullptr; }

  /// Whether it reads what surfaces reflect, where there are bounces (SlotTransfer).
  virtual bool readsReflected() const { return false; }

  /// Comes before the first ray.
  virtual void prepare(Progress& /*progress*/) {}

  /// Adds its part to the bake. `cast` has run; nullptr where the request needs none. What takes long
  /// is kept by parts of the work (base/kept_work.h). Throws Interrupted.
  virtual void run(ReceiverCast* cast, Bake& bake, Progress& progress) = 0;
};

}  // namespace prelight
