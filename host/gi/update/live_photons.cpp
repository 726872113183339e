#include "gi/update/live_photons.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "gi/update/photon_thinning.h"
#include "prelight/error.h"
#include "scene/light_sources.h"

namespace prelight {

namespace {

using device::Photon;
using device::PhotonSource;
using device::SourceCell;

constexpr std::uint32_t strides = 8;     // waiting photons are sent in this many sweeps through their numbers
constexpr std::size_t grain = 1u << 10;  // paths

/// Returns the lights with a positive intensity, which are those of the light tables.
std::vector<std::uint32_t> shiningLights(const std::vector<Light>& lights) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < lights.size(); ++i)
    if (shines(lights[i].intensity)) found.push_back(i);
  return found;
}

template <typename T>
bool sameBytes(std::span<const T> a, std::span<const T> b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

bool fromAfar(const PhotonSource& source, const LightTables& lights) {
  return source.kind == PRELIGHT_SOURCE_SKY ||
         (source.kind == PRELIGHT_SOURCE_PUNCTUAL &&
          lights.punctual[source.light].kind == PRELIGHT_DIRECTIONAL_LIGHT);
}

std::span<const SourceCell> cellsOf(const PhotonSources& sources, const PhotonSource& source) {
  return std::span(sources.cells).subspan(source.firstCell, source.cellCount);
}

}  // namespace

LivePhotons::LivePhotons(const LiveScene& scene, TransportScene& transport, const LivePhotonOptions& options,
                         Progress& progress)
    : scene_(scene), transport_(transport), options_(options), tracer_(scene.compiled(), transport) {
  if (options_.detection == ChangeDetection::Probes && options_.groupSize == 0)
    throw UsageError("groups of photons", "got groups of 0 photons, expected 1 or more");
  options_.request.flights = true;
  adoptSources(makeSources());
  const std::uint32_t bound = std::exchange(options_.photonsPerFrame, 0);
  const std::uint32_t frames = std::exchange(options_.frames, 0);
  PhotonDelta delta;
  restart();
  advance(delta, progress);
  options_.photonsPerFrame = bound;
  options_.frames = frames;
}

PhotonSources LivePhotons::makeSources() const {
  const PhotonRequest& r = options_.request;
  if (r.kind == PhotonKind::Caustic && r.aimed)
    return sourcesTowardsCasters(scene_.compiled(), transport_.lights(), r.photons, r.seed);
  PhotonSources made = allSources(scene_.compiled(), transport_.lights(), r.photons, r.seed);
  if (!isThinned()) return made;
  for (std::size_t s = 0; s < made.sources.size(); ++s) {
    PhotonSource& source = made.sources[s];
    const std::uint32_t octaves =
        s < stored_.size()
            ? stored_[s].octaves
            : thinningOctaves(options_.thinning,
                              placeOfSource(source, transport_.lights(), scene_.compiled()), 0);
    source.count = thinnable(source.count) >> octaves;
  }
  return made;
}

/// Returns whether photons are thinned. Caustics are not, as they are sharp however far their lamp is.
bool LivePhotons::isThinned() const {
  return options_.thinning.beyond > 0.0 && options_.request.kind != PhotonKind::Caustic;
}

std::uint32_t LivePhotons::wantedOctaves(std::size_t source) const {
  if (!isThinned()) return 0;
  return thinningOctaves(options_.thinning, stored_[source].place, stored_[source].octaves);
}

/// Replaces the sources. Stored paths remain until the new photons replace them.
void LivePhotons::adoptSources(PhotonSources sources) {
  sources_ = std::move(sources);
  shining_ = shiningLights(scene_.compiled().lights);
  for (std::size_t s = sources_.sources.size(); s < stored_.size(); ++s)
    for (const Path& path : stored_[s].paths)
      gone_.insert(gone_.end(), path.photons.begin(), path.photons.end());
  const std::size_t known = stored_.size();
  stored_.resize(sources_.sources.size());
  for (std::size_t s = 0; s < stored_.size(); ++s) {
    Source& stored = stored_[s];
    const PhotonSource& source = sources_.sources[s];
    stored.place = placeOfSource(source, transport_.lights(), scene_.compiled());
    if (s >= known) stored.octaves = wantedOctaves(s);
    makeGroups(s);
    stored.paths.resize(std::max<std::size_t>(stored.paths.size(), source.count));
    stored.waits.resize(stored.paths.size(), 0);
    stored.sentAt.resize(stored.paths.size(), frame_);
  }
}

