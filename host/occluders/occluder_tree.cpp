#include "occluders/occluder_tree.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <queue>
#include <utility>

#include "plan/shadow_sets.h"
#include "scene/deform.h"

namespace prelight {

namespace {

/// The vertices of a tree node: a range of Splitter::order_.
struct Cluster {
  std::size_t first = 0;
  std::size_t end = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();  ///< relative to its first vertex, to avoid cancellation
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< times the area
};

/// Returns the unit principal axis. Its largest component is positive, so that the order of children does not
/// depend on the solver.
Eigen::Vector3d principalAxis(const Eigen::Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  const Eigen::Vector3d axis = solver.eigenvectors().col(2);  // eigenvalues ascend
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  return axis[largest] < 0.0 ? Eigen::Vector3d(-axis) : axis;
}

class Splitter {
 public:
  explicit Splitter(const CompiledScene& scene) : scene_(scene), areas_(positiveSurfaceOfVertices(scene)) {}

  void addRoot(const std::string& name, const std::vector<std::uint32_t>& vertices) {
    const std::size_t first = order_.size();
    order_.insert(order_.end(), vertices.begin(), vertices.end());
    addNode(name, -1, first, order_.size());
  }

  void splitUpTo(std::size_t leaves) {
    for (std::size_t count = tree_.size(); count < leaves && !queue_.empty();) {
      const int widest = -queue_.top().second;
      queue_.pop();
      if (split(widest)) ++count;
    }
  }

  OccluderTree finish() && {
    const auto firstLeaf =
        std::find(tree_.children.begin(), tree_.children.end(), std::array<int, 2>{-1, -1});
    tree_.leafOfVertex.assign(
        scene_.vertexCount(),
        order_.empty() ? 0 : static_cast<std::uint32_t>(firstLeaf - tree_.children.begin()));
    for (std::uint32_t node = 0; node < tree_.size(); ++node) {
      if (!tree_.isLeaf(node)) continue;
      for (std::size_t i = clusters_[node].first; i < clusters_[node].end; ++i)
        tree_.leafOfVertex[order_[i]] = node;
    }
    return std::move(tree_);
  }

 private:
  Eigen::Vector3d positionOf(std::size_t place) const {
    const glm::vec3& p = scene_.positions[order_[place]];
    return {p.x, p.y, p.z};
  }

  Cluster clusterOf(std::size_t first, std::size_t end) const {
    Cluster cluster{first, end};
    const Eigen::Vector3d origin = positionOf(first);
    double area = 0.0;
    for (std::size_t i = first; i < end; ++i) {
      area += areas_[order_[i]];
      cluster.mean += areas_[order_[i]] * (positionOf(i) - origin);
    }
    cluster.mean /= area;
    for (std::size_t i = first; i < end; ++i) {
      const Eigen::Vector3d offset = positionOf(i) - origin - cluster.mean;
      cluster.covariance += areas_[order_[i]] * offset * offset.transpose();
    }
    return cluster;
  }

  void addNode(const std::string& name, int parent, std::size_t first, std::size_t end) {
    const int node = static_cast<int>(tree_.size());
    tree_.names.push_back(name);
    tree_.parent.push_back(parent);
    tree_.children.push_back({-1, -1});
    clusters_.push_back(clusterOf(first, end));
    queue_.emplace(clusters_.back().covariance.trace(), -node);
  }

  /// Splits a node. Returns false if all vertices are on one side, as coincident ones are.
  bool split(int node) {
    const auto n = static_cast<std::size_t>(node);
    const Cluster cluster = clusters_[n];
    const Eigen::Vector3d axis = principalAxis(cluster.covariance);
    const glm::vec3 first = scene_.positions[order_[cluster.first]];
    const auto isBelow = [&](std::uint32_t v) {
      const glm::dvec3 offset = glm::dvec3(scene_.positions[v]) - glm::dvec3(first);
      return axis.dot(Eigen::Vector3d(offset.x, offset.y, offset.z) - cluster.mean) <= 0.0;
    };
    const auto begin = order_.begin();
    const auto middle = std::stable_partition(begin + static_cast<std::ptrdiff_t>(cluster.first),
                                              begin + static_cast<std::ptrdiff_t>(cluster.end), isBelow);
    const auto cut = static_cast<std::size_t>(middle - begin);
    if (cut == cluster.first || cut == cluster.end) return false;
    const int child = static_cast<int>(tree_.size());
    tree_.children[n] = {child, child + 1};
    const std::string name = tree_.names[n];
    addNode(name + "/0", node, cluster.first, cut);
    addNode(name + "/1", node, cut, cluster.end);
    return true;
  }

