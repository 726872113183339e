#include "projectors/receiver_cast.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/kept_work.h"
#include "basis/cube_map.h"
#include "plan/cast_orders.h"
#include "plan/tree_use.h"
#include "scene/lobes.h"
#include "scene/opaque_solids.h"

namespace prelight {

namespace {

/// Rows of senders that may be stored: of as many receivers as have records, on both sides.
std::uint32_t storedCapacity(const BakeContext& context) {
  return context.plan.runs(Pass::Bounces) ? 2 * SideSums::mostRecords : 0;
}

/// Rows of senders that the plan's memory and the device have room for.
std::uint32_t rowsInMemory(const BakeContext& context, std::uint32_t raysPerReceiver) {
  const std::uint64_t bytes = std::min(context.plan.transportBytes, context.device.info().maxAllocation);
  return static_cast<std::uint32_t>(
      std::min<std::uint64_t>(bytes / (sizeof(device::Sender) * raysPerReceiver), storedCapacity(context)));
}

std::size_t groupCount(const CastNeeds& needs) {
  return needs.lights != nullptr ? needs.lights->groups.size() : 0;
}

CastOptions castOptions(const BakeContext& context, const CastNeeds& needs, const Schedule& schedule,
                        std::uint32_t capacity, std::span<const std::uint8_t> solids) {
  const int order = transferOrder(context.request);
  CastOptions options;
  options.shOrder = castOrder(context.request);
  options.raysPerReceiver = schedule.raysPerReceiver;
  options.storedReceivers = capacity;
  options.rowsInMemory = rowsInMemory(context, schedule.raysPerReceiver);
  options.partValues = partValuesOf(context.plan.parks);
  options.bounceColumns = static_cast<std::size_t>(order * order) + groupCount(needs);
  options.texelFaceSize = needs.texelFaceSize;
  options.lights = needs.lights;
  options.shells = needs.shells;
  options.sectors = needs.sectors;
  options.specular = specularWaysOf(context, order);
  options.sets = &context.sets;
  options.setTracers = context.setTracers;
  options.limits = context.request.limits;
  options.occluders = needs.occluders;
  options.marksInside = !solids.empty();
  options.solids = solids;
  options.overlaps = true;
  return options;
}

Projections projectionsOf(const BakeContext& context, const CastNeeds& needs, const Schedule& schedule) {
  Projections projections;
  projections.sets = &context.sets;
  projections.shOrder = castOrder(context.request);
  projections.bentNormal = needs.bentNormal;
  projections.groups = static_cast<std::uint32_t>(groupCount(needs));
  if (needs.texelFaceSize > 0) {
    projections.texelRows = context.plan.texelBytes / (sizeof(std::uint32_t) * schedule.raysPerReceiver);
    projections.texelCount = cubeTexelCount(needs.texelFaceSize);
  }
  projections.shells = needs.shells.count();
  projections.shellOrder = needs.shells.order;
  projections.sectors = needs.sectors;
  projections.specularOrder = specularWaysOf(context, transferOrder(context.request)).shOrder;
  projections.recordBytes = context.plan.recordBytes;
  projections.parks = context.plan.parks;
  projections.backs = context.plan.runs(Pass::Bounces);
  if (context.plan.runs(Pass::SubsurfaceTransport))
    projections.wantedBacks = translucentTriangles(context.scene);
  projections.receivers = needs.receivers && context.plan.runs(Pass::Bounces);
  projections.occluders = needs.occluders != nullptr;
  if (needs.occluders != nullptr)
    projections.occluderCount = static_cast<std::uint32_t>(needs.occluders->names.size());
  return projections;
}

void addSpecularNote(const BakeContext& context, const Caster& caster) {
  if (context.plan.runs(Pass::SpecularTransport))
    context.report.notes.push_back(fmt::format(
        "specular transport: {} further rays from glass, mirrors and metal", caster.specularRays()));
  if (caster.walkSteps() > 0)
    context.report.notes.push_back(
        fmt::format("subsurface transport: {} steps within bodies", caster.walkSteps()));
}

std::string backNote(const SceneCast& cast) {
  return cast.back() != nullptr
             ? fmt::format("back faces: {} triangles are seen from behind and reflect there too",
                           std::count(cast.backSeen().begin(), cast.backSeen().end(), 1))
             : "back faces: skipped, no ray meets one that reflects";
}

void addNotes(const BakeContext& context, const SceneCast& cast, const Caster& caster) {
  context.report.notes.push_back(backNote(cast));
  const std::uint64_t rows =
      cast.front().storedCount() + (cast.back() != nullptr ? cast.back()->storedCount() : 0);
  const double megabyte = double(sizeof(device::Sender) * caster.raysPerReceiver()) / (1 << 20);
  if (rows > caster.rowsInMemory())
    context.report.notes.push_back(
        fmt::format("stored transport: {:.0f} of {:.0f} MB are in memory, the rest is in a temporary file",
                    megabyte * caster.rowsInMemory(), megabyte * double(rows)));
}

/// Memory is at its peak while fits are solved and light bounces.
void dropTrees(const BakeContext& context) {
  context.tracer.dropTree();
  for (Tracer& part : context.setTracers) part.dropTree();
}

std::vector<double> accessibilityOf(const FitMesh& mesh, const SideCast& front,
                                    const std::vector<float>& fitted) {
  std::vector<double> accessibility;
  for (std::size_t slot = 0; slot < mesh.slotCount(); ++slot)
    accessibility.push_back(std::clamp(1.0 + double(fitted[slot * front.baseline().columns()]), 0.0, 1.0));
  return accessibility;
}

}  // namespace

ReceiverCast::ReceiverCast(const BakeContext& context, const CastNeeds& needs)
    : context_(context),
      bounces_(context.plan.runs(Pass::Bounces) ? context.request.bounces : 0),
      keepsReflected_(needs.reflected),
      start_(context.start),
      schedule_(makeSchedule(context.request, context.mesh.slotCount(), start_)),
      capacity_(storedCapacity(context)),
      caster_(context.scene, context.tracer,
              castOptions(context, needs, schedule_, capacity_, trianglesOfEnteredSolids(context.scene))),
      cast_(context.scene, context.mesh, caster_, schedule_, projectionsOf(context, needs, schedule_),
            capacity_) {}

void ReceiverCast::run(Progress& progress) {
  cast(progress);
  if (bounces_ > 0) addNotes(context_, cast_, caster_);
  addSpecularNote(context_, caster_);
  context_.clock.mark("cast");
  caster_.keepOnePlace();
  if (!keepsTrees(context_.request)) dropTrees(context_);
  cast_.finish(progress);
  FittedSide fitted = front().solve(progress);
  fitted_ = std::move(fitted.values);
  context_.report.aoErrorRms = fitted.error.rms;
  context_.report.aoErrorMax = fitted.error.max;
  accessibility_ = accessibilityOf(context_.mesh, front(), fitted_);
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
    transfer_ =
        makeTransfer(context_.mesh, caster_, cast_, fitted_, request, progress, context_.report.notes);
    context_.clock.mark("bounce");
  }
  return *transfer_;
}

void ReceiverCast::addTo(BakeReport& report) const {
  report.rays += cast_.rays() + caster_.furtherRays();
  report.receivers = cast_.receivers();
  if (!context_.request.effort.error && !context_.request.effort.seconds)
    report.skippedRayFraction =
        std::max(0.0, 1.0 - double(front().receivers()) / (schedule_.receiversPerPass * schedule_.passes));
}

}  // namespace prelight
