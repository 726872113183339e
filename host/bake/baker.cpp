#include "bake/baker.h"
#include "bake/make_plan.h"

#include <chrono>
#include <future>
#include <memory>
#include <optional>

#include "bake/saving_progress.h"
#include "base/stage_clock.h"
#include "gpu/tracer.h"
#include "plan/shadow_sets.h"
#include "projectors/receiver_cast.h"
#include "projectors/registry/projectors.h"

namespace prelight {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double savingSeconds = 3.4e-7;  // a triangle, that a state of the first rays takes to write

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// How long the runs before took, s.
double earlierSeconds(std::optional<StateReader>& saved) {
  constexpr double most = 1e9;  // clocks count to 292 years
  double seconds = 0.0;
  if (!saved) return seconds;
  saved->value(seconds);
  saved->require(seconds >= 0.0 && seconds <= most);
  return seconds;
}

Clock::time_point startOf(std::optional<StateReader>& saved) {
  const std::chrono::duration<double> earlier(earlierSeconds(saved));
  return Clock::now() - std::chrono::duration_cast<Clock::duration>(earlier);
}

std::vector<Tracer> tracersOf(const CompiledScene& scene, const ShadowSets& sets, Tracer& tracer) {
  std::vector<Tracer> tracers;
  for (const ShadowSets::Occluders& set : sets.sets) tracers.emplace_back(tracer, scene, set.triangles);
  return tracers;
}

/// Spatial splits take the time of some 20 rays a triangle and save up to a tenth of each ray (docs/bvh.md).
BuildQuality qualityFor(const CompiledScene& scene, const BakeRequest& request) {
  constexpr double worthwhile = 200.0;  // rays a triangle
  if (request.effort.error || request.effort.seconds || !request.castsReceivers()) return BuildQuality::High;
  const double rays = static_cast<double>(request.effort.rays) * scene.vertexCount();
  return rays < worthwhile * scene.triangleCount() ? BuildQuality::Balanced : BuildQuality::High;
}

/// The techniques of a bake and the cast that they share, from the first ray to the last.
class ProjectorsRun {
 public:
  explicit ProjectorsRun(const BakeContext& context)
      : context_(context), projectors_(makeProjectors(context)) {
    if (!context.request.castsReceivers()) return;
    CastNeeds needs;
    for (const auto& projector : projectors_) projector->addNeeds(needs);
    cast_.emplace(context, needs);
  }

  /// Brings everything to where `saved` left it, if it did; else to the start.
  void prepare(std::optional<StateReader>& saved, Progress& progress) {
    if (saved && cast_) cast_->load(*saved);
    context_.clock.mark("prepare");
    for (const auto& projector : projectors_) {
      projector->prepare(progress);
      if (saved) projector->load(*saved);
    }
    if (saved) saved->require(saved->rest().empty());
  }

  /// Everything but the info.
  Bake run(Progress& progress) {
    Bake bake;
    if (cast_) cast_->run(progress);
    for (const auto& projector : projectors_) {
      projector->run(cast(), bake, progress);
      if (projector->stage().empty())
        context_.clock.restart();
      else
        context_.clock.mark(std::string(projector->stage()));
    }
    if (cast_) cast_->addTo(context_.report);
    for (const Tracer& part : context_.setTracers) context_.report.bytesBvh += part.bvhBytes();
    return bake;
  }

  /// What receivers saw, then what techniques saw with rays of their own.
  void save(BakeCheckpoint& checkpoint) const {
    if (cast_ && cast_->receivers() == 0) return;
    checkpoint.save([&](StateWriter& state) {
      state.value(secondsSince(context_.start));
      if (cast_) cast_->save(state);
      for (const auto& projector : projectors_) projector->save(state);
    });
  }

 private:
  ReceiverCast* cast() { return cast_ ? &*cast_ : nullptr; }

  const BakeContext& context_;
  std::vector<std::unique_ptr<Projector>> projectors_;
  std::optional<ReceiverCast> cast_;
};

/// Runs, saving what is done now and then and at the end of a run that is interrupted.
Bake runSaving(ProjectorsRun& run, std::uint32_t triangles, Progress& progress, BakeCheckpoint* checkpoint) {
  if (checkpoint == nullptr) return run.run(progress);
  SavingProgress saving(progress, checkpoint->interval(), triangles * savingSeconds,
                        [&] { run.save(*checkpoint); });
  try {
    return run.run(saving);
  } catch (const Interrupted&) {
    run.save(*checkpoint);
    throw;
  }
}

}  // namespace

Bake bakeScene(const CompiledScene& scene, const BakeRequest& request, const Plan& plan, const Device& device,
               Progress& progress, BakeReport& report, BakeCheckpoint* checkpoint, const Charts* charts,
               const Scene* source) {
  if (scene.triangleCount() == 0)
    throw InputError("scene", "there is no triangle to bake",
                     "bake needs a mesh with at least one triangle of non-zero area");
  std::optional<StateReader> saved = checkpoint != nullptr ? checkpoint->load() : std::nullopt;
  const Clock::time_point start = startOf(saved);
  StageClock clock(report.stageSeconds);
  const ShadowSets sets = makeShadowSets(scene, request.shadowSets);
  std::future<FitMesh> unknowns =
      std::async([&] { return makeFitMesh(scene, sets.setOfVertices(scene)); });  // beside the hierarchy
  Tracer tracer(scene, device, BvhLayout::Automatic, qualityFor(scene, request),
                plan.runs(Pass::Instances) ? TreeLevels::Two : TreeLevels::One);
  const FitMesh mesh = unknowns.get();
  report.bytesBvh = tracer.bvhBytes();
  std::vector<Tracer> setTracers;
  if (request.castsReceivers()) setTracers = tracersOf(scene, sets, tracer);
  const BakeRequest carried = carriedOut(request, lightOf(plan));
  const BakeContext context{scene, source, charts,     carried, plan,  device, mesh,
                            sets,  tracer, setTracers, start,   clock, report};
  ProjectorsRun run(context);
  run.prepare(saved, progress);
  saved.reset();
  Bake bake = runSaving(run, scene.triangleCount(), progress, checkpoint);
  bake.info = {std::string("Prelight ") + PRELIGHT_VERSION,
               request.seed,
               report.rays,
               report.aoErrorRms,
               carried.bounces,
               plan,
               device.info().name,
               secondsSince(start)};
  if (request.castsReceivers()) {
    bake.info.limits = request.limits;
    bake.info.shadowSets = request.shadowSets;
  }
  return bake;
}

}  // namespace prelight
