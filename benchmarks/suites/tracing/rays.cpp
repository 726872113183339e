#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "benchmarks/peers/embree/ray_peer.h"
#include "benchmarks/run/measure.h"
#include "benchmarks/run/timing.h"
#include "benchmarks/scenes/detailed_scene.h"
#include "benchmarks/suites/tracing/ray_sets.h"
#include "benchmarks/suites/tracing/tracing_suite.h"
#include "bvh/builder.h"
#include "bvh/bvh_report.h"
#include "bvh/layouts.h"

namespace prelight::benchmarks {

namespace {

/// A peer's tree and its quality.
struct PeerTree {
  PeerQuality quality = PeerQuality::Medium;
  std::unique_ptr<RayPeer> peer;
};

/// One kind of rays with one kind of query.
struct RayCase {
  std::string name;
  std::vector<device::Ray> rays;
  bool any = false;
};

struct RayComparison {
  int rounds = 1;
  bool packets = false;  ///< also give the peer packets of rays
};

using device::Hit;
using device::Ray;

constexpr std::size_t launchesPerPart = 2;
constexpr int packetEvery = 3;  // rounds between those with packets, which are measured less often

bool agree(const Hit& a, const Hit& b, bool any, double scale) {
  const bool missA = a.triangle == PRELIGHT_NO_TRIANGLE, missB = b.triangle == PRELIGHT_NO_TRIANGLE;
  if (missA || missB || any) return missA == missB;
  return std::abs(double(a.t) - double(b.t)) <= 1e-4 * std::max(double(a.t), scale);
}

double disagreement(const std::vector<Hit>& a, const std::vector<Hit>& b, bool any, double scale) {
  std::size_t differ = 0;
  for (std::size_t i = 0; i < a.size(); ++i) differ += agree(a[i], b[i], any, scale) ? 0 : 1;
  return static_cast<double>(differ) / static_cast<double>(a.size());
}

/// The measurement of one case: Prelight, then the peer ray by ray with each of its trees, then packets.
class RayContest {
 public:
  RayContest(const RayCase& rays, Tracer& tracer, const std::vector<PeerTree>& trees,
             const RayComparison& how)
      : case_(rays), tracer_(tracer), trees_(trees), blocks_(tracer.context(), rays.rays) {
    perPart_ = std::min(launchesPerPart, blocks_.launchCount());
    parts_ = std::min<std::size_t>((blocks_.launchCount() + perPart_ - 1) / perPart_,
                                   static_cast<std::size_t>(how.rounds));
    contenders_.push_back({"Prelight", [this](std::size_t part) {
                             const std::size_t end = std::min((part + 1) * perPart_, blocks_.launchCount());
                             blocks_.trace(tracer_, case_.any, part * perPart_, end);
                           }});
    for (const PeerTree& tree : trees_) addPeer(tree, {case_.any, 1, false}, 1);
    if (how.packets && how.rounds >= packetEvery * static_cast<int>(parts_) && !trees_.empty())
      for (const int width : {8, 16})
        for (const bool coherent : {false, true})
          addPeer(trees_.back(), {case_.any, width, coherent}, packetEvery);
  }

  void run(int rounds, const Progress& progress) { takeTurns(contenders_, parts_, rounds, progress); }

  void report(std::vector<BenchmarkResult>& results) const {
    const Contender& own = contenders_[0];
    const Contender* peer = trees_.empty() ? nullptr : &fastestSingle();
    const auto add = [&](const char* metric, const char* unit, double seconds, auto ratio) {
      BenchmarkResult result{case_.name, metric, rate(seconds), unit, {}, {}};
      if (peer != nullptr) {
        result.peer = peer->name;
        result.ratio = ratio();
      }
      results.push_back(result);
    };
    add("throughput", "rays/s", medianSeconds(own.seconds, parts_),
        [&] { return medianRatio(own.seconds, peer->seconds); });
    add("best throughput", "rays/s", leastSeconds(own.seconds, parts_),
        [&] { return leastSeconds(peer->seconds, parts_) / leastSeconds(own.seconds, parts_); });
    if (tracer_.context().info().kind == DeviceKind::Cpu)
      add("cpu throughput", "rays/cpu s", medianSeconds(own.cpuSeconds, parts_),
          [&] { return medianRatio(own.cpuSeconds, peer->cpuSeconds); });
    for (std::size_t i = 1; i < contenders_.size(); ++i)
      results.push_back({case_.name, "peer throughput", rate(medianSeconds(contenders_[i].seconds, parts_)),
                         "rays/s", contenders_[i].name, medianRatio(own.seconds, contenders_[i].seconds)});
  }

