#include "bake/baker.h"
#include "bake/make_plan.h"

#include <cassert>
#include <chrono>
#include <future>
#include <memory>
#include <optional>

#include "bake/drawn_hemispheres.h"
#include "base/clocks.h"
#include "base/kept_work.h"
#include "base/work_share.h"
#include "gpu/tracer.h"
#include "plan/shadow_sets.h"
#include "techniques/receiver_cast.h"
#include "techniques/registry/registry.h"

namespace prelight {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Returns how long earlier, interrupted runs of this bake took, in seconds.
double earlierSeconds(const Progress& progress) {
  const WorkKeeper* keeper = progress.keeper();
  return keeper != nullptr ? keeper->secondsBefore() : 0.0;
}

std::vector<Tracer> tracersOf(const CompiledScene& scene, const ShadowSets& sets, Tracer& tracer) {
  std::vector<Tracer> tracers;
  for (const ShadowSets::Occluders& set : sets.sets) tracers.emplace_back(tracer, scene, set.triangles);
  return tracers;
}

/// Returns the quality of the hierarchy. Spatial splits cost the time of some 20 rays per triangle and save
/// up to a tenth of each ray (docs/notes/bvh.md).
BuildQuality qualityFor(const CompiledScene& scene, const BakeRequest& request) {
  constexpr double worthwhile = 200.0;  // rays per triangle
  if (request.effort.error || request.effort.seconds || !request.castsReceivers()) return BuildQuality::High;
  const double rays = static_cast<double>(request.effort.rays) * scene.vertexCount();
  return rays < worthwhile * scene.triangleCount() ? BuildQuality::Balanced : BuildQuality::High;
}

/// Work that goes on from a state, or that others have done a part of, may have no ray left to trace.
TreeStart treeStartOf(const Progress& progress) {
  const WorkKeeper* keeper = progress.keeper();
  if (keeper == nullptr) return TreeStart::AtOnce;
  const bool othersTrace = keeper->share() != nullptr && !keeper->share()->givesAway();
  return keeper->hasState() || othersTrace ? TreeStart::AtFirstRay : TreeStart::AtOnce;
}

/// Returns projectors of the requested techniques, in the order of the techniques. Throws what they throw.
std::vector<std::unique_ptr<Projector>> makeProjectors(const BakeContext& context) {
  std::vector<std::unique_ptr<Projector>> made;
  for (const Technique& technique : techniques()) {
    if (technique.makeProjector == nullptr) continue;
    if (std::unique_ptr<Projector> projector = technique.makeProjector(context))
      made.push_back(std::move(projector));
  }
  return made;
}

/// The techniques of a bake and the cast that they share, from the first ray to the last.
class ProjectorsRun {
 public:
  explicit ProjectorsRun(const BakeContext& context)
      : context_(context), projectors_(makeProjectors(context)) {
    if (!context.request.castsReceivers()) return;
    cast_.emplace(context, projectors_);
  }

  /// Runs all techniques and returns the bake without its info.
  Bake run(Progress& progress) {
    Bake bake;
    context_.clock.mark("prepare");
    for (const auto& projector : projectors_) projector->prepare(progress);
    if (cast_) cast_->run(progress);
    for (const auto& projector : projectors_) {
      projector->run(cast(), bake, progress);
      if (projector->stage().empty())
        context_.clock.restart();
      else
        context_.clock.mark(std::string(projector->stage()));
    }
    if (cast_) cast_->addTo(context_.report);
    context_.report.bytesBvh = context_.tracer.bvhBytes();
    for (const Tracer& part : context_.setTracers) context_.report.bytesBvh += part.bvhBytes();
    return bake;
  }

 private:
  ReceiverCast* cast() { return cast_ ? &*cast_ : nullptr; }

  const BakeContext& context_;
  std::vector<std::unique_ptr<Projector>> projectors_;
  std::optional<ReceiverCast> cast_;
};

}  // namespace

Bake bakeScene(const CompiledScene& scene, const BakeRequest& asked, const Plan& plan, const Device& device,
               Progress& progress, BakeReport& report, const Charts* charts, const Scene* source,
               HemisphereRenderer* hemispheres) {
  if (scene.triangleCount() == 0)
    throw InputError("scene", "there is no triangle to bake",
                     "bake needs a mesh with at least one triangle of non-zero area");
  const Clock::time_point start = Clock::now();
  const BakeRequest request = withChoices(asked, scene);
  const bool drawn = request.visibility == Visibility::Raster;
  if (drawn && hemispheres == nullptr) throw rendererMissing();
  assert(drawn || hemispheres == nullptr);
  StageClock clock(report.stageSeconds);
  const ShadowSets sets = makeShadowSets(scene, request.shadowSets);
  // Beside the hierarchy.
  std::future<FitMesh> unknowns = std::async([&] { return makeFitMesh(scene, sets.setOfVertices(scene)); });
  Tracer tracer(scene, device, BvhLayout::Automatic, qualityFor(scene, request),
                plan.runs(Pass::Instances) ? TreeLevels::Two : TreeLevels::One, treeStartOf(progress));
  const FitMesh mesh = unknowns.get();
  std::vector<Tracer> setTracers;
  if (request.castsReceivers()) setTracers = tracersOf(scene, sets, tracer);
  const BakeRequest carried = carriedOut(request, lightOf(plan));
  const BakeContext context{scene, source, charts,     carried, plan,  device, mesh,
                            sets,  tracer, setTracers, start,   clock, report, hemispheres};
  Bake bake = ProjectorsRun(context).run(progress);
  bake.info = {std::string("Prelight ") + PRELIGHT_VERSION,
               request.seed,
               report.rays,
               report.aoErrorRms,
               carried.bounces,
               plan,
               device.info().name,
               earlierSeconds(progress) + secondsSince(start)};
  if (request.castsReceivers()) {
    bake.info.limits = request.limits;
    bake.info.shadowSets = request.shadowSets;
    if (hemispheres != nullptr) bake.info.visibility = hemispheres->description();
  }
  return bake;
}

}  // namespace prelight
