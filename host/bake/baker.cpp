#include "bake/baker.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "bake/saving_progress.h"
#include "base/stage_clock.h"
#include "cast/light_groups.h"
#include "gpu/tracer.h"
#include "lightmap/light_map_bake.h"
#include "lightmap/vertex_irradiance.h"
#include "occluders/occluder_cut.h"
#include "occluders/occluder_threshold.h"
#include "occluders/occluder_tree.h"
#include "occluders/occluder_vectors.h"
#include "plan/shadow_sets.h"
#include "projectors/chart_caster.h"
#include "projectors/encoded_light/encode_light.h"
#include "projectors/glossy_transfer.h"
#include "projectors/haar_transfer.h"
#include "projectors/lightmap/light_map_plan.h"
#include "projectors/lightmap/light_map_sizing.h"
#include "projectors/occluder_transfer.h"
#include "projectors/pack_bake.h"
#include "projectors/scene_cast.h"
#include "projectors/slot_transfer.h"
#include "projectors/volume_caster.h"
#include "radiosity/radiosity_bake.h"
#include "receivers/chart_sampler.h"
#include "scene/surface_regions.h"
#include "scene/vertex_surface.h"

namespace prelight {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t occluderLeaves =
    128;  // of all nodes; twice as many gain 0.002 to 0.007 of shadow error

/// Rows of senders that the plan's memory and the device have room for.
std::uint32_t storedCapacity(const Plan& plan, const Device& device, std::uint32_t raysPerReceiver) {
  const std::uint64_t bytes = std::min(plan.transportBytes, device.info().maxAllocation);
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(
      bytes / (sizeof(device::Sender) * raysPerReceiver), 0xffffffffu / raysPerReceiver));
}

std::string backNote(const SceneCast& cast) {
  return cast.back() != nullptr
             ? fmt::format("back faces: {} triangles are seen from behind and reflect there too",
                           std::count(cast.backSeen().begin(), cast.backSeen().end(), 1))
             : "back faces: skipped, no ray meets one that reflects";
}

/// The occluders that a bake tells apart.
struct BakedOccluders {
  std::optional<OccluderTree> tree;  ///< whose leaves they are
  OccluderGroups groups;
};

BakedOccluders occludersOf(const CompiledScene& scene, OccluderKind kind) {
  if (kind != OccluderKind::Auto) return {std::nullopt, makeOccluderGroups(scene, kind)};
  BakedOccluders occluders{makeOccluderTree(scene, occluderLeaves), {}};
  occluders.groups = leavesOf(*occluders.tree);
  return occluders;
}

/// What the stages of a bake work on and with.
struct BakeParts {
  const CompiledScene& scene;
  const BakeRequest& request;
  const FitMesh& mesh;
  const GroupedLights& lights;
  const ShadowSets& sets;
  const BakedOccluders* occluders;
  const Charts* charts;
  Tracer& tracer;
  std::span<Tracer> setTracers;
  Caster& caster;
  SceneCast& cast;
};

/// The stages of a bake after its parts are made.
class BakeRunner : BakeParts {
 public:
  BakeRunner(const BakeParts& parts, const Plan& plan, Progress& progress, BakeReport& report,
             StageClock& clock)
      : BakeParts(parts),
        bounces_(plan.runs(Pass::Bounces) ? request.bounces : 0),
        progress_(progress),
        report_(report),
        clock_(clock) {}

  /// Everything but the info.
  Bake run() {
    cast.run(progress_);
    if (bounces_ > 0) report_.notes.push_back(backNote(cast));
    clock_.mark("cast");
    const std::vector<double> fitted = cast.front().solve();
    const ErrorEstimate error = cast.front().estimateError();
    report_.aoErrorRms = error.rms;
    report_.aoErrorMax = error.max;
    clock_.mark("fit");
    Bake bake;
    const std::vector<double> accessibility = accessibilityOf(mesh, cast.front(), fitted);
    if (request.ao) packAo(mesh, cast.front(), accessibility, scene, bake);
    if (request.occluders) makeOccluders(accessibility, bake);
    if (request.carriesLight()) makeTransfers(fitted, bake);
    return bake;
  }

