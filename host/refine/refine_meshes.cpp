#include "refine/refine_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "refine/detail_probe.h"
#include "refine/largest_instance.h"
#include "scene/gltf/load/file_triangles.h"
#include "scene/light_sources.h"

namespace prelight {

namespace {

constexpr int mostLevels = 32;
constexpr std::size_t probedInstances = 4;  // of a primitive
/// Receivers per surface of the scene while triangles are large: what is smaller than their distance may be
/// missed.
constexpr double receiversOfScene = 1 << 11;
/// The smallest edges are those of this many squares that cover the scene's surface.
constexpr double smallestSquares = 1 << 20;
/// A part may lose the permitted error if it is as large as one of this many that cover the scene's surface,
/// or larger. Smaller ones may lose more, so that each contributes as much to the error of the surface: edges
/// of shadows, which no interpolation follows, are not chased down to nothing.
constexpr double partsOfScene = 1 << 12;
constexpr int leastSteps = 2, mostSteps = 256;
/// Parts whose error is this many times the permitted one are cut into four at once, others into two.
constexpr float cutsAll = 2.0f;

/// Rays of a receiver's first look, per set of directions. A second look follows unless the first finds
/// hardly any change, or an error that noise of so few rays could not make.
constexpr std::uint32_t quickRays = 8;
constexpr double hardlyAny = 0.25;  // of the permitted error
constexpr double clearlyLarge = 4.0, noiseOfQuick = 0.1;

/// Returns the rays of the second look.
std::uint32_t carefulRays(double error) {
  return static_cast<std::uint32_t>(std::clamp(std::exp2(std::ceil(std::log2(0.32 / error))), 32.0, 256.0));
}

/// A primitive's triangles in some of its instances.
using Instances = std::vector<FileTriangles>;

/// Returns a few of a primitive's instances, evenly chosen by their area, the largest among them.
Instances chosenInstances(const CompiledScene& compiled, const std::vector<const PrimitiveRange*>& ranges,
                          const Primitive& primitive) {
  std::vector<std::pair<double, const PrimitiveRange*>> ordered;
  for (const PrimitiveRange* range : ranges) ordered.emplace_back(instanceArea(compiled, *range), range);
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<glm::uvec3> corners;
  for (std::size_t t = 0; t < primitive.triangles.size(); ++t) corners.push_back(fileTriangle(primitive, t));
  Instances instances;
  const std::size_t count = std::min(ranges.size(), probedInstances);
  for (std::size_t i = 0; i < count; ++i)
    instances.push_back(fileTriangles(corners, compiled, *ordered[i * ranges.size() / count].second));
  return instances;
}

/// Distances up to which visibility is probed as well, for lamps within the scene's bounds; empty if there
/// are none.
std::vector<double> lampReaches(const CompiledScene& scene) {
  if (lampsWithin(scene).empty()) return {};
  const double diagonal = glm::length(glm::dvec3(scene.boundsMax) - glm::dvec3(scene.boundsMin));
  return {diagonal / 8.0, diagonal / 3.0};
}

/// A mesh that nodes draw.
struct DrawnMesh {
  RefinedMesh mesh;
  std::vector<Instances> instances;  ///< [primitive], the probed ones
  std::size_t times = 0;             ///< instances of the mesh
  double share = 0.0;                ///< surface of all instances per area of the mesh's parts
};

/// A part that has to be probed.
struct Candidate {
  std::size_t mesh = 0;
  std::size_t part = 0;
  double area = 0.0;       ///< m2
  double tolerance = 0.0;  ///< error that the part may have
};

class MeshRefiner {
 public:
  MeshRefiner(const Scene& scene, const CompiledScene& compiled, Tracer& tracer, const RefineRequest& request,
              Progress& progress, RefineReport& report)
      : compiled_(compiled),
        request_(request),
        progress_(progress),
        report_(report),
        quick_(compiled, tracer, quickRays, lampReaches(compiled)),
        careful_(compiled, tracer, carefulRays(request.error), lampReaches(compiled)) {
    for (std::uint32_t t = 0; t < compiled.triangleCount(); ++t)
      area_ += 0.5 * glm::length(geometricNormal(compiled, t));
    spacing_ = std::sqrt(area_ / receiversOfScene);
    leastEdge_ = std::sqrt(area_ / smallestSquares);
    addMeshes(scene);
  }

  std::vector<RefinedPrimitive> run() {
    for (int level = 0; level < mostLevels && !report_.limited; ++level) {
      const std::vector<Candidate> bad = probe(level);
      if (level == 0) report_.errorBefore = errorOfSurface();
      if (bad.empty()) break;
      cut(bad);
    }
    return finish();
  }

