#include "techniques/receiver_cast.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/kept_work.h"
#include "basis/cube_map.h"
#include "plan/cast_orders.h"
#include "plan/tree_use.h"
#include "scene/closed_bodies.h"
#include "scene/lobes.h"

namespace prelight {

namespace {

/// Rows of senders that may be stored: of as many receivers as have records, on both sides.
constexpr std::uint32_t storedCapacity = 2 * SampleRecords::most;

/// Rows of senders that the plan's memory and the device have room for.
std::uint32_t rowsInMemory(const BakeContext& context, std::uint32_t raysPerReceiver) {
  const std::uint64_t bytes = std::min(context.plan.transportBytes, context.device.info().maxAllocation);
  return static_cast<std::uint32_t>(
      std::min<std::uint64_t>(bytes / (sizeof(device::Sender) * raysPerReceiver), storedCapacity));
}

CastOptions castOptions(const BakeContext& context, const Schedule& schedule,
                        std::span<const std::uint8_t> solids) {
  CastOptions options;
  options.raysPerReceiver = schedule.raysPerReceiver;
  options.sets = &context.sets;
  options.setTracers = context.setTracers;
  options.limits = context.request.limits;
  options.marksInside = !solids.empty();
  options.solids = solids;
  options.overlaps = true;
  return options;
}

SceneCastOptions sceneOptions(const BakeContext& context, HemisphereColumn& guide,
                              std::optional<StoredTransport>& transport) {
  SceneCastOptions options{guide, transport ? &*transport : nullptr, &context.sets};
  if (context.plan.runs(Pass::SubsurfaceTransport)) options.wantedBacks = translucentTriangles(context.scene);
  options.memory = {context.plan.recordBytes, context.plan.parks};
  return options;
}

const LightColumn* carriedLightOf(std::span<const std::unique_ptr<Projector>> projectors) {
  for (const auto& projector : projectors)
    if (const LightColumn* light = projector->carriedLight()) return light;
  return nullptr;
}

void addSpecularNote(const BakeContext& context, const Caster& caster,
                     const std::optional<SpecularColumn>& specular) {
  const std::uint64_t steps = specular ? specular->steps() : 0;
  if (context.plan.runs(Pass::SpecularTransport))
    context.report.notes.push_back(fmt::format(
        "specular transport: {} further rays from glass, mirrors and metal", caster.furtherRays() - steps));
  if (steps > 0)
    context.report.notes.push_back(fmt::format("subsurface transport: {} steps within bodies", steps));
}

std::string backNote(const SceneCast& cast) {
  return cast.back() != nullptr
             ? fmt::format("back faces: {} triangles are seen from behind and reflect there too",
                           std::count(cast.backSeen().begin(), cast.backSeen().end(), 1))
             : "back faces: skipped, no ray meets one that reflects";
}

void addNotes(const BakeContext& context, const SceneCast& cast, const StoredTransport& transport,
              std::uint32_t raysPerReceiver) {
  context.report.notes.push_back(backNote(cast));
  const std::uint64_t rows =
      cast.front().storedCount() + (cast.back() != nullptr ? cast.back()->storedCount() : 0);
  const double megabyte = double(sizeof(device::Sender) * raysPerReceiver) / (1 << 20);
  if (rows > transport.rowsInMemory())
    context.report.notes.push_back(
        fmt::format("stored transport: {:.0f} of {:.0f} MB are in memory, the rest is in a temporary file",
                    megabyte * transport.rowsInMemory(), megabyte * double(rows)));
}

/// Memory is at its peak while fits are solved and light bounces.
void dropTrees(const BakeContext& context) {
  context.tracer.dropTree();
  for (Tracer& part : context.setTracers) part.dropTree();
}

std::vector<double> accessibilityOf(const FitMesh& mesh, std::size_t columns,
                                    const std::vector<float>& fitted) {
  std::vector<double> accessibility;
  for (std::size_t slot = 0; slot < mesh.slotCount(); ++slot)
    accessibility.push_back(std::clamp(1.0 + double(fitted[slot * columns]), 0.0, 1.0));
  return accessibility;
}

}  // namespace

ReceiverCast::ReceiverCast(const BakeContext& context, std::span<const std::unique_ptr<Projector>> projectors)
    : context_(context),
      bounces_(context.plan.runs(Pass::Bounces) ? context.request.bounces : 0),
      keepsReflected_(std::any_of(projectors.begin(), projectors.end(),
                                  [](const auto& projector) { return projector->readsReflected(); })),
      carriedLight_(carriedLightOf(projectors)),
      start_(context.start),
      schedule_(makeSchedule(context.request, context.mesh.slotCount(), start_)),
      hemisphere_(castOrder(context.request), context.hemispheres),
      caster_(context.scene, context.tracer,
              castOptions(context, schedule_, trianglesOfEnteredSolids(context.scene)),
              columnsOf(projectors)),
      cast_(context.scene, context.mesh, caster_, schedule_, sceneOptions(context, hemisphere_, transport_)) {
}

/// Returns the columns that techniques share, then each technique's own. Rays are followed before they are
/// stored.
std::vector<Column*> ReceiverCast::columnsOf(std::span<const std::unique_ptr<Projector>> projectors) {
  const int order = transferOrder(context_.request);
  std::vector<Column*> columns{&hemisphere_};
  const SpecularWays ways = specularWaysOf(context_, order);
  if (ways.followed()) columns.push_back(&specular_.emplace(ways));
  if (context_.plan.runs(Pass::Bounces)) {
    const TransportShape shape{
        storedCapacity, rowsInMemory(context_, schedule_.raysPerReceiver),
        static_cast<std::size_t>(order * order) + (carriedLight_ != nullptr ? carriedLight_->groups() : 0),
        partValuesOf(context_.plan.parks)};
    columns.push_back(&transport_.emplace(shape, specular_ ? &*specular_ : nullptr));
  }
  for (const auto& projector : projectors) projector->addColumns(hemisphere_, columns);
  return columns;
}

void ReceiverCast::run(Progress& progress) {
  cast(progress);
  if (bounces_ > 0) addNotes(context_, cast_, *transport_, schedule_.raysPerReceiver);
  addSpecularNote(context_, caster_, specular_);
  context_.clock.mark("cast");
  caster_.keepOnePlace();
  if (!keepsTrees(context_.request)) dropTrees(context_);
  cast_.finish(progress);
  FittedSide fitted = front().solve(progress);
  fitted_ = std::move(fitted.values);
  context_.report.aoErrorRms = fitted.error.rms;
  context_.report.aoErrorMax = fitted.error.max;
  accessibility_ = accessibilityOf(context_.mesh, hemisphere_.fitWidth(), fitted_);
  context_.clock.mark("fit");
}

/// Against time, a second cast would see something else than the first, which all that follows depends on.
void ReceiverCast::cast(Progress& progress) {
  WorkPart part(progress, "cast", keptBy(*this));
  if (part.finished()) return;
  cast_.run(progress, part);
  part.finish(schedule_.deadline.has_value());
}

void ReceiverCast::save(StateWriter& state) const {
  state.value(std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count());
  cast_.save(state);
}

/// Seconds of all runs count towards the deadline.
void ReceiverCast::load(StateReader& state) {
  constexpr double most = 1e9;  // clocks count to 292 years
  double seconds = 0.0;
  state.value(seconds);
  state.require(seconds >= 0.0 && seconds <= most);
  const auto earlier =
      std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(seconds));
  start_ -= earlier;
  if (schedule_.deadline) *schedule_.deadline -= earlier;
  cast_.load(state);
}