 private:
  void makeTransfers(const std::vector<double>& fitted, Bake& bake) {
    const SlotTransfer transfer = makeTransfer(scene, mesh, caster, cast, fitted, transferOrder(request),
                                               bounces_, progress_, report_.notes);
    if (request.sh.order > 0) bake.sh = packSh(mesh, transfer, scene, request.sh.order);
    if (request.ch.order > 0) bake.ch = packCh(mesh, transfer, scene, request.ch.order, request.ch.naive);
    if (request.lightGroups)
      bake.lightGroups = packLightGroups(mesh, transfer, scene, lights.groups, groupChannels(transfer));
    clock_.mark("bounce");
    if (request.volume.size > 0) makeVolumeTransfer(transfer, bake);
    if (charts != nullptr && !charts->charts.empty()) makeTexels(transfer, bake);
    if (request.haar.size > 0) makeHaar(transfer, bake);
    if (request.glossy.order > 0) makeGlossy(fitted, transfer, bake);
  }

  void makeOccluders(const std::vector<double>& accessibility, Bake& bake) {
    OccluderTransfer transfer = makeOccluderTransfer(scene, mesh, cast.front().occluders(), accessibility,
                                                     occluders->groups, neededVectors(scene));
    if (occluders->tree) transfer = cutThroughTree(std::move(transfer), *occluders->tree);
    const DroppedOccluders dropped = dropOccluders(transfer, request.occluders.leastFormFactor);
    reportOccluders(transfer, dropped);
    bake.occluders = std::move(transfer);
    clock_.mark("occluders");
  }

  /// Clusters of every node's vertices, joined again for each vertex as its records allow.
  OccluderTransfer cutThroughTree(OccluderTransfer leaves, const OccluderTree& tree) {
    const std::vector<std::uint32_t> nodes = leafNodes(tree);
    for (std::uint32_t& occluder : leaves.occluders) occluder = nodes[occluder];
    return cutOccluders(leaves, tree, surfaceOfVertices(scene), request.occluders.records);
  }

  void reportOccluders(const OccluderTransfer& transfer, const DroppedOccluders& dropped) {
    std::string text = fmt::format(
        "vector occluders: {} of them, {:.1f} records a vertex, {} vectors a record", transfer.names.size(),
        double(transfer.recordCount()) / scene.vertexCount(), transfer.stored.size());
    if (request.occluders.leastFormFactor > 0.0)
      text += fmt::format("; what was dropped hides {:.2g} of the sky on average, {:.2g} at most",
                          dropped.mean, dropped.most);
    report_.notes.push_back(text);
  }

  void makeVolumeTransfer(const SlotTransfer& transfer, Bake& bake) {
    const VolumeGrid grid = makeVolumeGrid(scene, request.volume.size);
    const VolumeOptions options{request.sh.order, bounces_, raysEach(request), request.seed, request.limits};
    bake.volume = makeVolume(scene, mesh, tracer, transfer, grid, options, progress_);
    report_.rays += std::uint64_t{options.rays} * grid.count();
    report_.notes.push_back(
        fmt::format("volume: {} x {} x {} voxels of {:.3g} m, {} rays each, {} of them inside objects",
                    grid.size.x, grid.size.y, grid.size.z, grid.cell(), options.rays,
                    std::count(bake.volume->air.begin(), bake.volume->air.end(), 0)));
    clock_.mark("volume");
  }

  void makeTexels(const SlotTransfer& transfer, Bake& bake) {
    const ChartOptions options{request.sh.order, bounces_, raysEach(request), request.seed,
                               request.limits,   &sets,    setTracers};
    ChartReport made;
    bake.texels = makeChartTransfer(scene, *charts, mesh, tracer, transfer, options, progress_, made);
    report_.rays += made.rays;
    report_.notes.push_back(
        fmt::format("texels: {} light maps, {} texels of them on the surface, {} rays each, {:.3g} % of "
                    "those from inside objects",
                    bake.texels->maps.size(), made.texels, options.rays,
                    100.0 * double(made.hidden * (options.rays / ChartSampler::positionsPerTexel)) /
                        double(std::max<std::uint64_t>(made.rays, 1))));
    clock_.mark("texels");
  }