 private:
  void addMeshes(const Scene& scene) {
    std::map<std::pair<int, int>, std::vector<const PrimitiveRange*>> ranges;
    for (const PrimitiveRange& range : compiled_.primitives)
      ranges[{range.mesh, range.primitive}].push_back(&range);
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
      const std::optional<glm::dmat3> toWorld = largestInstance(scene, compiled_, m);
      if (!toWorld || !hasLongEdge(scene.meshes[m], *toWorld)) continue;
      DrawnMesh drawn{RefinedMesh(scene.meshes[m], m, *toWorld), {}, 0, 0.0};
      double surface = 0.0, own = 0.0;
      for (std::size_t p = 0; p < scene.meshes[m].primitives.size(); ++p) {
        const auto& all = ranges[{static_cast<int>(m), static_cast<int>(p)}];
        drawn.times = std::max(drawn.times, all.size());
        drawn.instances.push_back(chosenInstances(compiled_, all, scene.meshes[m].primitives[p]));
        for (const PrimitiveRange* range : all) surface += instanceArea(compiled_, *range);
      }
      for (const TrianglePart& part : drawn.mesh.parts()) own += drawn.mesh.area(part);
      if (own > 0.0) drawn.share = surface / own;
      meshes_.push_back(std::move(drawn));
    }
  }

  bool hasLongEdge(const Mesh& mesh, const glm::dmat3& toWorld) const {
    for (const Primitive& primitive : mesh.primitives)
      for (const glm::uvec3& t : primitive.triangles)
        for (int c = 0; c < 3; ++c) {
          const glm::dvec3 a(primitive.positions[t[c]]), b(primitive.positions[t[(c + 1) % 3]]);
          if (glm::length(toWorld * (b - a)) > 2.0 * leastEdge_) return true;
        }
    return false;
  }

  /// Returns the error that a part may have.
  double toleranceOf(double area) const {
    return request_.error * std::sqrt(std::max(1.0, area_ / partsOfScene / std::max(area, 1e-300)));
  }

  /// Adds the triangles of a part in the probed instances of its primitive.
  void addProbes(const DrawnMesh& drawn, const TrianglePart& part, double longest, double tolerance) {
    const int steps =
        static_cast<int>(std::clamp(std::ceil(longest / spacing_), double(leastSteps), double(mostSteps)));
    for (const FileTriangles& instance : drawn.instances[part.primitive]) {
      const std::uint32_t triangle = instance.compiled[part.root];
      if (triangle == FileTriangles::dropped) continue;
      ProbedPart probed{triangle, part.weights, steps};
      if (instance.exchanged[part.root] != 0)
        for (glm::dvec2& weights : probed.corners) std::swap(weights.x, weights.y);
      probed_.push_back(probed);
      tolerances_.push_back(tolerance);
    }
  }

  /// Probes all open parts, which are closed if their error is small enough. Returns the others, the worst
  /// first.
  std::vector<Candidate> probe(int level) {
    std::vector<Candidate> candidates;
    std::vector<std::size_t> ends;
    probed_.clear();
    tolerances_.clear();
    for (std::size_t m = 0; m < meshes_.size(); ++m) {
      std::vector<TrianglePart>& parts = meshes_[m].mesh.parts();
      for (std::size_t i = 0; i < parts.size(); ++i) {
        if (!parts[i].open) continue;
        const double longest = meshes_[m].mesh.longestEdge(parts[i]);
        if (!(longest > 2.0 * leastEdge_)) {
          parts[i].open = false;
          continue;
        }
        const double area = meshes_[m].mesh.area(parts[i]);
        candidates.push_back({m, i, area, toleranceOf(area)});
        addProbes(meshes_[m], parts[i], longest, candidates.back().tolerance);
        ends.push_back(probed_.size());
      }
    }
    const std::vector<float> errors = errorsOfProbed(level);
    std::vector<Candidate> bad;
    for (std::size_t c = 0, e = 0; c < candidates.size(); ++c) {
      TrianglePart& part = partOf(candidates[c]);
      float found = 0.0f;
      for (; e < ends[c]; ++e) found = std::max(found, errors[e]);
      // Few receivers know less than those of the larger part before.
      part.error = level == 0 ? found : std::sqrt(0.5f * (found * found + part.error * part.error));
      part.open = double(part.error) > candidates[c].tolerance;
      if (part.open) bad.push_back(candidates[c]);
    }
    std::stable_sort(bad.begin(), bad.end(), [&](const Candidate& a, const Candidate& b) {
      return std::pow(partOf(a).error, 2.0) * a.area > std::pow(partOf(b).error, 2.0) * b.area;
    });
    return bad;
  }

  /// Returns the errors of all parts in probed_.
  std::vector<float> errorsOfProbed(int level) {
    // A level takes about as long as all levels after it.
    const double begin = 1.0 - std::exp2(-level), end = 1.0 - std::exp2(-level - 1);
    const double middle = 0.5 * (begin + end);
    std::vector<float> errors;
    std::vector<std::size_t> again;
    std::vector<ProbedPart> parts;
    for (const PartError& found : quick_.errorsOf(probed_, progress_, begin, middle)) {
      const double tolerance = tolerances_[errors.size()];
      if (double(found.bound) > hardlyAny * tolerance &&
          double(found.error) <= clearlyLarge * tolerance + noiseOfQuick) {
        again.push_back(errors.size());
        parts.push_back(probed_[errors.size()]);
      }
      errors.push_back(found.error);
    }
    const std::vector<PartError> careful = careful_.errorsOf(parts, progress_, middle, end);
    for (std::size_t i = 0; i < again.size(); ++i) errors[again[i]] = careful[i].error;
    return errors;
  }

