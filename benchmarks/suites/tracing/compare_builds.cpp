#include "benchmarks/suites/tracing/compare_builds.h"

#include <functional>

#include "benchmarks/run/measure.h"
#include "benchmarks/run/take_turns.h"
#include "benchmarks/suites/tracing/compare_rays.h"
#include "bvh/builder.h"
#include "bvh/bvh_report.h"
#include "bvh/layouts.h"

namespace prelight::benchmarks {

namespace {

const char* qualityName(PeerQuality quality) {
  if (quality == PeerQuality::Low) return "Embree (low)";
  return quality == PeerQuality::Medium ? "Embree (medium)" : "Embree (high)";
}

/// Prelight's quality of about the same effort.
BuildQuality ownQuality(PeerQuality quality) {
  if (quality == PeerQuality::Low) return BuildQuality::Fast;
  return quality == PeerQuality::Medium ? BuildQuality::Balanced : BuildQuality::High;
}

const char* ownName(PeerQuality quality) {
  if (quality == PeerQuality::Low) return "fast";
  return quality == PeerQuality::Medium ? "balanced" : "high";
}

/// A way to build, Prelight's or the peer's, and what came of it.
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

/// The layout that the device is given, as Tracer chooses it.
BvhTarget targetOf(const Device& device) {
  return device.info().kind == DeviceKind::Cpu ? BvhTarget::Wide : BvhTarget::Narrow;
}

/// Bytes of the layout.
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

  /// Adds the numbers of Prelight's tree, beside those of the peer's at about the same effort where there is
  /// one.
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

}  // namespace

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

}  // namespace prelight::benchmarks