  /// Returns the share of rays for which the peer's last tree has another hit.
  double disagreementWithPeer(double scale) {
    std::vector<Hit> peerHits(case_.rays.size());
    trees_.back().peer->trace(case_.rays, peerHits, {case_.any, 1, false});
    return disagreement(blocks_.hits(tracer_, case_.any), peerHits, case_.any, scale);
  }

 private:
  void addPeer(const PeerTree& tree, const PeerQuery& query, int every) {
    RayPeer* peer = tree.peer.get();
    const auto run = [this, peer, query](std::size_t part) {
      const std::size_t launch = std::min(case_.rays.size(), raysPerLaunch(tracer_.context().info()));
      const std::size_t begin = part * perPart_ * launch;
      const std::size_t count = std::min(perPart_ * launch, case_.rays.size() - begin);
      peerHits_.resize(perPart_ * launch);
      peer->trace(std::span(case_.rays).subspan(begin, count), std::span(peerHits_).first(count), query);
    };
    contenders_.push_back({embreeName(query, tree.quality), run, every});
  }

  const Contender& fastestSingle() const {
    return *std::min_element(contenders_.begin() + 1,
                             contenders_.begin() + 1 + static_cast<std::ptrdiff_t>(trees_.size()),
                             [&](const Contender& a, const Contender& b) {
                               return leastSeconds(a.seconds, parts_) < leastSeconds(b.seconds, parts_);
                             });
  }

  /// Returns rays per second, given the seconds of all parts.
  double rate(double seconds) const {
    const std::size_t launch = std::min(case_.rays.size(), raysPerLaunch(tracer_.context().info()));
    return static_cast<double>(std::min(case_.rays.size(), parts_ * perPart_ * launch)) / seconds;
  }

  const RayCase& case_;
  Tracer& tracer_;
  const std::vector<PeerTree>& trees_;
  RayBlocks blocks_;
  std::vector<Hit> peerHits_;
  std::size_t perPart_ = 1;
  std::size_t parts_ = 1;
  std::vector<Contender> contenders_;
};

/// Returns the peer's trees of some qualities over a scene, with peerThreads(); empty in a build without the
/// peer.
std::vector<PeerTree> makePeerTrees(const CompiledScene& scene, const std::vector<PeerQuality>& qualities,
                                    const DeviceInfo& device) {
  const std::size_t threads = peerThreads(device);
  std::vector<PeerTree> trees;
  for (const PeerQuality quality : qualities)
    if (std::unique_ptr<RayPeer> peer = makeEmbreePeer(scene, quality, threads))
      trees.push_back({quality, std::move(peer)});
  return trees;
}

/// Traces the rays of a case in turns with Prelight and the peer, and compares their hits. Results:
/// - "throughput" (medians) and "best throughput" (the fastest rounds) of Prelight, compared with the faster
///   of the peer's trees for single rays;
/// - on a CPU, "cpu throughput": rays per second of processor time, which other programs hardly disturb;
/// - "peer throughput" of every way to give rays to the peer, with Prelight's ratio to it;
/// - "disagreement": the share of rays whose hits differ: one misses, or distances differ by more than 1e-4
///   of the larger of the distance and a hundredth of the scene's diagonal.
void compareRays(const RayCase& rays, const CompiledScene& scene, Tracer& tracer,
                 const std::vector<PeerTree>& trees, const RayComparison& how, const Progress& progress,
                 std::vector<BenchmarkResult>& results) {
  RayContest comparison(rays, tracer, trees, how);
  comparison.run(how.rounds, progress);
  comparison.report(results);
  if (trees.empty()) return;
  const double scale = 0.01 * glm::length(glm::dvec3(scene.boundsMax - scene.boundsMin));
  results.push_back({rays.name, "disagreement", comparison.disagreementWithPeer(scale), "of rays", {}, {}});
}

const char* qualityName(PeerQuality quality) {
  if (quality == PeerQuality::Low) return "Embree (low)";
  return quality == PeerQuality::Medium ? "Embree (medium)" : "Embree (high)";
}

/// Returns Prelight's quality of about the same effort.
BuildQuality ownQuality(PeerQuality quality) {
  if (quality == PeerQuality::Low) return BuildQuality::Fast;
  return quality == PeerQuality::Medium ? BuildQuality::Balanced : BuildQuality::High;
}

const char* ownName(PeerQuality quality) {
  if (quality == PeerQuality::Low) return "fast";
  return quality == PeerQuality::Medium ? "balanced" : "high";
}

/// A way to build a tree, Prelight's or the peer's, with seconds and bytes.
struct BuildRecord {
  std::string name;
  PeerQuality quality = PeerQuality::Medium;  ///< the effort, in the peer's terms
  std::vector<double> seconds = {};           ///< [round]
  double bytes = 0.0;
};

template <typename T>
double bytesOf(const std::vector<T>& data) {
  return static_cast<double>(data.size() * sizeof(T));
}

/// Returns the layout that Tracer chooses for a device.
BvhTarget targetOf(const Device& device) {
  return device.info().kind == DeviceKind::Cpu ? BvhTarget::Wide : BvhTarget::Narrow;
}

/// Returns the bytes of the layout.
double layOut(const BinaryBvh& tree, const CompiledScene& scene, BvhTarget target) {
  if (target == BvhTarget::Wide) {
    const WideBvh wide = makeWideBvh(tree, scene);
    return bytesOf(wide.nodes) + bytesOf(wide.blocks);
  }
  const NarrowBvh narrow = makeNarrowBvh(tree, scene);
  return bytesOf(narrow.nodes) + bytesOf(narrow.triangles);
}

BvhReport buildOnce(BuildRecord& record, const CompiledScene& scene, BvhTarget target) {
  BinaryBvh tree;
  record.seconds.push_back(secondsOf([&] {
    tree = buildBvh(scene, {.quality = ownQuality(record.quality), .target = target});
    record.bytes = layOut(tree, scene, target);
  }));
  return reportOf(tree, scene.triangleCount(), target);
}

void buildPeer(BuildRecord& record, const CompiledScene& scene, const Device& device) {
  for (const PeerTree& tree : makePeerTrees(scene, {record.quality}, device.info())) {
    record.seconds.push_back(tree.peer->buildSeconds());
    record.bytes = static_cast<double>(tree.peer->bytes());
  }
}

class BuildReport {
 public:
  BuildReport(std::string size, std::uint32_t triangles, std::vector<BenchmarkResult>& results)
      : size_(std::move(size)), triangles_(triangles), results_(results) {}