void LivePhotons::makeGroups(std::size_t source) {
  if (options_.groupSize == 0) return;
  Source& stored = stored_[source];
  stored.groups = makePhotonGroups(sources_.sources[source], sources_.cells, options_.groupSize);
  stored.groupOf.resize(sources_.sources[source].count);
  for (std::size_t i = 0; i < stored.groups.photons.size(); ++i)
    stored.groupOf[stored.groups.photons[i]] = static_cast<std::uint32_t>(i / options_.groupSize);
}

/// Returns whether a source emits the same photons as before, apart from their power.
bool LivePhotons::sameSource(const PhotonSources& other, std::size_t index) const {
  const PhotonSource &a = sources_.sources[index], &b = other.sources[index];
  if (a.kind != b.kind || a.light != b.light) return false;
  if (fromAfar(a, transport_.lights()) &&
      (sources_.centre != other.centre || sources_.radius != other.radius))
    return false;
  if (options_.request.kind != PhotonKind::Caustic) return true;
  const auto mine = cellsOf(sources_, a), its = cellsOf(other, b);
  return a.count == b.count && a.cellsASide == b.cellsASide &&
         std::memcmp(a.tangent, b.tangent, sizeof a.tangent) == 0 && sameBytes(mine, its);
}

bool LivePhotons::concerns(const PhotonSource& source, const SceneChange& change) const {
  if (source.kind != PRELIGHT_SOURCE_PUNCTUAL) return change.sky && source.kind == PRELIGHT_SOURCE_SKY;
  return std::binary_search(change.lights.begin(), change.lights.end(), shining_[source.light]);
}

void LivePhotons::restart() {
  for (Source& stored : stored_) std::fill(stored.waits.begin(), stored.waits.end(), std::uint8_t{1});
}

void LivePhotons::changed(const SceneChange& change) {
  quiet_ = 0;
  PhotonSources sources = makeSources();
  if (sources.sources.size() != sources_.sources.size() ||
      shiningLights(scene_.compiled().lights) != shining_) {
    adoptSources(std::move(sources));
    return restart();
  }
  std::vector<std::uint8_t> anew;
  bool otherwise = false;
  for (std::size_t s = 0; s < stored_.size(); ++s) {
    const bool same = sameSource(sources, s);
    otherwise = otherwise || !same;
    anew.push_back(!same || concerns(sources_.sources[s], change) ? 1 : 0);
  }
  for (std::size_t s = 0; s < stored_.size(); ++s)
    stored_[s].place = placeOfSource(sources_.sources[s], transport_.lights(), scene_.compiled());
  if (otherwise) {
    for (std::size_t s = 0; s < stored_.size(); ++s)
      if (sources.sources[s].count != sources_.sources[s].count) anew[s] = 1;
    adoptSources(std::move(sources));
  }
  for (std::size_t s = 0; s < stored_.size(); ++s)
    if (anew[s] != 0) std::fill(stored_[s].waits.begin(), stored_[s].waits.end(), std::uint8_t{1});
  if (options_.detection == ChangeDetection::Flights) markFlights(change);
}