  void makeHaar(const SlotTransfer& transfer, Bake& bake) {
    const TexelTransfer direct(scene, mesh, cast.front(), request.haar.size);
    bake.haar = makeHaarTransfer(mesh, direct, transfer, request.haar.size, request.haar.error, progress_);
    report_.notes.push_back(
        fmt::format("wavelets: {:.0f} of {} coefficients a row are kept, on average",
                    double(bake.haar->indices.size()) / double(bake.haar->offsets.size() - 1),
                    cubeTexelCount(request.haar.size)));
    clock_.mark("haar");
  }

  void makeGlossy(const std::vector<double>& fitted, const SlotTransfer& transfer, Bake& bake) {
    const std::vector<float> matrices =
        makeGlossyMatrices(scene, mesh, caster, cast, fitted, transfer, request.glossy.order, progress_);
    bake.glossy = packGlossy(mesh, transfer, matrices, scene, request.glossy.order);
    clock_.mark("glossy");
  }

  /// Lights of different colours in one group make its channels differ even without bounces.
  int groupChannels(const SlotTransfer& transfer) const {
    return request.lightGroups.named.empty() ? transfer.channels() : 3;
  }

  int bounces_;
  Progress& progress_;
  BakeReport& report_;
  StageClock& clock_;
};

CastOptions castOptions(const BakeRequest& request, const Schedule& schedule, std::uint32_t capacity,
                        const GroupedLights& lights, const ShadowSets& sets, const BakedOccluders* occluders,
                        std::span<Tracer> setTracers) {
  const int order = transferOrder(request);
  CastOptions options;
  options.shOrder = castOrder(request);
  options.raysPerReceiver = schedule.raysPerReceiver;
  options.storedReceivers = capacity;
  options.bounceColumns = static_cast<std::size_t>(order * order) + lights.groups.size();
  options.texelFaceSize = request.haar.size;
  options.lights = lights.empty() ? nullptr : &lights;
  options.sets = &sets;
  options.setTracers = setTracers;
  options.limits = request.limits;
  options.occluders = occluders != nullptr ? &occluders->groups : nullptr;
  return options;
}

Projections projectionsOf(const BakeRequest& request, const Plan& plan, const Schedule& schedule,
                          const GroupedLights& lights, const ShadowSets& sets,
                          const BakedOccluders* occluders) {
  Projections projections;
  projections.sets = &sets;
  projections.shOrder = castOrder(request);
  projections.bentNormal = request.ao;
  projections.groups = static_cast<std::uint32_t>(lights.groups.size());
  if (request.haar.size > 0) {
    projections.texelRows = plan.texelBytes / (sizeof(std::uint32_t) * schedule.raysPerReceiver);
    projections.texelCount = cubeTexelCount(request.haar.size);
  }
  projections.backs = plan.runs(Pass::Bounces);
  projections.receivers = request.glossy.order > 0 && plan.runs(Pass::Bounces);
  projections.occluders = occluders != nullptr;
  if (occluders != nullptr)
    projections.occluderCount = static_cast<std::uint32_t>(occluders->groups.names.size());
  return projections;
}

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Of receivers that are not vertices.
void checkPlaces(const BakeRequest& request, const Charts* charts) {
  const bool texels = charts != nullptr && !charts->charts.empty();
  if (request.sh.order == 0 && (request.volume.size > 0 || texels))
    throw UsageError(request.volume.size > 0 ? "--volume" : "--texels",
                     "it has the order of the SH transfer, and none is asked for", "add --sh N");
  if (!texels) return;
  std::uint64_t bytes = 0;
  for (const Chart& chart : charts->charts)
    bytes += static_cast<std::uint64_t>(chart.width) * static_cast<std::uint64_t>(chart.height) * 4u *
             static_cast<std::uint64_t>(request.sh.order * request.sh.order * (request.bounces > 0 ? 3 : 1));
  if (bytes > request.maxMemory)
    throw UsageError("--texels",
                     fmt::format("{} light maps take {} MB, more than the {} MB of --max-memory",
                                 charts->charts.size(), bytes >> 20, request.maxMemory >> 20),
                     "bake fewer texels or a lower order, or raise --max-memory");
}