  void addTree(const BuildRecord& own, const BvhReport& tree) {
    add(own, "SAH cost", tree.sahCost, "a line");
    add(own, "depth", tree.depth, "levels");
    add(own, "leaf fill", tree.meanLeafFill, "of eight");
    add(own, "duplicates", tree.duplicates, "of triangles");
  }

  /// Adds seconds and bytes of Prelight's tree, compared with the peer's of about the same effort, if there
  /// is one.
  void addComparison(const BuildRecord& own, const BuildRecord& peer) {
    const BuildRecord* other = peer.seconds.empty() ? nullptr : &peer;
    add(own, "build", median(own.seconds), "s", other,
        [&] { return medianRatio(own.seconds, peer.seconds); });
    add(own, "size", own.bytes / triangles_, "bytes/triangle", other, [&] { return peer.bytes / own.bytes; });
  }

 private:
  void add(const BuildRecord& own, const char* metric, double value, const char* unit,
           const BuildRecord* peer = nullptr, const std::function<double()>& ratio = {}) {
    BenchmarkResult result{own.name + " " + size_, metric, value, unit, {}, {}};
    if (peer != nullptr) {
      result.peer = peer->name;
      result.ratio = ratio();
    }
    results_.push_back(std::move(result));
  }

  std::string size_;
  std::uint32_t triangles_;
  std::vector<BenchmarkResult>& results_;
};

/// Builds the trees of a scene `rounds` times in turns with Prelight and the peer, at each of `qualities`.
/// Results, with one case per quality of Prelight, compared with the peer's of about the same effort:
/// - "build": median seconds from triangles to the layout of the device, without the upload;
/// - "size": bytes per triangle of nodes and leaves, which include the vertices;
/// and from BvhReport, for Prelight's tree alone: "SAH cost", "depth", "leaf fill", "duplicates".
void compareBuilds(const std::string& size, const CompiledScene& scene, const Device& device,
                   const std::vector<PeerQuality>& qualities, int rounds, const Progress& progress,
                   std::vector<BenchmarkResult>& results) {
  BuildReport report(size, scene.triangleCount(), results);
  std::vector<BuildRecord> owns, peers;
  for (const PeerQuality quality : qualities) {
    owns.push_back({ownName(quality), quality});
    peers.push_back({qualityName(quality), quality});
  }
  std::vector<BvhReport> trees(owns.size());
  for (int round = 0; round < rounds; ++round)
    for (std::size_t q = 0; q < qualities.size(); ++q) {
      progress.check();
      trees[q] = buildOnce(owns[q], scene, targetOf(device));
      buildPeer(peers[q], scene, device);
    }
  for (std::size_t q = 0; q < qualities.size(); ++q) {
    report.addTree(owns[q], trees[q]);
    report.addComparison(owns[q], peers[q]);
  }
}

using device::Ray;

constexpr std::uint32_t raysRaysPerReceiver = 256;
constexpr float reach = 0.5f;  // length of limited rays, metres

/// A kind of rays. It is made when its turn comes, since all kinds together would not fit into small
/// memories.
struct Recipe {
  const char* name;
  bool any;
  std::function<std::vector<Ray>()> make;
};

std::vector<Recipe> recipes(const BenchmarkScene& scene, Tracer& tracer, std::uint64_t count) {
  const auto bake = [&scene, &tracer, count] {
    return bakeLaunches(scene.compiled, tracer.context(), count, raysRaysPerReceiver);
  };
  return {{"bake-order", false, bake},
          {"random", false, [bake] { return shuffled(bake()); }},
          {"bake-order-any", true, bake},
          {"random-any", true, [bake] { return shuffled(bake()); }},
          {"bake-order-near", true, [bake] { return limited(bake(), reach); }},
          {"photon", false, [&scene, &tracer, count] { return photonRays(scene, tracer, count); }},
          {"camera", false, [&scene, count] { return cameraRays(scene, count); }}};
}

}  // namespace

void runRays(const Device& device, const TracingOptions& options, SuiteRun& run) {
  constexpr std::size_t cases = 7;
  StepCounter steps(run, "bench rays", options.rayTriangles.size() * (cases + 1));
  std::vector<BenchmarkResult>& results = run.results();
  for (const std::uint64_t triangles : options.rayTriangles) {
    const BenchmarkScene scene = makeDetailedRooms(triangles);
    Tracer tracer(scene.compiled, device);
    const std::vector<PeerTree> trees =
        makePeerTrees(scene.compiled, {PeerQuality::Medium, PeerQuality::High}, device.info());
    steps.advance();
    for (const Recipe& recipe : recipes(scene, tracer, options.rayCount)) {
      const RayCase rays{std::string(recipe.name) + " " + scene.name, recipe.make(), recipe.any};
      compareRays(rays, scene.compiled, tracer, trees, {options.rayRounds, true}, run, results);
      steps.advance();
    }
  }
}

void runBuild(const Device& device, const TracingOptions& options, SuiteRun& run) {
  StepCounter steps(run, "bench build", options.rayTriangles.size());
  std::vector<BenchmarkResult>& results = run.results();
  for (const std::uint64_t triangles : options.rayTriangles) {
    const BenchmarkScene scene = makeDetailedRooms(triangles);
    compareBuilds(scene.name, scene.compiled, device,
                  {PeerQuality::Low, PeerQuality::Medium, PeerQuality::High}, options.runs, run, results);
    steps.advance();
  }
}

namespace {

constexpr std::uint32_t scalingRaysPerReceiver = 256;
constexpr std::uint64_t largeScene =
    2000000;  // triangles from which on a tree is built only once, as that takes seconds

/// Returns the peak memory of this process so far, bytes.
double peakMemory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

}  // namespace

void runScaling(const Device& device, const TracingOptions& options, SuiteRun& run) {
  constexpr std::size_t stepsPerScene = 3;
  StepCounter steps(run, "bench scaling", options.scalingTriangles.size() * stepsPerScene);
  std::vector<BenchmarkResult>& results = run.results();
  for (const std::uint64_t triangles : options.scalingTriangles) {
    const BenchmarkScene scene = makeDetailedRooms(triangles);
    const std::vector<PeerQuality> quality = {PeerQuality::Medium};
    compareBuilds(scene.name, scene.compiled, device, {PeerQuality::Medium, PeerQuality::High},
                  triangles < largeScene ? options.runs : 1, run, results);
    steps.advance();
    Tracer tracer(scene.compiled, device);
    const std::vector<PeerTree> trees = makePeerTrees(scene.compiled, quality, device.info());
    const RayComparison how{.rounds = options.rayRounds, .packets = false};
    RayCase rays{"bake-order " + scene.name,
                 bakeLaunches(scene.compiled, device.context(), options.rayCount, scalingRaysPerReceiver),
                 false};
    compareRays(rays, scene.compiled, tracer, trees, how, run, results);
    steps.advance();
    rays = {"random " + scene.name, shuffled(std::move(rays.rays)), false};
    compareRays(rays, scene.compiled, tracer, trees, how, run, results);
    results.push_back({scene.name, "peak memory", peakMemory(), "bytes", {}, {}});
    steps.advance();
  }
}

}  // namespace prelight::benchmarks
