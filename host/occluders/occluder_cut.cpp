#include "occluders/occluder_cut.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/parallel.h"
#include "occluders/occluder_record.h"

namespace prelight {

namespace {

constexpr std::size_t verticesAtOnce = 64;  // vertices that reuse the memory of a row
constexpr double leavesOnly = -1.0;         // price at which nothing is merged, as records reduce the cost
constexpr double leastPrice = 1e-9;         // below any relevant error
constexpr int bisections = 30;              // on the logarithm of the price
constexpr double filled = 0.998;            // share of the limit that is good enough to end the search

/// Returns the vector whose w weights a mean vector, or nullopt for vectors that are sums.
std::optional<OccluderVector> meanBy(OccluderVector vector) {
  if (isSum(vector)) return std::nullopt;
  return vector == OccluderVector::SpecularColor ? OccluderVector::SpecularNormal : OccluderVector::Occlusion;
}

/// Returns areas relative to their mean, [vertex].
std::vector<double> weightsOf(std::span<const double> areas) {
  const double sum = std::accumulate(areas.begin(), areas.end(), 0.0);
  std::vector<double> weights(areas.size(), 1.0);
  if (!(sum > 0.0)) return weights;
  const double mean = sum / static_cast<double>(areas.size());
  for (std::size_t v = 0; v < areas.size(); ++v) weights[v] = areas[v] / mean;
  return weights;
}

/// The records to merge.
struct Leaves {
  const OccluderTransfer& transfer;
  const OccluderTree& tree;
  std::size_t occlusion;                            ///< index of occlusion in `stored`
  std::vector<std::optional<std::size_t>> weights;  ///< [stored], index of the vector that weights a mean

  Leaves(const OccluderTransfer& leaves, const OccluderTree& occluderTree)
      : transfer(leaves), tree(occluderTree), occlusion(placeOf(leaves, OccluderVector::Occlusion)) {
    assert(occlusion < leaves.stored.size());
    for (const OccluderVector vector : leaves.stored) {
      const std::optional<OccluderVector> by = meanBy(vector);
      weights.push_back(by ? std::optional(placeOf(leaves, *by)) : std::nullopt);
      assert(!by || *weights.back() < leaves.stored.size());
    }
  }

  std::size_t vertexCount() const { return transfer.offsets.empty() ? 0 : transfer.offsets.size() - 1; }
  std::size_t width() const { return transfer.stored.size(); }
  const glm::vec4* record(std::size_t r) const { return &transfer.vectors[r * width()]; }
  double formFactor(std::size_t r) const { return record(r)[occlusion].w; }
};

/// Computes the cuts of single vertices.
class RowCut {
 public:
  explicit RowCut(const Leaves& leaves)
      : leaves_(leaves), seen_(leaves.tree.size()), marks_(leaves.tree.size() / 64 + 1, 0) {}

  /// Computes the cut of a vertex. Returns its number of records.
  std::size_t cut(std::size_t vertex, double weight, double price) {
    gather(vertex);
    for (std::size_t i = nodes_.size(); i-- > 0;) decide(nodes_[i], weight, price);
    kept_.clear();
    for (const std::uint32_t node : nodes_) keep(node);
    return kept_.size();
  }

  /// Writes the records of the last cut.
  void write(std::size_t vertex, std::uint32_t* occluders, glm::vec4* vectors) {
    const OccluderTransfer& from = leaves_.transfer;
    const std::size_t width = leaves_.width();
    std::copy(kept_.begin(), kept_.end(), occluders);
    sums_.assign(kept_.size() * width, glm::dvec4(0.0));
    for (std::size_t r = from.offsets[vertex]; r < from.offsets[vertex + 1]; ++r) {
      if (!(leaves_.formFactor(r) > 0.0)) continue;
      const auto k = static_cast<std::size_t>(seen_[from.occluders[r]].record);
      const glm::vec4* record = leaves_.record(r);
      for (std::size_t s = 0; s < width; ++s)
        sums_[k * width + s] +=
            (leaves_.weights[s] ? double(record[*leaves_.weights[s]].w) : 1.0) * glm::dvec4(record[s]);
      if (leaves_.tree.isLeaf(kept_[k])) std::copy_n(leaves_.record(r), width, vectors + k * width);
    }
    for (std::size_t k = 0; k < kept_.size(); ++k) {
      if (leaves_.tree.isLeaf(kept_[k])) continue;
      const glm::dvec4* sums = &sums_[k * width];
      for (std::size_t s = 0; s < width; ++s) {
        const double weight = leaves_.weights[s] ? sums[*leaves_.weights[s]].w : 1.0;
        vectors[k * width + s] = glm::vec4(weight > 0.0 ? sums[s] / weight : glm::dvec4(0.0));
      }
    }
  }