/// Marks photons whose flights met moved triangles or would now meet them.
void LivePhotons::markFlights(const SceneChange& change) {
  if (change.triangles.empty()) return;
  std::vector<std::uint8_t> moved(scene_.compiled().triangleCount() + 1, 0);
  for (const std::uint32_t t : change.triangles) moved[t] = 1;
  const auto hasMoved = [&](std::uint32_t t) {
    return moved[std::min<std::size_t>(t, moved.size() - 1)] != 0;
  };
  const std::vector<Box> boxes = boxesAround(scene_.compiled(), change.triangles);
  for (Source& stored : stored_) {
    std::vector<std::vector<device::Ray>> doubtful((stored.paths.size() + grain - 1) / grain);
    std::vector<std::vector<std::uint32_t>> doubtfulPaths(doubtful.size());
    parallelRanges(stored.paths.size(), grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (stored.waits[i] != 0) continue;
        for (const PhotonFlight& f : stored.paths[i].flights) {
          if (hasMoved(f.triangle) || hasMoved(f.ray.sourceTriangle)) {
            stored.waits[i] = 1;
            break;
          }
          if (std::none_of(boxes.begin(), boxes.end(), [&](const Box& b) { return mayMeet(f.ray, b); }))
            continue;
          doubtful[begin / grain].push_back(f.ray);
          doubtfulPaths[begin / grain].push_back(static_cast<std::uint32_t>(i));
        }
      }
    });
    std::vector<device::Ray> rays;
    std::vector<std::uint32_t> paths;
    for (std::size_t r = 0; r < doubtful.size(); ++r) {
      rays.insert(rays.end(), doubtful[r].begin(), doubtful[r].end());
      paths.insert(paths.end(), doubtfulPaths[r].begin(), doubtfulPaths[r].end());
    }
    if (rays.empty()) continue;
    const std::vector<device::Hit> hits = transport_.tracer().traceSeparated(rays);
    for (std::size_t i = 0; i < hits.size(); ++i)
      if (hasMoved(hits[i].triangle)) stored.waits[paths[i]] = 1;
  }
}

/// Returns the number of photons of each source that this frame sends again: all that wait, or a share of the
/// budget.
std::vector<std::uint64_t> LivePhotons::shareBudget() const {
  std::vector<std::uint64_t> shares;
  std::uint64_t all = 0;
  for (const Source& stored : stored_) {
    shares.push_back(static_cast<std::uint64_t>(std::count(stored.waits.begin(), stored.waits.end(), 1)));
    all += shares.back();
  }
  if (options_.frames > 0) {
    for (std::size_t s = 0; s < shares.size(); ++s)
      shares[s] = (stored_[s].paths.size() + options_.frames - 1) / options_.frames;
    return shares;
  }
  const std::uint64_t budget = options_.photonsPerFrame;
  if (budget == 0 || all <= budget) return shares;
  std::uint64_t before = 0;  // rounded so that the shares sum to the budget
  for (std::uint64_t& share : shares) {
    const std::uint64_t first = budget * before / all;
    before += share;
    share = budget * before / all - first;
  }
  return shares;
}

/// Returns waiting photons of a source, at most `budget`. Those sent longest ago come first, so that none
/// waits longer than a full round, however often all of them change. Ties are taken in sweeps through their
/// numbers, so that the photons sent so far are spread evenly over the light's emission.
std::vector<std::uint32_t> LivePhotons::takeWaiting(std::size_t source, std::uint64_t budget) {
  Source& stored = stored_[source];
  std::vector<std::uint32_t> taken;
  for (std::size_t sweep = 0; sweep < strides; ++sweep)
    for (std::size_t i = sweep; i < stored.waits.size(); i += strides)
      if (stored.waits[i] != 0) taken.push_back(static_cast<std::uint32_t>(i));
  if (taken.size() > budget) {
    std::stable_sort(taken.begin(), taken.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return stored.sentAt[a] < stored.sentAt[b]; });
    taken.resize(budget);
  }
  for (const std::uint32_t i : taken) {
    stored.waits[i] = 0;
    stored.sentAt[i] = frame_;
  }
  std::sort(taken.begin(), taken.end());
  return taken;
}

