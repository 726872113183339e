#include "benchmarks/suites/tracing/compare_rays.h"

#include <algorithm>
#include <cmath>

namespace prelight::benchmarks {

namespace {

using device::Hit;
using device::Ray;

constexpr std::size_t launchesPerPart = 2;
constexpr int packetEvery = 3;  // rounds: packets only complete the picture

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

/// The measurement of one case: Prelight first, then the peer ray by ray, a tree each, then packets.
class Comparison {
 public:
  Comparison(const RayCase& rays, Tracer& tracer, const std::vector<PeerTree>& trees,
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

  /// Share of rays that the last tree of the peer answers differently.
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

  /// Rays that the parts hold, a second.
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

}  // namespace

std::vector<PeerTree> makePeerTrees(const CompiledScene& scene, const std::vector<PeerQuality>& qualities,
                                    const DeviceInfo& device) {
  const std::size_t threads = peerThreads(device);
  std::vector<PeerTree> trees;
  for (const PeerQuality quality : qualities)
    if (std::unique_ptr<RayPeer> peer = makeEmbreePeer(scene, quality, threads))
      trees.push_back({quality, std::move(peer)});
  return trees;
}

void compareRays(const RayCase& rays, const CompiledScene& scene, Tracer& tracer,
                 const std::vector<PeerTree>& trees, const RayComparison& how, const Progress& progress,
                 std::vector<BenchmarkResult>& results) {
  Comparison comparison(rays, tracer, trees, how);
  comparison.run(how.rounds, progress);
  comparison.report(results);
  if (trees.empty()) return;
  const double scale = 0.01 * glm::length(glm::dvec3(scene.boundsMax - scene.boundsMin));
  results.push_back({rays.name, "disagreement", comparison.disagreementWithPeer(scale), "of rays", {}, {}});
}

}  // namespace prelight::benchmarks