  TrianglePart& partOf(const Candidate& candidate) {
    return meshes_[candidate.mesh].mesh.parts()[candidate.part];
  }

  /// Returns the edges of the first `count` of the bad parts, and those that must be cut with them, [mesh].
  std::vector<RefinedMesh::Edges> edgesOf(const std::vector<Candidate>& bad, std::size_t count) {
    std::vector<RefinedMesh::Edges> edges(meshes_.size());
    for (std::size_t i = 0; i < count; ++i) {
      const TrianglePart& part = partOf(bad[i]);
      const bool all = double(part.error) > cutsAll * bad[i].tolerance;
      meshes_[bad[i].mesh].mesh.mark(part, all ? 2.0 * leastEdge_ : std::numeric_limits<double>::infinity(),
                                     edges[bad[i].mesh]);
    }
    for (std::size_t m = 0; m < meshes_.size(); ++m)
      if (!edges[m].empty()) meshes_[m].mesh.close(edges[m]);
    return edges;
  }

  /// Returns how many vertices there are to be added in all.
  std::uint64_t addedWith(const std::vector<RefinedMesh::Edges>& edges) const {
    std::uint64_t added = 0;
    for (std::size_t m = 0; m < meshes_.size(); ++m)
      added += (meshes_[m].mesh.addedVertices() + meshes_[m].mesh.countCuts(edges[m])) * meshes_[m].times;
    return added;
  }

  /// Cuts as many of the bad parts as there may be vertices.
  void cut(const std::vector<Candidate>& bad) {
    std::vector<RefinedMesh::Edges> edges = edgesOf(bad, bad.size());
    if (addedWith(edges) > request_.vertices) {
      report_.limited = true;
      std::size_t least = 0, most = bad.size();
      while (most - least > 1) {
        const std::size_t middle = least + (most - least) / 2;
        (addedWith(edgesOf(bad, middle)) > request_.vertices ? most : least) = middle;
      }
      edges = edgesOf(bad, least);
    }
    for (std::size_t m = 0; m < meshes_.size(); ++m)
      if (!edges[m].empty()) meshes_[m].mesh.cut(edges[m]);
  }

  /// Returns the rms error over the surface of all instances. Meshes of small triangles count as exact.
  double errorOfSurface() const {
    double squares = 0.0;
    for (const DrawnMesh& drawn : meshes_)
      for (const TrianglePart& part : drawn.mesh.parts())
        squares += drawn.share * drawn.mesh.area(part) * double(part.error) * double(part.error);
    return std::sqrt(squares / area_);
  }

  std::vector<RefinedPrimitive> finish() {
    std::vector<RefinedPrimitive> all;
    for (const DrawnMesh& drawn : meshes_)
      for (RefinedPrimitive& primitive : drawn.mesh.refined()) {
        const std::size_t roots = drawn.instances[primitive.primitive].empty()
                                      ? primitive.triangles.size()
                                      : drawn.instances[primitive.primitive].front().compiled.size();
        report_.vertices += primitive.added.size() * drawn.times;
        report_.triangles += (primitive.triangles.size() - roots) * drawn.times;
        all.push_back(std::move(primitive));
      }
    report_.primitives = all.size();
    report_.error = errorOfSurface();
    report_.leastEdge = leastEdge_;
    report_.rays = quick_.rays() + careful_.rays();
    return all;
  }

  const CompiledScene& compiled_;
  RefineRequest request_;
  Progress& progress_;
  RefineReport& report_;
  DetailProbe quick_, careful_;
  double area_ = 0.0;       ///< m2, of the scene's surface
  double spacing_ = 0.0;    ///< m, between receivers of large parts
  double leastEdge_ = 0.0;  ///< m
  std::vector<DrawnMesh> meshes_;
  std::vector<ProbedPart> probed_;
  std::vector<double> tolerances_;  ///< [probed part], error that it may have
};

}  // namespace

std::vector<RefinedPrimitive> refineMeshes(const Scene& scene, const CompiledScene& compiled, Tracer& tracer,
                                           const RefineRequest& request, Progress& progress,
                                           RefineReport& report) {
  return MeshRefiner(scene, compiled, tracer, request, progress, report).run();
}

std::string textOf(const RefineReport& report) {
  return fmt::format(
      "{} vertices and {} triangles added to {} primitive{}{}; estimated error of interpolated light {:.2g} "
      "rms "
      "over the surface, {:.2g} before; edges down to {:.2g} m, {} rays",
      report.vertices, report.triangles, report.primitives, report.primitives == 1 ? "" : "s",
      report.limited ? ", as many as are permitted" : "", report.error, report.errorBefore, report.leastEdge,
      report.rays);
}

}  // namespace prelight