 private:
  /// A vertex's view of a tree node.
  struct Seen {
    double formFactor = 0.0;
    glm::dvec3 direction{0.0};  ///< the occlusion vector
    double childrenCost = 0.0;
    int children = 0;     ///< number of visible children
    bool listed = false;  ///< in nodes_
    bool joined = false;  ///< kept, unless a node above it is
    int record = -1;      ///< index in kept_ of its record
  };

  /// Lists the tree nodes that a vertex sees, ascending, so that parents come first.
  void gather(std::size_t vertex) {
    for (const std::uint32_t node : nodes_) seen_[node] = {};
    nodes_.clear();
    const OccluderTransfer& from = leaves_.transfer;
    for (std::size_t r = from.offsets[vertex]; r < from.offsets[vertex + 1]; ++r) {
      if (!(leaves_.formFactor(r) > 0.0)) continue;
      const std::uint32_t leaf = from.occluders[r];
      assert(leaf < leaves_.tree.size() && leaves_.tree.isLeaf(leaf));
      seen_[leaf].formFactor = leaves_.formFactor(r);
      seen_[leaf].direction = glm::dvec3(leaves_.record(r)[leaves_.occlusion]);
      for (int node = static_cast<int>(leaf); node >= 0; node = parentOf(node)) {
        Seen& seen = seen_[static_cast<std::size_t>(node)];
        if (seen.listed) break;
        seen.listed = true;
        marks_[static_cast<std::size_t>(node) / 64] |= std::uint64_t{1} << (node % 64);
      }
    }
    for (std::size_t word = 0; word < marks_.size(); ++word)
      for (; marks_[word] != 0; marks_[word] &= marks_[word] - 1)
        nodes_.push_back(static_cast<std::uint32_t>(64 * word) +
                         static_cast<std::uint32_t>(std::countr_zero(marks_[word])));
  }

  /// Computes the least cost below a node. Its children must be done.
  void decide(std::uint32_t node, double weight, double price) {
    Seen& seen = seen_[node];
    const double length = glm::length(seen.direction);
    const double own =
        weight * seen.formFactor * std::sqrt(std::max(0.0, 1.0 - length / seen.formFactor)) + price;
    seen.joined = seen.children == 0 || (seen.children == 2 && own <= seen.childrenCost);
    const int above = parentOf(static_cast<int>(node));
    if (above < 0) return;
    Seen& parent = seen_[static_cast<std::size_t>(above)];
    parent.formFactor += seen.formFactor;
    parent.direction += seen.direction;
    parent.childrenCost += seen.joined ? own : seen.childrenCost;
    ++parent.children;
  }

  /// Adds a node to the cut unless it lies below one in it. Its parent must be done.
  void keep(std::uint32_t node) {
    const int above = parentOf(static_cast<int>(node));
    Seen& seen = seen_[node];
    if (above >= 0) seen.record = seen_[static_cast<std::size_t>(above)].record;
    if (seen.record >= 0 || !seen.joined) return;
    seen.record = static_cast<int>(kept_.size());
    kept_.push_back(node);
  }

  int parentOf(int node) const { return leaves_.tree.parent[static_cast<std::size_t>(node)]; }

  const Leaves& leaves_;
  std::vector<Seen> seen_;            ///< [tree node]
  std::vector<std::uint64_t> marks_;  ///< one bit per tree node, used while gathering
  std::vector<std::uint32_t> nodes_;  ///< visible nodes, ascending
  std::vector<std::uint32_t> kept_;   ///< ascending
  std::vector<glm::dvec4> sums_;      ///< [kept][stored]
};

class Cutter {
 public:
  Cutter(const Leaves& leaves, std::span<const double> areas) : leaves_(leaves), weights_(weightsOf(areas)) {}