/// What is projected from the hemispheres of receivers, with all that it needs.
class ReceiverBake {
 public:
  /// What is given outlives it.
  ReceiverBake(const CompiledScene& scene, const BakeRequest& request, const Plan& plan, const FitMesh& mesh,
               const ShadowSets& sets, const Charts* charts, const Device& device, Tracer& tracer,
               Clock::time_point start)
      : request_(request),
        plan_(plan),
        schedule_(makeSchedule(request, mesh.slotCount(), start)),
        setTracers_(tracersOf(scene, sets, tracer)),
        capacity_(plan.runs(Pass::Bounces) ? storedCapacity(plan, device, schedule_.raysPerReceiver) : 0),
        lights_(request.lightGroups ? groupLights(scene, request.lightGroups.named) : GroupedLights{}),
        occluders_(request.occluders ? std::optional(occludersOf(scene, request.occluders.kind))
                                     : std::nullopt),
        caster_(scene, tracer,
                castOptions(request, schedule_, capacity_, lights_, sets, occluders_ ? &*occluders_ : nullptr,
                            setTracers_)),
        cast_(scene, mesh, caster_, schedule_,
              projectionsOf(request, plan, schedule_, lights_, sets, occluders_ ? &*occluders_ : nullptr),
              capacity_),
        parts_{scene,  request, mesh,        lights_, sets, occluders_ ? &*occluders_ : nullptr,
               charts, tracer,  setTracers_, caster_, cast_} {}

  Bake run(Progress& progress, BakeReport& report, StageClock& clock) {
    Bake bake = BakeRunner(parts_, plan_, progress, report, clock).run();
    for (const Tracer& part : setTracers_) report.bytesBvh += part.bvhBytes();
    report.rays += cast_.rays() + caster_.furtherRays();
    report.receivers = cast_.receivers();
    if (!request_.effort.error && !request_.effort.seconds)
      report.skippedRayFraction = std::max(
          0.0, 1.0 - double(cast_.front().receivers()) / (schedule_.receiversPerPass * schedule_.passes));
    return bake;
  }

  std::uint64_t receivers() const { return cast_.receivers(); }
  void save(StateWriter& state) const { cast_.save(state); }
  void load(StateReader& state) { cast_.load(state); }

 private:
  static std::vector<Tracer> tracersOf(const CompiledScene& scene, const ShadowSets& sets, Tracer& tracer) {
    std::vector<Tracer> tracers;
    for (const ShadowSets::Occluders& set : sets.sets) tracers.emplace_back(tracer, scene, set.triangles);
    return tracers;
  }

  const BakeRequest& request_;
  const Plan& plan_;
  Schedule schedule_;
  std::vector<Tracer> setTracers_;
  std::uint32_t capacity_;
  GroupedLights lights_;
  std::optional<BakedOccluders> occluders_;
  Caster caster_;
  SceneCast cast_;
  BakeParts parts_;
};

/// A light map's texels under all that lights them.
LightMap runLightMap(LightMapBake& bake, const CompiledScene& scene, const Scene& source,
                     const BakeRequest& request, const Plan& plan, const Device& device, Tracer& tracer,
                     Progress& progress, BakeReport& report) {
  const LightMapSources sources(scene, source.images, bake.layout(), request, plan,
                                lightMapCoefficients(plan), device, tracer, progress);
  bake.run(sources.parts(), progress);
  LightMap map = bake.finish(usualCreaseAngle, *report.lightMap);
  report.rays += report.lightMap->rays;
  report.notes.push_back(noteOf(map.layout, *report.lightMap));
  return map;
}