const SlotTransfer& ReceiverCast::transfer(Progress& progress) {
  if (!transfer_) {
    const TransferRequest request{transferOrder(context_.request), bounces_, keepsReflected_,
                                  context_.plan.runs(Pass::SpecularTransport),
                                  context_.plan.runs(Pass::SubsurfaceTransport)};
    const DirectColumns direct{hemisphere_, carriedLight_, specular_ ? &*specular_ : nullptr};
    transfer_ = makeTransfer(context_.mesh, cast_, direct, transport_ ? &*transport_ : nullptr, fitted_,
                             request, progress, context_.report.notes);
    context_.clock.mark("bounce");
  }
  return *transfer_;
}

void ReceiverCast::addTo(BakeReport& report) const {
  if (caster_.traces({})) report.rays += cast_.rays();
  report.rays += caster_.furtherRays();
  if (context_.hemispheres != nullptr)
    report.notes.push_back(fmt::format("visibility: {} views of receivers were drawn by {}",
                                       cast_.receivers(), context_.hemispheres->description()));
  report.receivers = cast_.receivers();
  if (!context_.request.effort.error && !context_.request.effort.seconds)
    report.skippedRayFraction = std::max(
        0.0, 1.0 - double(cast_.front().receivers()) / (schedule_.receiversPerPass * schedule_.passes));
}

}  // namespace prelight
