#include "benchmarks/compare_builds.h"

#include <algorithm>
#include <functional>

#include "benchmarks/compare_rays.h"
#include "benchmarks/measure.h"
#include "benchmarks/take_turns.h"
#include "bvh/builder.h"
#include "bvh/layouts.h"

namespace prelight::benchmarks {

namespace {

const char* qualityName(PeerQuality quality) {
  if (quality == PeerQuality::Low) return "Embree (low)";
  return quality == PeerQuality::Medium ? "Embree (medium)" : "Embree (high)";
}

/// What random lines through the bounds meet of a tree (MacDonald and Booth 1990): the sum of surfaces over
/// that of the root.
struct SahCounts {
  double nodes = 0.0;
  double leaves = 0.0;  ///< blocks of triangles
};

SahCounts sahCounts(const BinaryBvh& tree) {
  SahCounts counts;
  std::vector<std::uint32_t> open = {0};
  while (!open.empty()) {
    const BinaryBvh::Node& node = tree.nodes[open.back()];
    open.pop_back();
    const std::uint32_t blocks = (node.count + BinaryBvh::maxLeafSize - 1) / BinaryBvh::maxLeafSize;
    (node.count > 0 ? counts.leaves : counts.nodes) +=
        static_cast<double>(node.bounds.halfArea()) * std::max(1u, blocks);
    if (node.count == 0) open.insert(open.end(), {node.left, node.right});
  }
  const auto root = static_cast<double>(tree.nodes[0].bounds.halfArea());
  return {counts.nodes / root, counts.leaves / root};
}

/// A way to build, Prelight's or the peer's, and what came of it.
struct BuildRecord {
  std::string name;
  PeerQuality quality = PeerQuality::Medium;  ///< Prelight's: of the peer at about the same effort
  std::vector<double> seconds = {};           ///< [round]
  double bytes = 0.0;
};

template <typename T>
double bytesOf(const std::vector<T>& data) {
  return static_cast<double>(data.size() * sizeof(T));
}

/// Bytes of the layout that a tree is given to the device in.
double layOut(const BinaryBvh& tree, const CompiledScene& scene, const Device& device) {
  if (device.info().kind == DeviceKind::Cpu) {  // as Tracer chooses
    const WideBvh wide = makeWideBvh(tree, scene);
    return bytesOf(wide.nodes) + bytesOf(wide.blocks);
  }
  const NarrowBvh narrow = makeNarrowBvh(tree, scene);
  return bytesOf(narrow.nodes) + bytesOf(narrow.triangles);
}

BinaryBvh buildOnce(BuildRecord& record, const CompiledScene& scene, const Device& device) {
  BinaryBvh tree;
  record.seconds.push_back(secondsOf([&] {
    const bool cpu = device.info().kind == DeviceKind::Cpu;  // as Tracer chooses
    tree = buildBvh(scene,
                    {.quality = BuildQuality::Balanced, .target = cpu ? BvhTarget::Wide : BvhTarget::Narrow});
    record.bytes = layOut(tree, scene, device);
  }));
  return tree;
}

void buildPeers(std::vector<BuildRecord>& peers, const CompiledScene& scene, const Device& device) {
  for (BuildRecord& record : peers)
    for (const PeerTree& tree : makePeerTrees(scene, {record.quality}, device.info())) {
      record.seconds.push_back(tree.peer->buildSeconds());
      record.bytes = static_cast<double>(tree.peer->bytes());
    }
}

class BuildReport {
 public:
  BuildReport(std::string suite, std::string size, std::uint32_t triangles,
              std::vector<BenchmarkResult>& results)
      : suite_(std::move(suite)), size_(std::move(size)), triangles_(triangles), results_(results) {}

  void addTree(const BuildRecord& own, const BinaryBvh& tree) {
    const SahCounts sah = sahCounts(tree);
    add(own, "depth", tree.depth, "levels");
    add(own, "SAH nodes", sah.nodes, "a line");
    add(own, "SAH leaves", sah.leaves, "a line");
  }

  void addComparison(const BuildRecord& own, const std::vector<BuildRecord>& peers) {
    const auto equal = std::find_if(peers.begin(), peers.end(),
                                    [&](const BuildRecord& peer) { return peer.quality == own.quality; });
    const BuildRecord* peer = equal != peers.end() && !equal->seconds.empty() ? &*equal : nullptr;
    add(own, "build", median(own.seconds), "s", peer,
        [&] { return medianRatio(own.seconds, peer->seconds); });
    add(own, "size", own.bytes / triangles_, "bytes/triangle", peer, [&] { return peer->bytes / own.bytes; });
    for (const BuildRecord& other : peers) {
      if (other.seconds.empty()) continue;
      add(own, "peer build", median(other.seconds), "s", &other,
          [&] { return medianRatio(own.seconds, other.seconds); });
      add(own, "peer size", other.bytes / triangles_, "bytes/triangle", &other,
          [&] { return other.bytes / own.bytes; });
    }
  }

 private:
  void add(const BuildRecord& own, const char* metric, double value, const char* unit,
           const BuildRecord* peer = nullptr, const std::function<double()>& ratio = {}) {
    BenchmarkResult result{suite_, own.name + " " + size_, metric, value, unit, {}, {}};
    if (peer != nullptr) {
      result.peer = peer->name;
      result.ratio = ratio();
    }
    results_.push_back(std::move(result));
  }

  std::string suite_, size_;
  std::uint32_t triangles_;
  std::vector<BenchmarkResult>& results_;
};

}  // namespace

void compareBuilds(const std::string& suite, const std::string& size, const CompiledScene& scene,
                   const Device& device, const std::vector<PeerQuality>& qualities, int rounds,
                   const Progress& progress, std::vector<BenchmarkResult>& results) {
  BuildReport report(suite, size, scene.triangleCount(), results);
  BuildRecord own{"build", PeerQuality::Medium};
  std::vector<BuildRecord> peers;
  for (const PeerQuality quality : qualities) peers.push_back({qualityName(quality), quality});
  for (int round = 0; round < rounds; ++round) {
    progress.check();
    const BinaryBvh tree = buildOnce(own, scene, device);
    if (round == 0) report.addTree(own, tree);
    buildPeers(peers, scene, device);
  }
  report.addComparison(own, peers);
}

}  // namespace prelight::benchmarks
