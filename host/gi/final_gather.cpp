#include "gi/final_gather.h"

#include <algorithm>

#include "base/kept_work.h"
#include "cast/caster.h"
#include "receivers/sampling.h"
#include "receivers/surface_sampler.h"

namespace prelight {

std::vector<device::Receiver> gatherReceivers(const CompiledScene& compiled,
                                              std::span<const LightMapTexel> places, std::uint32_t count,
                                              std::uint32_t rays, std::uint64_t seed) {
  std::vector<device::Receiver> receivers;
  receivers.reserve(places.size() * count);
  const std::uint32_t folded =
      sampling::hashInteger(static_cast<std::uint32_t>(seed ^ (seed >> 32)) ^ 0x2545f491u);
  for (const LightMapTexel& place : places) {
    device::Receiver receiver = receiverAt(compiled, place);
    receiver.seed = sampling::hashInteger(place.texel + folded);
    for (std::uint32_t i = 0; i < count; ++i) {
      receiver.firstSample = i * rays;
      receivers.push_back(receiver);
    }
  }
  return receivers;
}

std::vector<device::DensityQuery> densityQueries(std::span<const device::Receiver> receivers,
                                                 AroundNormal normal, double radius,
                                                 std::span<const std::uint32_t> patches) {
  std::vector<device::DensityQuery> queries;
  queries.reserve(receivers.size());
  for (const device::Receiver& r : receivers) {
    device::DensityQuery query{};
    for (int k = 0; k < 3; ++k) {
      query.position[k] = r.position[k];
      query.normal[k] = normal == AroundNormal::Geometric ? r.geometricNormal[k] : r.normal[k];
    }
    query.triangle = r.triangle;
    query.radius = static_cast<float>(radius);
    query.patch = patches.empty() ? PRELIGHT_WHOLE_REGION : 1 + patches[queries.size()];
    queries.push_back(query);
  }
  return queries;
}

std::vector<device::DensityQuery> densityQueries(const CompiledScene& compiled,
                                                 std::span<const LightMapTexel> places, double radius,
                                                 std::span<const std::uint32_t> patches) {
  return densityQueries(gatherReceivers(compiled, places, 1, 0, 0), AroundNormal::Geometric, radius, patches);
}

namespace {

using namespace device;

/// Returns whether any lobe is rough. If all surfaces are smooth or diffuse, rays find lamps only by chance.
bool hasRoughLobes(const ShadeFeatures& features) {
  return features.glossy || features.layers || features.roughGlass;
}

}  // namespace

FinalGather::FinalGather(TransportScene& scene, const IrradianceMap& irradiance, const GatherRequest& request)
    : scene_(scene),
      device_(scene.context()),
      irradiance_(irradiance),
      request_(request),
      blockSize_(receiversPerBlock(device_.info(), request.raysPerReceiver)),
      follows_(scene.features().specularLobes()),
      asksLights_(follows_ && hasRoughLobes(scene.features()) && scene.lights().groupCount > 0),
      castParameters_(device_, 1),
      parameters_(device_, 1),
      receivers_(device_, blockSize_),
      sums_(device_, 3 * std::size_t{blockSize_}) {
  const std::size_t rays = std::size_t{blockSize_} * request.raysPerReceiver;
  mostRays_ = static_cast<std::uint32_t>(rays);
  rayBuffer_ = Buffer<Ray>(device_, follows_ ? 2 * rays : rays);
  paths_ = Buffer<GatherPath>(device_, follows_ ? 2 * rays : 0);
  hits_ = Buffer<Hit>(device_, rays);
  marks_ = Buffer<std::uint8_t>(device_, rays);
  shadowRays_ = Buffer<Ray>(device_, asksLights_ ? 2 * rays : 0);
  arrivals_ = Buffer<GatherArrival>(device_, asksLights_ ? rays : 0);
  shadowHits_ = Buffer<Hit>(device_, asksLights_ ? rays : 0);
  radiances_ = Buffer<float>(device_, 3 * rays);
  if (follows_) queue_.emplace(device_, mostRays_);
  values_.raysPerReceiver = request.raysPerReceiver;
  values_.seed = static_cast<std::uint32_t>(request.seed ^ (request.seed >> 32));
  values_.map = irradiance.layout();
  values_.longWay = request.longWay;
  generate_ = {device_, "cast/generate_kernels.cl", {}, "generateRays"};
  const char* file = "gather/gather_kernels.cl";
  const BuildOptions options =
      scene.options().defineIf(follows_, "PRELIGHT_FOLLOWS").defineIf(asksLights_, "PRELIGHT_ASKS_LIGHTS");
  gather_ = {device_, file, options, "gatherRadiance"};
  sum_ = {device_, file, options, "sumRadiance"};
  if (!asksLights_) return;
  ask_ = {device_, file, options, "askLights"};
  add_ = {device_, file, options, "addArrivals"};
}

/// Fills `values`, which has the same number per receiver. Finished blocks are kept.
template <typename Summing>
void FinalGather::gatherBlocks(std::span<const Receiver> receivers, Progress& progress,
                               std::vector<float>& values, std::vector<std::uint32_t>* seen,
                               const Summing& sumBlock) {
  std::uint64_t done = 0;
  const std::uint64_t before = rays_;
  std::vector<std::uint32_t> none;
  std::vector<std::uint32_t>& met = seen != nullptr ? *seen : none;
  WorkPart part(progress, "gather", [&](auto& state) {
    std::uint64_t rays = rays_ - before;
    state.value(done);
    state.value(rays);
    state.require(done <= receivers.size());
    state.growing(values, done * (values.size() / std::max<std::size_t>(1, receivers.size())));
    state.requireFinite(values);
    state.growing(met);
    rays_ = before + rays;
  });
  while (done < receivers.size()) {
    progress.report("final gathering", static_cast<double>(done) / static_cast<double>(receivers.size()));
    progress.check();
    const std::size_t count = std::min<std::size_t>(blockSize_, receivers.size() - done);
    traceBlock(receivers.subspan(done, count), seen);
    sumBlock(done, count);
    done += count;
    part.advance();
  }
  part.finish();
}

std::vector<glm::vec3> FinalGather::gather(std::span<const Receiver> receivers, Progress& progress,
                                           std::vector<std::uint32_t>* seen) {
  if (seen != nullptr) seen->clear();
  std::vector<float> values(3 * receivers.size());
  gatherBlocks(receivers, progress, values, seen, [&](std::size_t first, std::size_t count) {
    sum_.launch(count, parameters_, radiances_, sums_);
    sums_.read(std::span(values).subspan(3 * first, 3 * count));
  });
  std::vector<glm::vec3> irradiance;
  irradiance.reserve(receivers.size());
  for (std::size_t i = 0; i < values.size(); i += 3)
    irradiance.emplace_back(values[i], values[i + 1], values[i + 2]);
  return irradiance;
}

void FinalGather::prepareIncident(int order) {
  if (incidentOrder_ == order) return;
  BuildOptions options;
  addIncidentOrder(options, order);
  sumIncident_ = {device_, "gather/incident_kernels.cl", options, "sumIncident"};
  incident_ = Buffer<float>(
      device_, 3 * static_cast<std::size_t>(incidentValueCount(order)) * std::size_t{blockSize_});
  incidentOrder_ = order;
}

std::vector<float> FinalGather::gatherIncident(std::span<const Receiver> receivers, Progress& progress,
                                               int order) {
  prepareIncident(order);
  const std::size_t length = 3 * static_cast<std::size_t>(incidentValueCount(order));
  std::vector<float> incident(length * receivers.size());
  gatherBlocks(receivers, progress, incident, nullptr, [&](std::size_t first, std::size_t count) {
    // Rays that continued have overwritten the first ones, which are generated again.
    if (follows_)
      generate_.launch(count * request_.raysPerReceiver / 8, castParameters_, receivers_, rayBuffer_);
    sumIncident_.launch(count, parameters_, receivers_, rayBuffer_, radiances_, incident_);
    incident_.read(std::span(&incident[length * first], length * count));
  });
  return incident;
}

GatherBlock FinalGather::blockOf(std::size_t first, std::size_t count) {
  return {first,       count,           count * request_.raysPerReceiver,
          parameters_, castParameters_, receivers_,
          rayBuffer_,  hits_,           radiances_};
}

void FinalGather::gather(std::span<const Receiver> receivers, GatherPattern& pattern, Progress& progress) {
  for (std::size_t first = 0; first < receivers.size(); first += blockSize_) {
    progress.report("final gathering", static_cast<double>(first) / static_cast<double>(receivers.size()));
    progress.check();
    const std::size_t count = std::min<std::size_t>(blockSize_, receivers.size() - first);
    setReceivers(receivers.subspan(first, count));
    const GatherBlock block = blockOf(first, count);
    pattern.makeRays(block);
    const std::uint32_t active = collect(static_cast<std::uint32_t>(block.rayCount), 0);
    pattern.meet(block);
    traceOn(active);
    pattern.sum(block);
  }
}

void FinalGather::setReceivers(std::span<const Receiver> receivers) {
  const auto count = static_cast<std::uint32_t>(receivers.size());
  values_.receiverCount = count;
  values_.scene = scene_.handle().layout();
  parameters_.write(std::span<const GatherParameters>(&values_, 1));
  CastParameters cast{};
  cast.receiverCount = count;
  cast.raysPerReceiver = request_.raysPerReceiver;
  castParameters_.write(std::span<const CastParameters>(&cast, 1));
  receivers_.write(receivers);
}

void FinalGather::traceBlock(std::span<const Receiver> receivers, std::vector<std::uint32_t>* seen) {
  setReceivers(receivers);
  const auto first = static_cast<std::uint32_t>(receivers.size()) * request_.raysPerReceiver;
  generate_.launch(first / 8, castParameters_, receivers_, rayBuffer_);
  const std::uint32_t active = collect(first, 0);
  if (seen != nullptr) {
    std::vector<Hit> hits(first);
    hits_.read(std::span(hits));
    for (const Hit& hit : hits) seen->push_back(hit.triangle);
  }
  traceOn(active);
}

void FinalGather::traceOn(std::uint32_t active) {
  for (int depth = 1; depth < request_.depth && active > 0; ++depth)
    active = collect(active, static_cast<std::uint32_t>(depth));
}

/// Processes one surface of the remaining rays. Returns how many continue.
std::uint32_t FinalGather::collect(std::uint32_t count, std::uint32_t depth) {
  scene_.tracer().traceClosest(rayBuffer_, hits_, count);
  rays_ += count;
  const DeviceScene& handle = scene_.handle();
  gather_.launch(count, parameters_, GatherStep{count, depth, mostRays_}, handle.surface(), handle.shading(),
                 handle.lights(), irradiance_.lines(), receivers_, rayBuffer_, hits_, paths_, radiances_,
                 marks_);
  if (!follows_) return 0;
  if (asksLights_) askLights(count, depth);
  const auto listed = queue_->list(marks_, count);
  if (asksLights_) addArrivals(listed[PRELIGHT_GATHER_SHADOW]);
  const std::uint32_t left = listed[PRELIGHT_GATHER_NEXT];
  queue_->move(PRELIGHT_GATHER_NEXT, left, QueuedItems<Ray>{rayBuffer_, mostRays_, rayBuffer_},
               QueuedItems<GatherPath>{paths_, mostRays_, paths_});
  return left;
}

/// Marks the shadow rays from the ends of rays. Rays that continue must not have been moved yet.
void FinalGather::askLights(std::uint32_t count, std::uint32_t depth) {
  const DeviceScene& handle = scene_.handle();
  ask_.launch(count, parameters_, GatherStep{count, depth, mostRays_}, handle.surface(), handle.shading(),
              handle.lights(), receivers_, rayBuffer_, hits_, paths_, shadowRays_, arrivals_, marks_);
}

void FinalGather::addArrivals(std::uint32_t shadows) {
  if (shadows == 0) return;
  queue_->move(PRELIGHT_GATHER_SHADOW, shadows, QueuedItems<Ray>{shadowRays_, 0, shadowRays_, mostRays_});
  scene_.tracer().traceShadows(shadowRays_, shadowHits_, shadows, mostRays_);
  rays_ += shadows;
  add_.launch(shadows, shadows, queue_->first(PRELIGHT_GATHER_SHADOW), queue_->lists(), shadowHits_,
              arrivals_, radiances_);
}

GuidedGather::GuidedGather(const FinalGather& gather, std::span<const float> guides, std::size_t receivers)
    : guides_(guides), irradiance_(receivers) {
  DeviceContext& device = gather.device();
  const std::size_t most = std::min<std::size_t>(receivers, gather.receiversAtOnce());
  guideBuffer_ = Buffer<float>(device, PRELIGHT_GUIDE_CELLS * most);
  weights_ = Buffer<float>(device, most * gather.raysPerReceiver());
  sums_ = Buffer<float>(device, 3 * most);
  const char* file = "gather/guided_kernels.cl";
  generate_ = {device, file, {}, "generateGuidedRays"};
  sum_ = {device, file, {}, "sumGuided"};
}

void GuidedGather::makeRays(const GatherBlock& block) {
  guideBuffer_.write(guides_.subspan(PRELIGHT_GUIDE_CELLS * block.first, PRELIGHT_GUIDE_CELLS * block.count));
  generate_.launch(block.rayCount / 8, block.parameters, block.receivers, guideBuffer_, block.rays, weights_);
}

void GuidedGather::sum(const GatherBlock& block) {
  sum_.launch(block.count, block.parameters, block.radiances, weights_, sums_);
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
  sums_.read(std::span(&irradiance_[block.first].x, 3 * block.count));
}

BoundedGather::BoundedGather(const FinalGather& gather, std::size_t receivers) : irradiance_(receivers) {
  DeviceContext& device = gather.device();
  sums_ = Buffer<float>(device, 6 * std::min<std::size_t>(receivers, gather.receiversAtOnce()));
  generate_ = {device, "cast/generate_kernels.cl", {}, "generateRays"};
  sum_ = {device, "gather/bounded_kernels.cl", {}, "sumBounded"};
}

void BoundedGather::makeRays(const GatherBlock& block) {
  generate_.launch(block.rayCount / 8, block.cast, block.receivers, block.rays);
}

void BoundedGather::sum(const GatherBlock& block) {
  sum_.launch(block.count, block.parameters, mostOfMean, block.radiances, sums_);
  static_assert(sizeof(BoundedIrradiance) == 6 * sizeof(float));
  sums_.read(std::span(&irradiance_[block.first].bounded.x, 6 * block.count));
}

}  // namespace prelight
