#include "occluders/occluder_motion.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/parallel.h"
#include "occluders/occluder_record.h"

namespace prelight {

struct PointTree::Search {
  const glm::dvec3& place;
  double scale;
  const CostOf& costOf;
  Found best;
  std::size_t left;  ///< points that may still be visited
};

PointTree::PointTree(std::span<const glm::dvec3> points)
    : points_(points.begin(), points.end()), order_(points.size()), axes_(points.size(), 0) {
  std::iota(order_.begin(), order_.end(), 0u);
  split(0, points_.size());
  std::vector<glm::dvec3> sorted(points_.size());
  for (std::size_t i = 0; i < order_.size(); ++i) sorted[i] = points_[order_[i]];
  points_ = std::move(sorted);
}

void PointTree::split(std::size_t begin, std::size_t end) {
  if (end - begin < 2) return;
  glm::dvec3 low = points_[order_[begin]], high = low;
  for (std::size_t i = begin; i < end; ++i) {
    low = glm::min(low, points_[order_[i]]);
    high = glm::max(high, points_[order_[i]]);
  }
  const glm::dvec3 size = high - low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::size_t middle = (begin + end) / 2;
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
    return points_[a][axis] != points_[b][axis] ? points_[a][axis] < points_[b][axis] : a < b;
  });
  axes_[middle] = static_cast<std::uint8_t>(axis);
  split(begin, middle);
  split(middle + 1, end);
}

void PointTree::visit(std::size_t begin, std::size_t end, Search& search) const {
  if (begin == end || search.left == 0) return;
  const std::size_t middle = (begin + end) / 2;
  const glm::dvec3 path = search.place - points_[middle];
  const double beyond = path[axes_[middle]];
  const bool below = beyond <= 0.0;
  visit(below ? begin : middle + 1, below ? middle : end, search);
  if (search.left > 0 && search.scale * glm::dot(path, path) < search.best.cost) {
    --search.left;
    const double cost = search.costOf(order_[middle]);
    if (cost < search.best.cost) search.best = {order_[middle], cost};
  }
  if (search.scale * beyond * beyond < search.best.cost)
    visit(below ? middle + 1 : begin, below ? end : middle, search);
}

PointTree::Found PointTree::cheapest(const glm::dvec3& place, double scale, const CostOf& costOf, Found best,
                                     std::size_t most) const {
  Search search{place, scale, costOf, best, most};
  visit(0, points_.size(), search);
  return search.best;
}

namespace {

constexpr std::size_t verticesARange = 64;
constexpr std::size_t mostPlaces = 64;  // candidates compared for one view
// Least distance, in units of the reach, by which differences of places are divided.
constexpr double leastComparedDistance = 0.25;

std::vector<OccluderView> viewsOf(const CompiledScene& scene) {
  std::vector<OccluderView> views;
  views.reserve(scene.vertexCount());
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v)
    views.push_back({scene.origin + glm::dvec3(scene.positions[v]), glm::dvec3(scene.normals[v])});
  return views;
}

std::vector<glm::dvec3> positionsOf(const std::vector<OccluderView>& views) {
  std::vector<glm::dvec3> positions;
  positions.reserve(views.size());
  for (const OccluderView& view : views) positions.push_back(view.position);
  return positions;
}

/// Returns the roots of occluders. Parents come before their parts.
std::vector<std::uint32_t> rootsOf(const std::vector<int>& parents) {
  std::vector<std::uint32_t> roots(parents.size());
  for (std::size_t o = 0; o < parents.size(); ++o)
    roots[o] = parents[o] < 0 ? static_cast<std::uint32_t>(o) : roots[static_cast<std::size_t>(parents[o])];
  return roots;
}

/// Merges equal motions, so that objects that share one are known to stay together.
OccluderMotions merged(OccluderMotions motions) {
  std::vector<std::uint32_t> first(motions.motions.size());
  for (std::size_t m = 0; m < first.size(); ++m)
    first[m] = static_cast<std::uint32_t>(
        std::find(motions.motions.begin(), motions.motions.end(), motions.motions[m]) -
        motions.motions.begin());
  for (std::uint32_t& m : motions.ofVertex) m = first[m];
  for (std::uint32_t& m : motions.ofOccluder) m = first[m];
  return motions;
}

/// Returns the form factor of kept occluders when moved ones cover `after` of the hemisphere instead of
/// `before`. Kept occluders that fill the whole rest continue to do so; otherwise they only make room where
/// the sum would exceed 1.
double keptFormFactor(double kept, double before, double after) {
  const double free = std::max(0.0, 1.0 - before);
  const double filled = free > 0.0 ? std::min(1.0, kept / free) : 0.0;
  const double known = free * free * std::pow(filled, 8.0);  // little is known of what hides behind much
  return std::min(kept + known * ((1.0 - after) * filled - kept), 1.0 - after);
}

}  // namespace