/// The state of a bake: what receivers saw, then what elements saw, then texels.
void saveTo(BakeCheckpoint& checkpoint, const std::optional<ReceiverBake>& receivers,
            const std::optional<RadiosityBake>& radiosity, const std::optional<LightMapBake>& lightMap,
            Clock::time_point start) {
  if (receivers && receivers->receivers() == 0) return;
  checkpoint.save([&](StateWriter& state) {
    state.value(secondsSince(start));
    if (receivers) receivers->save(state);
    if (radiosity) radiosity->save(state);
    if (lightMap) lightMap->save(state);
  });
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

}  // namespace

Bake bakeScene(const CompiledScene& scene, const BakeRequest& request, const Plan& plan, const Device& device,
               Progress& progress, BakeReport& report, BakeCheckpoint* checkpoint, const Charts* charts,
               const Scene* source) {
  if (scene.triangleCount() == 0)
    throw InputError("scene", "there is no triangle to bake",
                     "bake needs a mesh with at least one triangle of non-zero area");
  checkPlaces(request, charts);
  std::optional<StateReader> saved = checkpoint != nullptr ? checkpoint->load() : std::nullopt;
  const auto start = Clock::now() - std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(earlierSeconds(saved)));
  StageClock clock(report.stageSeconds);
  const ShadowSets sets = makeShadowSets(scene, request.shadowSets);
  const FitMesh mesh = makeFitMesh(scene, sets.setOfVertices(scene));
  Tracer tracer(scene, device);
  report.bytesBvh = tracer.bvhBytes();
  std::optional<ReceiverBake> receivers;
  if (request.castsReceivers())
    receivers.emplace(scene, request, plan, mesh, sets, charts, device, tracer, start);
  std::optional<RadiosityBake> radiosity;
  if (plan.runs(Pass::Radiosity)) radiosity.emplace(scene, request, tracer);
  if (saved && receivers) receivers->load(*saved);
  if (saved && radiosity) radiosity->load(*saved);
  clock.mark("prepare");
  std::optional<LightMapBake> lightMap;
  if (plan.runs(Pass::LightMap) && source != nullptr) {
    lightMap.emplace(scene,
                     makeLightMapLayout(*source, scene, request, plan, device, tracer, progress,
                                        report.lightMap.emplace(), report.rays),
                     lightMapCoefficients(plan));
    clock.mark("layout");
  }
  if (saved && lightMap) lightMap->load(*saved);
  if (saved) saved->require(saved->rest().empty());
  saved.reset();

  const auto save = [&] {
    if (checkpoint != nullptr) saveTo(*checkpoint, receivers, radiosity, lightMap, start);
  };
  constexpr double never = 1e9;
  SavingProgress saving(progress, checkpoint != nullptr ? checkpoint->interval() : never, save);
  Bake bake;
  try {
    if (receivers) bake = receivers->run(saving, report, clock);
    if (radiosity) bake.irradiance = radiosity->run(mesh, saving, report);
    if (lightMap) {
      clock.restart();
      bake.lightMap = runLightMap(*lightMap, scene, *source, request, plan, device, tracer, saving, report);
      if (!bake.irradiance) bake.irradiance = irradianceOfVertices(scene, mesh, *bake.lightMap);
      clock.mark("light map");
      if (plan.runs(Pass::EncodedLight)) {
        encodeLight(scene, mesh, request.encodedLight, plan, saving, bake);
        clock.mark("encoded light");
      }
    }
  } catch (const Interrupted&) {
    save();
    throw;
  }
  if (request.radiosity && !radiosity) bake.irradiance.emplace(scene.vertexCount(), glm::vec3(0.0f));
  bake.info = {
      std::string("Prelight ") + PRELIGHT_VERSION,    request.seed, report.rays,        report.aoErrorRms,
      plan.runs(Pass::Bounces) ? request.bounces : 0, plan,         device.info().name, secondsSince(start)};
  return bake;
}

}  // namespace prelight