/// Replaces a path. Returns whether it differs from the old one.
bool LivePhotons::replace(Path& old, Path path, PhotonDelta& delta) {
  if (sameBytes<PhotonFlight>(old.flights, path.flights) && sameBytes<Photon>(old.photons, path.photons))
    return false;
  delta.removed.insert(delta.removed.end(), old.photons.begin(), old.photons.end());
  delta.added.insert(delta.added.end(), path.photons.begin(), path.photons.end());
  old = std::move(path);
  return true;
}

/// Sends photons again. Returns those whose first flight has changed.
std::vector<std::uint32_t> LivePhotons::send(std::size_t source, std::span<const std::uint32_t> photons,
                                             PhotonDelta& delta, PhotonFrame& frame, Progress& progress) {
  Source& stored = stored_[source];
  const std::uint32_t count = sources_.sources[source].count;
  const auto still = std::lower_bound(photons.begin(), photons.end(), count);
  for (auto gone = still; gone != photons.end(); ++gone) replace(stored.paths[*gone], {}, delta);
  const std::span<const std::uint32_t> chosen(photons.begin(), still);
  std::vector<std::uint32_t> elsewhere;
  if (chosen.empty()) return elsewhere;
  PhotonHits hits;
  const PhotonReport report = tracer_.trace(options_.request, sources_, source, chosen, hits, progress);
  std::vector<Path> paths(chosen.size());
  for (std::size_t i = 0; i < hits.flights.size(); ++i)
    paths[hits.flightPaths[i]].flights.push_back(hits.flights[i]);
  for (std::size_t i = 0; i < hits.photons.size(); ++i)
    paths[hits.paths[i]].photons.push_back(hits.photons[i]);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    Path& old = stored.paths[chosen[i]];
    const bool sameStart = !old.flights.empty() && !paths[i].flights.empty() &&
                           sameBytes<PhotonFlight>({old.flights.data(), 1}, {paths[i].flights.data(), 1});
    if (!replace(old, std::move(paths[i]), delta)) continue;
    ++frame.changed;
    if (!sameStart) elsewhere.push_back(chosen[i]);
  }
  frame.traced += chosen.size();
  frame.rays += report.rays;
  return elsewhere;
}

/// Sends one member of each group. If its first flight has changed, the others wait.
void LivePhotons::probe(PhotonDelta& delta, PhotonFrame& frame, Progress& progress) {
  const std::uint64_t before = frame.changed;
  for (std::size_t s = 0; s < stored_.size(); ++s) {
    Source& stored = stored_[s];
    std::vector<std::uint32_t> probes;
    for (std::uint32_t g = 0; g < stored.groups.count(); ++g) {
      const auto group = stored.groups.group(g);
      probes.push_back(group[turn_ % group.size()]);
    }
    std::sort(probes.begin(), probes.end());
    for (const std::uint32_t photon : probes) stored.waits[photon] = 0;
    frame.probes += probes.size();
    for (const std::uint32_t photon : send(s, probes, delta, frame, progress))
      for (const std::uint32_t other : stored.groups.group(stored.groupOf[photon]))
        if (other != photon) stored.waits[other] = 1;
  }
  turn_ = (turn_ + 1) % options_.groupSize;
  quiet_ = frame.changed > before ? 0 : quiet_ + 1;
}

/// Sets the number of a source's photons, which share its power. New photons have no path yet. Paths do not
/// depend on the power that they carry, and scaling by powers of two is exact.
void LivePhotons::setCount(std::size_t source, std::uint32_t count, PhotonDelta& delta) {
  Source& stored = stored_[source];
  const std::uint32_t before = std::exchange(sources_.sources[source].count, count);
  const float scale = static_cast<float>(before) / static_cast<float>(count);
  for (std::size_t i = count; i < before; ++i) replace(stored.paths[i], {}, delta);
  stored.paths.resize(count);
  stored.waits.resize(count, 0);
  stored.sentAt.resize(count, frame_);
  makeGroups(source);
  for (Path& path : stored.paths) {
    delta.removed.insert(delta.removed.end(), path.photons.begin(), path.photons.end());
    for (Photon& photon : path.photons)
      for (float& power : photon.power) power *= scale;
    delta.added.insert(delta.added.end(), path.photons.begin(), path.photons.end());
  }
}