/// The records of a vertex under construction.
struct OccluderMover::Row {
  std::size_t width;
  std::vector<std::uint32_t> occluders;
  std::vector<glm::vec4> vectors;
  std::size_t kept = 0;  ///< number of records at the front that moved along with the vertex

  std::span<glm::vec4> record(std::size_t r) { return std::span(vectors).subspan(r * width, width); }
  std::span<glm::vec4> add(std::uint32_t occluder) {
    occluders.push_back(occluder);
    vectors.resize(vectors.size() + width);
    return record(occluders.size() - 1);
  }
  void removeLast() {
    occluders.pop_back();
    vectors.resize(vectors.size() - width);
  }
};

/// The root occluders of one motion.
struct OccluderMover::MovedClass {
  std::uint32_t motion = 0;
  std::vector<std::uint32_t> roots;
  glm::dvec3 centre{0.0};  ///< centre of the roots after the motion
  double reach = 0.0;
};

OccluderMover::OccluderMover(const OccluderTransfer& rest, const CompiledScene& scene,
                             const OccluderMembers& members)
    : rest_(rest),
      occlusion_(placeOf(rest, OccluderVector::Occlusion)),
      views_(viewsOf(scene)),
      rootOf_(rootsOf(members.parent)),
      bodies_(bodiesOf(scene, rest, members)),
      tree_(positionsOf(views_)) {
  assert(occlusion_ < rest.stored.size());
}

std::vector<OccluderMover::MovedClass> OccluderMover::classesOf(const OccluderMotions& motions) const {
  std::vector<MovedClass> classes(motions.motions.size());
  for (std::uint32_t m = 0; m < classes.size(); ++m) classes[m].motion = m;
  for (std::uint32_t o = 0; o < rootOf_.size(); ++o)
    if (rootOf_[o] == o) classes[motions.ofOccluder[o]].roots.push_back(o);
  std::erase_if(classes, [](const MovedClass& moved) { return moved.roots.empty(); });
  for (MovedClass& moved : classes) {
    const RigidMotion& motion = motions.motions[moved.motion];
    for (const std::uint32_t root : moved.roots)
      moved.centre += motion.point(bodies_[root].centre) / static_cast<double>(moved.roots.size());
    for (const std::uint32_t root : moved.roots)
      moved.reach = std::max(
          moved.reach, bodies_[root].reach + glm::length(motion.point(bodies_[root].centre) - moved.centre));
  }
  return classes;
}

/// Returns the vertex whose position relative to the occluders in the bake was closest to the present view:
/// by squared distance, in units of the distance to the occluders, and by normals.
std::uint32_t OccluderMover::sourceOf(const OccluderMotions& motions, const MovedClass& moved,
                                      std::uint32_t vertex, const OccluderView& to) const {
  const RigidMotion& motion = motions.motions[moved.motion];
  const glm::dvec3 place = motion.pointBefore(to.position);
  const glm::dvec3 normal = glm::transpose(motion.rotation) * to.normal;
  const double distance =
      std::max({glm::length(to.position - moved.centre), leastComparedDistance * moved.reach, 1e-300});
  const double scale = 1.0 / (distance * distance);
  const auto costOf = [&](std::uint32_t v) {
    if (v != vertex && motions.ofVertex[v] == moved.motion) return std::numeric_limits<double>::infinity();
    const glm::dvec3 path = views_[v].position - place, difference = views_[v].normal - normal;
    return scale * glm::dot(path, path) + glm::dot(difference, difference);
  };
  return tree_.cheapest(place, scale, costOf, {vertex, costOf(vertex)}, mostPlaces).point;
}

/// Adds the records of occluders that moved relative to a vertex.
void OccluderMover::addSeen(const OccluderMotions& motions, const MovedClass& moved, std::uint32_t vertex,
                            const OccluderView& to, double leastFormFactor, Row& row) const {
  const RigidMotion& motion = motions.motions[moved.motion];
  const std::uint32_t source = sourceOf(motions, moved, vertex, to);
  const OccluderView& from = views_[source];
  std::vector<std::uint32_t> seen;
  for (std::size_t r = rest_.offsets[source]; r < rest_.offsets[source + 1]; ++r) {
    const std::uint32_t occluder = rest_.occluders[r];
    if (motions.ofOccluder[occluder] != moved.motion) continue;
    const std::span record = std::span(rest_.vectors).subspan(r * row.width, row.width);
    const std::span<glm::vec4> carried = row.add(occluder);
    carryRecord(rest_.stored, record, from, motion, bodies_[rootOf_[occluder]], to, carried);
    if (carried[occlusion_].w < leastFormFactor)
      row.removeLast();
    else
      seen.push_back(rootOf_[occluder]);
  }
  for (const std::uint32_t root : moved.roots) {
    if (std::find(seen.begin(), seen.end(), root) != seen.end()) continue;
    if (!comesIntoView(from, motion, bodies_[root], to)) continue;
    const std::span<glm::vec4> record = row.add(root);
    ballRecord(rest_.stored, movedBody(bodies_[root], motion), to, record);
    if (record[occlusion_].w < leastFormFactor) row.removeLast();
  }
}

