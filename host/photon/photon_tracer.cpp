#include "photon/photon_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/kept_work.h"
#include "base/work_share.h"

namespace prelight {

namespace {

using namespace device;

// Kinds of PRELIGHT_PHOTON_* in the work queue.
constexpr std::uint32_t goesOn = 0, staysHere = 1, metBack = 2;
constexpr std::uint32_t tallyRun = 256;  // tallies that one work-item sums up
constexpr std::uint32_t tallyColumns = 6;
// 2^26: precise enough for one photon, and 10^11 photons fit in 63 bits
constexpr double countsAPhoton = 67108864.0;

std::uint32_t photonsPerBlock(const DeviceInfo& info) {
  return info.kind == DeviceKind::Gpu ? 1u << 20 : 1u << 16;
}

/// Returns W per count of the tallies. It is a normal float, as kernels divide by it.
double unitOf(const PhotonSources& sources) {
  double power = 0.0, count = 0.0;
  for (std::size_t i = 0; i < sources.sources.size(); ++i) {
    power += sources.powers[i];
    count += sources.sources[i].count;
  }
  return std::max(power / std::max(count, 1.0) / countsAPhoton, double(std::numeric_limits<float>::min()));
}

void setVector(float (&out)[3], const glm::dvec3& v) {
  for (int c = 0; c < 3; ++c) out[c] = static_cast<float>(v[c]);
}

Eye eyeOf(const CameraAxes& axes) {
  Eye eye{};
  setVector(eye.position, axes.eye);
  setVector(eye.right, axes.right);
  setVector(eye.up, axes.up);
  setVector(eye.forward, axes.forward);
  eye.perspective = axes.perspective ? 1 : 0;
  eye.zNear = static_cast<float>(axes.zNear);
  return eye;
}

BuildOptions scatterOptions(const PhotonRequest& request, BuildOptions options) {
  return options.defineIf(request.kind == PhotonKind::Caustic, "PRELIGHT_CAUSTICS")
      .defineIf(request.sharp, "PRELIGHT_SHARP_CAUSTICS")
      .defineIf(request.kind == PhotonKind::All, "PRELIGHT_STORE_DIRECT")
      .defineIf(request.emittersDirectly, "PRELIGHT_STORE_EMITTED");
}

}  // namespace

void PhotonReport::add(const PhotonReport& more) {
  for (std::size_t c = 0; c < 3; ++c) {
    power.emitted[c] += more.power.emitted[c];
    power.absorbed[c] += more.power.absorbed[c];
    power.escaped[c] += more.power.escaped[c];
    power.cut[c] += more.power.cut[c];
  }
  emitted += more.emitted;
  stored += more.stored;
  rays += more.rays;
}

void PhotonHits::append(const PhotonHits& more) {
  photons.insert(photons.end(), more.photons.begin(), more.photons.end());
  paths.insert(paths.end(), more.paths.begin(), more.paths.end());
  flights.insert(flights.end(), more.flights.begin(), more.flights.end());
  flightPaths.insert(flightPaths.end(), more.flightPaths.begin(), more.flightPaths.end());
  backs.resize(std::max(backs.size(), more.backs.size()), 0);
  for (std::size_t t = 0; t < more.backs.size(); ++t) backs[t] |= more.backs[t];
}

PhotonTracer::PhotonTracer(const CompiledScene& compiled, TransportScene& scene)
    : compiled_(compiled),
      scene_(scene),
      device_(scene.context()),
      blockPhotons_(photonsPerBlock(device_.info())),
      parameters_(device_, 1),
      chosen_(device_, 0),
      paths_(device_, blockPhotons_),
      rays_(device_, 2 * std::size_t{blockPhotons_}),
      queue_(device_, blockPhotons_),
      nextQueue_(device_, blockPhotons_),
      hits_(device_, blockPhotons_),
      candidates_(device_, blockPhotons_),
      photons_(device_, blockPhotons_),
      numbers_(device_, blockPhotons_),
      outcomes_(device_, blockPhotons_),
      tallies_(device_, std::size_t{tallyColumns} * blockPhotons_),
      sums_(device_, std::size_t{tallyColumns} * (blockPhotons_ / tallyRun + 1)),
      work_(device_, blockPhotons_) {}

void PhotonTracer::build(const PhotonRequest& request, const PhotonSources& sources) {
  emit_ = {device_, "photon/emit_kernels.cl", scene_.options(), "emitPhotons"};
  const char* file = "photon/scatter_kernels.cl";
  const BuildOptions options = scatterOptions(request, scene_.options());
  scatter_ = {device_, file, options, "scatterPhotons"};
  sum_ = {device_, file, options, "sumTallies"};
  const double sceneRadius =
      0.5 * glm::length(glm::dvec3(compiled_.boundsMax) - glm::dvec3(compiled_.boundsMin));
  values_.rouletteDepth = static_cast<std::uint32_t>(request.rouletteDepth);
  values_.unit = static_cast<float>(unitOf(sources));
  values_.radius = static_cast<float>(sources.radius);
  values_.distance = static_cast<float>(2.01 * sceneRadius);
  setVector(values_.centre, sources.centre);
  values_.scene = scene_.handle().layout();
  if (sources.eye) values_.eye = eyeOf(*sources.eye);
  cells_ = Buffer<SourceCell>(device_, std::span<const SourceCell>(sources.cells));
  leastGrid_.reset();
  if (!sources.least) return;
  leastGrid_ = sources.least->grid;
  least_ = Buffer<float>(device_, std::span<const float>(sources.least->watts));
  endUnimportant_ = {device_, "photon/importance_kernels.cl", {}, "endUnimportant"};
}

PhotonSources PhotonTracer::sourcesOf(const PhotonRequest& request) const {
  return request.kind == PhotonKind::Caustic && request.aimed
             ? sourcesTowardsCasters(compiled_, scene_.lights(), request.photons, request.seed)
             : allSources(compiled_, scene_.lights(), request.photons, request.seed);
}

PhotonReport PhotonTracer::trace(const PhotonRequest& request, PhotonHits& hits, Progress& progress) {
  return trace(request, sourcesOf(request), hits, progress);
}

PhotonReport PhotonTracer::trace(const PhotonRequest& request, const Sink& sink, Progress& progress) {
  const PhotonSources sources = sourcesOf(request);
  Course at;
  if (!sources.sources.empty()) begin(request, sources, at);
  while (at.source < sources.sources.size()) {
    PhotonHits block;
    sendBlock(request, sources, at, block, progress);
    sink(block);
  }
  return at.report;
}

PhotonReport PhotonTracer::trace(const PhotonRequest& request, const PhotonSources& sources, PhotonHits& hits,
                                 Progress& progress) {
  Course at;
  WorkPart part(progress, "photons", [&](auto& state) { exchange(state, sources, at, hits); });
  if (at.source == sources.sources.size()) return at.report;
  begin(request, sources, at);
  SharedLoop loop(part, "photons");
  while (at.source < sources.sources.size()) {
    setBlock(sources, at, progress);
    PhotonHits block;
    PhotonReport sent;
    const std::uint32_t first = at.paths, count = values_.pathCount;
    if (count > 0)
      loop.run(
          {first, count}, [&] { traceBlock(request, first, block, sent); },
          [&](auto& state) {
            state.value(sent);
            exchangeHits(state, first, first + count, block);
          });
    hits.append(block);
    at.report.add(sent);
    pass(sources, at);
    part.advance();
  }
  loop.end();
  part.finish();
  return at.report;
}

/// Writes or reads the state of tracing and the stored hits.
template <typename State>
void PhotonTracer::exchange(State& state, const PhotonSources& sources, Course& at, PhotonHits& hits) const {
  state.value(at.source);
  state.value(at.photons);
  state.value(at.paths);
  state.value(at.report);
  state.require(std::isfinite(at.report.power.unit) && at.source <= sources.sources.size() &&
                (at.source == sources.sources.size() ? at.photons == 0
                                                     : at.photons <= sources.sources[at.source].count));
  exchangeHits(state, 0, at.paths, hits);
}

/// Writes or reads hits of paths [firstPath, endPath).
template <typename State>
void PhotonTracer::exchangeHits(State& state, std::uint32_t firstPath, std::uint32_t endPath,
                                PhotonHits& hits) const {
  state.growing(hits.photons);
  state.growing(hits.paths);
  state.growing(hits.flights);
  state.growing(hits.flightPaths);
  state.values(hits.backs);
  const std::uint32_t triangles = compiled_.triangleCount();
  state.require(hits.paths.size() == hits.photons.size() && hits.flights.size() == hits.flightPaths.size());
  state.require(hits.backs.empty() || hits.backs.size() == triangles);
  state.check([&] {
    const auto isPath = [&](std::uint32_t path) { return path >= firstPath && path < endPath; };
    return std::all_of(hits.photons.begin(), hits.photons.end(),
                       [&](const Photon& photon) {
                         const float sum = photon.position[0] + photon.position[1] + photon.position[2] +
                                           photon.power[0] + photon.power[1] + photon.power[2];
                         return photon.triangle < triangles && std::isfinite(sum);
                       }) &&
           std::all_of(hits.paths.begin(), hits.paths.end(), isPath) &&
           std::all_of(hits.flightPaths.begin(), hits.flightPaths.end(), isPath);
  });
}

void PhotonTracer::begin(const PhotonRequest& request, const PhotonSources& sources, Course& at) {
  build(request, sources);
  at.report.power.unit = unitOf(sources);
  values_.chosen = 0;
}

void PhotonTracer::sendBlock(const PhotonRequest& request, const PhotonSources& sources, Course& at,
                             PhotonHits& block, Progress& progress) {
  setBlock(sources, at, progress);
  if (values_.pathCount > 0) traceBlock(request, at.paths, block, at.report);
  pass(sources, at);
}

/// Sets which photons are sent next.
void PhotonTracer::setBlock(const PhotonSources& sources, const Course& at, Progress& progress) {
  const double all = std::accumulate(sources.sources.begin(), sources.sources.end(), 0.0,
                                     [](double sum, const PhotonSource& s) { return sum + s.count; });
  const PhotonSource& source = sources.sources[at.source];
  progress.report("photons", static_cast<double>(at.report.emitted) / all);
  progress.check();
  values_.source = source;
  values_.firstPhoton = at.photons;
  values_.pathCount = std::min(blockPhotons_, source.count - at.photons);
}

/// Goes past the photons that setBlock() has chosen.
void PhotonTracer::pass(const PhotonSources& sources, Course& at) const {
  at.paths += values_.pathCount;
  at.photons += values_.pathCount;
  if (at.photons < sources.sources[at.source].count) return;
  ++at.source;
  at.photons = 0;
}

PhotonReport PhotonTracer::trace(const PhotonRequest& request, const PhotonSources& sources,
                                 std::size_t source, std::span<const std::uint32_t> photons, PhotonHits& hits,
                                 Progress& progress) {
  PhotonReport report;
  build(request, sources);
  report.power.unit = unitOf(sources);
  values_.chosen = 1;
  values_.source = sources.sources[source];
  chosen_ = Buffer<std::uint32_t>(device_, photons);
  const auto count = static_cast<std::uint32_t>(photons.size());
  for (std::uint32_t first = 0; first < count; first += values_.pathCount) {
    progress.check();
    values_.firstPhoton = first;
    values_.pathCount = std::min(blockPhotons_, count - first);
    traceBlock(request, first, hits, report);
  }
  return report;
}

void PhotonTracer::traceBlock(const PhotonRequest& request, std::uint32_t firstPath, PhotonHits& hits,
                              PhotonReport& report) {
  parameters_.write(std::span<const PhotonParameters>(&values_, 1));
  std::uint32_t active = values_.pathCount;
  const DeviceScene& handle = scene_.handle();
  emit_.launch(active, parameters_, handle.surface(), handle.shading(), handle.lights(), cells_, chosen_,
               paths_, queue_, rays_, tallies_);
  std::array<std::int64_t, 3> emitted{};
  sum(active, 3, emitted);
  for (std::size_t c = 0; c < 3; ++c) report.power.emitted[c] += emitted[c];
  report.emitted += active;
  std::array<std::int64_t, 3> left = emitted;
  for (std::uint32_t depth = 0; active > 0; ++depth) {
    if (depth == static_cast<std::uint32_t>(request.depth)) {
      for (std::size_t c = 0; c < 3; ++c) report.power.cut[c] += left[c];
      return;
    }
    const PhotonPower before = report.power;
    active = scatter(request, active, depth, firstPath, hits, report);
    for (std::size_t c = 0; c < 3; ++c)
      left[c] -= report.power.absorbed[c] - before.absorbed[c] + report.power.escaped[c] - before.escaped[c];
  }
}

/// Processes one surface of the active photons. Returns how many continue.
std::uint32_t PhotonTracer::scatter(const PhotonRequest& request, std::uint32_t count, std::uint32_t depth,
                                    std::uint32_t firstPath, PhotonHits& hits, PhotonReport& report) {
  scene_.tracer().traceClosest(rays_, hits_, count);
  report.rays += count;
  if (request.flights) keepFlights(count, firstPath, hits);
  const DeviceScene& handle = scene_.handle();
  scatter_.launch(count, parameters_, PhotonStep{count, depth, blockPhotons_}, handle.surface(),
                  handle.shading(), handle.lights(), rays_, hits_, queue_, paths_, outcomes_, candidates_,
                  tallies_);
  if (leastGrid_) endUnimportant(count, depth);
  std::array<std::int64_t, tallyColumns> sums{};
  sum(count, tallyColumns, sums);
  for (std::size_t c = 0; c < 3; ++c) {
    report.power.absorbed[c] += sums[c];
    report.power.escaped[c] += sums[3 + c];
  }
  const std::array<std::uint32_t, WorkQueue::kinds> listed = work_.list(outcomes_, count);
  markBacks(listed[metBack], hits);
  report.stored += listed[staysHere];
  store(listed[staysHere], firstPath, hits);
  const std::uint32_t left = listed[goesOn];
  if (left == 0) return 0;
  // The rays of this step are no longer needed and are overwritten.
  work_.move(goesOn, left, QueuedItems<Ray>{rays_, blockPhotons_, rays_},
             QueuedItems<std::uint32_t>{queue_, 0, nextQueue_});
  std::swap(queue_, nextQueue_);
  return left;
}

void PhotonTracer::endUnimportant(std::uint32_t count, std::uint32_t depth) {
  endUnimportant_.launch(count, parameters_, PhotonStep{count, depth, blockPhotons_}, *leastGrid_, least_,
                         rays_, hits_, queue_, paths_, outcomes_, tallies_);
}

void PhotonTracer::markBacks(std::uint32_t count, PhotonHits& hits) {
  if (count == 0) return;
  hits.backs.resize(compiled_.triangleCount(), 0);
  std::vector<std::uint32_t> listed(count);
  work_.lists().read(std::span(listed), work_.first(metBack));
  std::vector<Hit> met(listed.back() + 1);  // the list ascends
  hits_.read(std::span(met));
  for (const std::uint32_t i : listed) hits.backs[met[i].triangle] = 1;
}

void PhotonTracer::store(std::uint32_t count, std::uint32_t firstPath, PhotonHits& hits) {
  if (count == 0) return;
  work_.move(staysHere, count, QueuedItems<Photon>{candidates_, 0, photons_},
             QueuedItems<std::uint32_t>{queue_, 0, numbers_});
  const std::size_t before = hits.photons.size();
  hits.photons.resize(before + count);
  hits.paths.resize(before + count);
  photons_.read(std::span(hits.photons).subspan(before));
  numbers_.read(std::span(hits.paths).subspan(before));
  for (std::size_t i = before; i < hits.paths.size(); ++i) hits.paths[i] += firstPath;
}

void PhotonTracer::keepFlights(std::uint32_t count, std::uint32_t firstPath, PhotonHits& hits) {
  std::vector<Ray> rays(count);
  std::vector<Hit> met(count);
  std::vector<std::uint32_t> numbers(count);
  rays_.read(std::span(rays));
  hits_.read(std::span(met));
  queue_.read(std::span(numbers));
  for (std::uint32_t i = 0; i < count; ++i) {
    if (met[i].triangle != PRELIGHT_NO_TRIANGLE) rays[i].tMax = met[i].t;
    hits.flights.push_back({rays[i], met[i].triangle});
    hits.flightPaths.push_back(firstPath + numbers[i]);
  }
}

/// Sums up the tallies, [count][columns].
void PhotonTracer::sum(std::uint32_t count, std::uint32_t columns, std::span<std::int64_t> sums) {
  const std::uint32_t groups = (count + tallyRun - 1) / tallyRun;
  sum_.launch(std::size_t{groups} * columns, count, columns, tallyRun, tallies_, sums_);
  std::vector<std::int64_t> parts(std::size_t{groups} * columns);
  sums_.read(std::span(parts));
  for (std::size_t i = 0; i < parts.size(); ++i) sums[i % columns] += parts[i];
}

SentPhotons sendPhotons(const CompiledScene& compiled, TransportScene& scene, const PhotonRequest& request,
                        Progress& progress) {
  SentPhotons sent;
  sent.report = PhotonTracer(compiled, scene).trace(request, sent.hits, progress);
  return sent;
}

}  // namespace prelight