/// Moves one step towards the photon numbers for the eye. Sources that still replace the paths of a former
/// source are skipped.
void LivePhotons::thin(PhotonDelta& delta, PhotonFrame& frame, Progress& progress) {
  for (std::size_t s = 0; s < stored_.size(); ++s) {
    const std::uint32_t count = sources_.sources[s].count, wanted = wantedOctaves(s);
    if (wanted == stored_[s].octaves || stored_[s].paths.size() != count) continue;
    const bool grows = wanted < stored_[s].octaves;
    stored_[s].octaves += grows ? -1 : 1;
    setCount(s, grows ? 2 * count : count / 2, delta);
    std::vector<std::uint32_t> added(grows ? count : 0);
    std::iota(added.begin(), added.end(), count);
    send(s, added, delta, frame, progress);
  }
}

PhotonFrame LivePhotons::advance(PhotonDelta& delta, Progress& progress) {
  PhotonFrame frame;
  if (settled()) return frame;
  ++frame_;
  thin(delta, frame, progress);
  delta.removed.insert(delta.removed.end(), gone_.begin(), gone_.end());
  gone_.clear();
  if (options_.detection == ChangeDetection::Probes) probe(delta, frame, progress);
  const std::vector<std::uint64_t> shares = shareBudget();
  for (std::size_t s = 0; s < stored_.size(); ++s) {
    const std::vector<std::uint32_t> waiting = takeWaiting(s, shares[s]);
    std::vector<std::uint8_t> groups(stored_[s].groups.count(), 0);
    for (const std::uint32_t photon : waiting)
      if (photon < stored_[s].groupOf.size()) groups[stored_[s].groupOf[photon]] = 1;
    frame.groups += static_cast<std::uint64_t>(std::count(groups.begin(), groups.end(), 1));
    send(s, waiting, delta, frame, progress);
    const bool waits =
        std::find(stored_[s].waits.begin(), stored_[s].waits.end(), 1) != stored_[s].waits.end();
    if (!waits) {
      stored_[s].paths.resize(sources_.sources[s].count);
      stored_[s].waits.resize(sources_.sources[s].count);
      stored_[s].sentAt.resize(sources_.sources[s].count);
    }
  }
  return frame;
}

bool LivePhotons::settled() const {
  if (!gone_.empty()) return false;
  for (std::size_t s = 0; s < stored_.size(); ++s) {
    const std::vector<std::uint8_t>& waits = stored_[s].waits;
    if (wantedOctaves(s) != stored_[s].octaves || std::find(waits.begin(), waits.end(), 1) != waits.end())
      return false;
  }
  return options_.detection == ChangeDetection::Flights || quiet_ >= options_.groupSize;
}

std::vector<Photon> LivePhotons::photons() const {
  std::size_t count = 0;
  for (const Source& stored : stored_)
    for (const Path& path : stored.paths) count += path.photons.size();
  std::vector<Photon> all;
  all.reserve(count);
  for (const Source& stored : stored_)
    for (const Path& path : stored.paths) all.insert(all.end(), path.photons.begin(), path.photons.end());
  return all;
}

std::vector<std::uint32_t> LivePhotons::groupsOfPhotons() const {
  std::vector<std::uint32_t> groups;
  std::uint32_t first = 0;
  for (const Source& stored : stored_) {
    for (std::size_t i = 0; i < stored.paths.size(); ++i)
      groups.insert(groups.end(), stored.paths[i].photons.size(),
                    i < stored.groupOf.size() ? first + stored.groupOf[i] : noGroup);
    first += stored.groups.count();
  }
  return groups;
}

std::uint64_t LivePhotons::pathCount() const {
  std::uint64_t count = 0;
  for (const Source& stored : stored_) count += stored.paths.size();
  return count;
}

std::uint64_t LivePhotons::groupCount() const {
  std::uint64_t count = 0;
  for (const Source& stored : stored_) count += stored.groups.count();
  return count;
}

}  // namespace prelight