/// Adds the records of occluders that share the vertex's motion.
void OccluderMover::addKept(const OccluderMotions& motions, std::uint32_t vertex, Row& row) const {
  const RigidMotion& motion = motions.motions[motions.ofVertex[vertex]];
  for (std::size_t r = rest_.offsets[vertex]; r < rest_.offsets[vertex + 1]; ++r) {
    if (motions.ofOccluder[rest_.occluders[r]] != motions.ofVertex[vertex]) continue;
    const std::span<glm::vec4> record = row.add(rest_.occluders[r]);
    std::copy_n(&rest_.vectors[r * row.width], row.width, record.begin());
    if (motion == RigidMotion{}) continue;
    for (std::size_t s = 0; s < row.width; ++s) {
      const glm::dvec3 xyz(record[s]);
      if (rest_.stored[s] == OccluderVector::Position)
        record[s] = glm::vec4(motion.point(xyz), record[s].w);
      else if (isSum(rest_.stored[s]))
        record[s] = glm::vec4(motion.direction(xyz), record[s].w);
    }
  }
  row.kept = row.occluders.size();
}

void OccluderMover::makeRow(const OccluderMotions& motions, const std::vector<MovedClass>& classes,
                            std::uint32_t vertex, double leastFormFactor, Row& row) const {
  const RigidMotion& motion = motions.motions[motions.ofVertex[vertex]];
  const OccluderView to{motion.point(views_[vertex].position), motion.direction(views_[vertex].normal)};
  addKept(motions, vertex, row);
  bool changed = false;
  for (const MovedClass& moved : classes) {
    if (moved.motion == motions.ofVertex[vertex]) continue;
    addSeen(motions, moved, vertex, to, leastFormFactor, row);
    changed = true;
  }
  if (!changed) return;
  double kept = 0.0, after = 0.0, before = 0.0;
  for (std::size_t r = 0; r < row.occluders.size(); ++r)
    (r < row.kept ? kept : after) += double(row.record(r)[occlusion_].w);
  for (std::size_t r = rest_.offsets[vertex]; r < rest_.offsets[vertex + 1]; ++r)
    if (motions.ofOccluder[rest_.occluders[r]] != motions.ofVertex[vertex])
      before += double(rest_.vectors[r * row.width + occlusion_].w);
  if (after > 1.0)
    for (std::size_t r = row.kept; r < row.occluders.size(); ++r)
      scaleRecord(rest_.stored, 1.0 / after, row.record(r));
  const double wanted = keptFormFactor(kept, before, std::min(after, 1.0));
  if (kept > 0.0 && wanted != kept)
    for (std::size_t r = 0; r < row.kept; ++r) scaleRecord(rest_.stored, wanted / kept, row.record(r));
}

OccluderTransfer OccluderMover::moved(const OccluderMotions& asked, double leastFormFactor) const {
  assert(asked.ofVertex.size() == views_.size() && asked.ofOccluder.size() == rest_.names.size());
  const OccluderMotions motions = merged(asked);
  const std::vector<MovedClass> classes = classesOf(motions);
  std::vector<Row> rows((views_.size() + verticesARange - 1) / verticesARange,
                        Row{rest_.stored.size(), {}, {}});
  OccluderTransfer out{rest_.names, rest_.stored, std::vector<std::uint32_t>(views_.size() + 1, 0), {}, {}};
  parallelRanges(views_.size(), verticesARange, [&](std::size_t begin, std::size_t end) {
    Row& all = rows[begin / verticesARange];
    std::vector<std::size_t> order;
    for (std::size_t v = begin; v < end; ++v) {
      Row row{all.width, {}, {}};
      makeRow(motions, classes, static_cast<std::uint32_t>(v), leastFormFactor, row);
      order.resize(row.occluders.size());
      std::iota(order.begin(), order.end(), std::size_t{0});
      std::sort(order.begin(), order.end(),
                [&](std::size_t a, std::size_t b) { return row.occluders[a] < row.occluders[b]; });
      for (const std::size_t r : order)
        std::copy_n(row.record(r).begin(), row.width, all.add(row.occluders[r]).begin());
      out.offsets[v + 1] = static_cast<std::uint32_t>(order.size());
    }
  });
  std::partial_sum(out.offsets.begin(), out.offsets.end(), out.offsets.begin());
  for (const Row& row : rows) {
    out.occluders.insert(out.occluders.end(), row.occluders.begin(), row.occluders.end());
    out.vectors.insert(out.vectors.end(), row.vectors.begin(), row.vectors.end());
  }
  return out;
}

}  // namespace prelight