  const CompiledScene& scene_;
  std::vector<double> areas_;  ///< [vertex]
  std::vector<std::uint32_t> order_;
  std::vector<Cluster> clusters_;  ///< [tree node]
  /// Spread and negative tree node, so that ties go to the lower one.
  std::priority_queue<std::pair<double, int>> queue_;
  OccluderTree tree_;
};

}  // namespace

std::size_t OccluderTree::leafCount() const {
  return static_cast<std::size_t>(
      std::count_if(children.begin(), children.end(), [](const auto& pair) { return pair[0] < 0; }));
}

OccluderTree makeOccluderTree(const CompiledScene& scene, std::size_t leaves) {
  std::map<int, std::size_t> rootOfNode;
  std::vector<std::string> names;
  std::vector<std::vector<std::uint32_t>> vertices;  // [root]
  for (const PrimitiveRange& range : scene.primitives) {
    if (range.triangleCount == 0) continue;
    const auto [at, fresh] = rootOfNode.try_emplace(range.node, names.size());
    if (fresh) {
      names.push_back(nodeNameOf(range));
      vertices.emplace_back();
    }
    std::vector<std::uint32_t>& own = vertices[at->second];
    own.resize(own.size() + range.vertexCount);
    std::iota(own.end() - range.vertexCount, own.end(), range.firstVertex);
  }
  Splitter splitter(scene);
  for (std::size_t root = 0; root < names.size(); ++root) splitter.addRoot(names[root], vertices[root]);
  splitter.splitUpTo(leaves);
  return std::move(splitter).finish();
}

namespace {

/// Returns the number by which occluders of a kind are distinguished.
std::uint32_t keyOf(const CompiledScene& scene, const PrimitiveRange& range, OccluderKind kind) {
  switch (kind) {
    case OccluderKind::Mesh:
      return static_cast<std::uint32_t>(range.mesh);
    case OccluderKind::Material: {
      if (range.triangleCount == 0) return 0;
      const std::uint32_t material = scene.triangleMaterials[range.firstTriangle];
      const int source = scene.materials[material].source;
      return source < 0 ? material : static_cast<std::uint32_t>(source);
    }
    case OccluderKind::Node:
    case OccluderKind::Auto:
      break;
  }
  return static_cast<std::uint32_t>(range.node);
}

std::string nameOf(const PrimitiveRange& range, OccluderKind kind, std::uint32_t key) {
  switch (kind) {
    case OccluderKind::Mesh:
      return "mesh " + std::to_string(key);
    case OccluderKind::Material:
      return "material " + std::to_string(key);
    case OccluderKind::Node:
    case OccluderKind::Auto:
      break;
  }
  return nodeNameOf(range);
}

}  // namespace

OccluderGroups makeOccluderGroups(const CompiledScene& scene, OccluderKind kind) {
  OccluderGroups groups;
  groups.groupOfVertex.resize(scene.vertexCount());
  std::map<std::uint32_t, std::uint32_t> groupOfKey;
  for (const PrimitiveRange& range : scene.primitives) {
    if (range.triangleCount == 0) continue;
    const std::uint32_t key = keyOf(scene, range, kind);
    const auto [found, fresh] = groupOfKey.try_emplace(key, static_cast<std::uint32_t>(groups.names.size()));
    if (fresh) groups.names.push_back(nameOf(range, kind, key));
    for (std::uint32_t v = 0; v < range.vertexCount; ++v)
      groups.groupOfVertex[range.firstVertex + v] = found->second;
  }
  return groups;
}

std::vector<std::uint32_t> leafNodes(const OccluderTree& tree) {
  std::vector<std::uint32_t> leaves;
  for (std::uint32_t node = 0; node < tree.size(); ++node)
    if (tree.isLeaf(node)) leaves.push_back(node);
  return leaves;
}

OccluderGroups leavesOf(const OccluderTree& tree) {
  const std::vector<std::uint32_t> leaves = leafNodes(tree);
  std::vector<std::uint32_t> groupOfNode(tree.size(), 0);
  OccluderGroups groups;
  for (std::uint32_t g = 0; g < leaves.size(); ++g) {
    groupOfNode[leaves[g]] = g;
    groups.names.push_back(tree.names[leaves[g]]);
  }
  for (const std::uint32_t leaf : tree.leafOfVertex) groups.groupOfVertex.push_back(groupOfNode[leaf]);
  return groups;
}

}  // namespace prelight