  /// Returns the least price with at most `limit` records, else one with the fewest.
  double priceOf(double limit) const {
    const auto meets = [&](double price) { return double(offsetsAt(price).back()) <= limit; };
    for (const double price : {leavesOnly, leastPrice})
      if (meets(price)) return price;
    double low = leastPrice, high = coarsestPrice();
    if (!meets(high)) return high;
    for (int i = 0; i < bisections; ++i) {
      const double middle = std::sqrt(low * high), records = offsetsAt(middle).back();
      (records <= limit ? high : low) = middle;
      if (records <= limit && records >= filled * limit) break;
    }
    return high;
  }

  OccluderTransfer cut(double price) const {
    OccluderTransfer out{leaves_.tree.names, leaves_.transfer.stored, offsetsAt(price), {}, {}};
    out.occluders.resize(out.offsets.back());
    out.vectors.resize(out.offsets.back() * leaves_.width());
    forEachRow(price, [&](RowCut& row, std::size_t vertex, std::size_t) {
      const std::size_t first = out.offsets[vertex];
      row.write(vertex, out.occluders.data() + first, out.vectors.data() + first * leaves_.width());
    });
    return out;
  }

 private:
  /// Calls visit(row, vertex, records) for every vertex at a price, from several threads.
  template <class Visit>
  void forEachRow(double price, const Visit& visit) const {
    parallelRanges(leaves_.vertexCount(), verticesAtOnce, [&](std::size_t begin, std::size_t end) {
      RowCut row(leaves_);
      for (std::size_t v = begin; v < end; ++v) visit(row, v, row.cut(v, weights_[v], price));
    });
  }

  std::vector<std::uint32_t> offsetsAt(double price) const {
    std::vector<std::uint32_t> offsets(leaves_.vertexCount() + 1, 0);
    forEachRow(price, [&](RowCut&, std::size_t vertex, std::size_t records) {
      offsets[vertex + 1] = static_cast<std::uint32_t>(records);
    });
    std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
    return offsets;
  }

  /// Returns a price above every error, at which everything is merged.
  double coarsestPrice() const {
    double most = 1.0;
    for (std::size_t v = 0; v < leaves_.vertexCount(); ++v) {
      double sum = 0.0;
      for (std::size_t r = leaves_.transfer.offsets[v]; r < leaves_.transfer.offsets[v + 1]; ++r)
        sum += std::max(0.0, leaves_.formFactor(r));
      most = std::max(most, 2.0 * weights_[v] * sum);
    }
    return most;
  }

  const Leaves& leaves_;
  std::vector<double> weights_;  ///< [vertex]
};

}  // namespace

OccluderTransfer cutOccluders(const OccluderTransfer& leaves, const OccluderTree& tree,
                              std::span<const double> areaOfVertex, double recordsPerVertex) {
  const Leaves rows(leaves, tree);
  assert(areaOfVertex.size() == rows.vertexCount());
  const Cutter cutter(rows, areaOfVertex);
  return cutter.cut(cutter.priceOf(recordsPerVertex * static_cast<double>(rows.vertexCount())));
}

DroppedOccluders dropOccluders(OccluderTransfer& transfer, double leastFormFactor) {
  DroppedOccluders dropped;
  const std::size_t width = transfer.stored.size(), place = placeOf(transfer, OccluderVector::Occlusion);
  const std::size_t vertices = transfer.offsets.empty() ? 0 : transfer.offsets.size() - 1;
  std::uint32_t kept = 0;
  for (std::size_t v = 0, r = 0; v < vertices; ++v) {
    const std::uint32_t end = transfer.offsets[v + 1];
    double lost = 0.0;
    for (; r < end; ++r) {
      const glm::vec4* record = &transfer.vectors[r * width];
      if (double(record[place].w) < leastFormFactor) {
        lost += record[place].w;
        continue;
      }
      transfer.occluders[kept] = transfer.occluders[r];
      std::copy_n(record, width, &transfer.vectors[kept * width]);
      ++kept;
    }
    transfer.offsets[v + 1] = kept;
    dropped.mean += lost / static_cast<double>(vertices);
    dropped.most = std::max(dropped.most, lost);
  }
  transfer.occluders.resize(kept);
  transfer.vectors.resize(kept * width);
  return dropped;
}

}  // namespace prelight
