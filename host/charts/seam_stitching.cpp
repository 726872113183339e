#include "charts/seam_stitching.h"

#include <algorithm>
#include <cmath>

#include "base/kept_work.h"
#include "base/parallel.h"
#include "charts/wall_search.h"
#include "scene/surface/mesh_edges.h"

namespace prelight {

namespace {

constexpr double closeness = 0.05;   // weight of keeping a value, relative to a seam point
constexpr double angleSlack = 1e-4;  // as in surface regions
constexpr int mostRounds = 400;
constexpr double tolerance = 1e-5;  // relative residual

class SeamFinder {
 public:
  SeamFinder(const CompiledScene& scene, const LightMapLayout& layout, double creaseAngle)
      : scene_(scene), layout_(layout), creaseAngle_(creaseAngle) {}

  std::vector<SeamPoint> find() {
    forEachContinuation(scene_, [&](const EdgeSide& a, const EdgeSide& b) { meet(a, b); });
    return std::move(seams_);
  }

 private:
  void meet(const EdgeSide& a, const EdgeSide& b) {
    const glm::dvec3 n = geometricNormal(scene_, a.triangle), m = geometricNormal(scene_, b.triangle);
    if (std::atan2(glm::length(glm::cross(n, m)), glm::dot(n, m)) >= creaseAngle_ - angleSlack) return;
    addSeam(a, b, 0);
    addSeam(a, b, scene_.triangleCount());
  }

  void addSeam(const EdgeSide& a, const EdgeSide& b, std::uint32_t firstFace) {
    const std::size_t f = firstFace + a.triangle, g = firstFace + b.triangle;
    if (layout_.chartOf[f] == LightMapLayout::noChart || layout_.chartOf[g] == LightMapLayout::noChart)
      return;
    // b runs in the opposite direction.
    const glm::dvec2 p0 = corner(f, a.corner), p1 = corner(f, a.corner + 1), q0 = corner(g, b.corner + 1),
                     q1 = corner(g, b.corner);
    if (glm::distance(p0, q0) + glm::distance(p1, q1) < 1e-3) return;
    const double texels = std::max(glm::distance(p0, p1), glm::distance(q0, q1));
    const int count = std::max(2, static_cast<int>(std::ceil(2.0 * texels)));
    const auto& t = scene_.triangles[a.triangle];
    const double length = glm::distance(glm::dvec3(scene_.positions[t[a.corner]]),
                                        glm::dvec3(scene_.positions[t[(a.corner + 1) % 3]]));
    for (int i = 0; i < count; ++i) {
      const double s = (i + 0.5) / count;
      seams_.push_back(
          {lookUp(layout_, glm::mix(p0, p1, s)), lookUp(layout_, glm::mix(q0, q1, s)), length / count});
    }
  }

  glm::dvec2 corner(std::size_t face, int c) const {
    return glm::dvec2(layout_.corners[3 * face + static_cast<std::size_t>(c % 3)]);
  }

  const CompiledScene& scene_;
  const LightMapLayout& layout_;
  double creaseAngle_;
  std::vector<SeamPoint> seams_;
};

/// The normal equations of all seams: (sum of jump rows' products + closeness) change = -rows * jumps.
class SeamSolver {
 public:
  explicit SeamSolver(const std::vector<SeamPoint>& seams) {
    for (const SeamPoint& seam : seams)
      for (const LightMapLookUp* side : {&seam.first, &seam.second})
        for (std::size_t i = 0; i < 4; ++i)
          if (side->weights[i] != 0.0) texels_.push_back(side->texels[i]);
    std::sort(texels_.begin(), texels_.end());
    texels_.erase(std::unique(texels_.begin(), texels_.end()), texels_.end());
    for (const SeamPoint& seam : seams) {
      Row row;
      for (std::size_t i = 0; i < 4; ++i) {
        row.add(i, indexOf(seam.first.texels[i], seam.first.weights[i]), seam.first.weights[i]);
        row.add(4 + i, indexOf(seam.second.texels[i], seam.second.weights[i]), -seam.second.weights[i]);
      }
      rows_.push_back(row);
    }
  }

  const std::vector<std::uint32_t>& texels() const { return texels_; }

  /// Solves by conjugate gradients, starting from `values`, [texel of texels()].
  void solve(std::vector<double>& values) const {
    const std::size_t n = values.size();
    std::vector<double> right(n, 0.0), change(n, 0.0), product(n);
    for (const Row& row : rows_) row.addTimes(-row.dot(values), right);
    std::vector<double> residual = right, direction = right;
    double squared = dot(residual, residual);
    const double enough = tolerance * tolerance * squared;
    for (int round = 0; round < mostRounds && squared > enough && squared > 0.0; ++round) {
      multiply(direction, product);
      const double step = squared / dot(direction, product);
      for (std::size_t i = 0; i < n; ++i) {
        change[i] += step * direction[i];
        residual[i] -= step * product[i];
      }
      const double next = dot(residual, residual);
      for (std::size_t i = 0; i < n; ++i) direction[i] = residual[i] + next / squared * direction[i];
      squared = next;
    }
    for (std::size_t i = 0; i < n; ++i) values[i] += change[i];
  }

 private:
  struct Row {
    std::array<std::uint32_t, 8> columns{};
    std::array<double, 8> weights{};

    void add(std::size_t at, std::uint32_t column, double weight) {
      columns[at] = column;
      weights[at] = weight;
    }
    double dot(const std::vector<double>& x) const {
      double sum = 0.0;
      for (std::size_t i = 0; i < 8; ++i) sum += weights[i] * x[columns[i]];
      return sum;
    }
    void addTimes(double factor, std::vector<double>& y) const {
      for (std::size_t i = 0; i < 8; ++i) y[columns[i]] += factor * weights[i];
    }
  };

  /// Returns the index of a texel's unknown; the first one for a texel of weight 0, which has no effect.
  std::uint32_t indexOf(std::uint32_t texel, double weight) const {
    if (weight == 0.0) return 0;
    return static_cast<std::uint32_t>(std::lower_bound(texels_.begin(), texels_.end(), texel) -
                                      texels_.begin());
  }

  static double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  }

  void multiply(const std::vector<double>& x, std::vector<double>& y) const {
    for (std::size_t i = 0; i < x.size(); ++i) y[i] = closeness * x[i];
    for (const Row& row : rows_) row.addTimes(row.dot(x), y);
  }

  std::vector<std::uint32_t> texels_;  ///< texels that take part, ascending
  std::vector<Row> rows_;
};

}  // namespace

std::uint32_t nearestTexel(const LightMapLookUp& at) {
  const auto most = std::max_element(at.weights.begin(), at.weights.end());
  return at.texels[static_cast<std::size_t>(most - at.weights.begin())];
}

std::vector<SeamPoint> seamsOf(const CompiledScene& scene, Tracer& tracer, const LightMapLayout& layout,
                               double creaseAngle) {
  std::vector<SeamPoint> seams = SeamFinder(scene, layout, creaseAngle).find();
  std::vector<std::uint32_t> indexOf(layout.texelCount(), 0);
  for (std::uint32_t i = 0; i < layout.texels.size(); ++i) indexOf[layout.texels[i].texel] = i;
  std::vector<PlacePair> pairs;
  for (const SeamPoint& seam : seams)
    pairs.push_back({indexOf[nearestTexel(seam.first)], indexOf[nearestTexel(seam.second)]});
  const std::vector<Obstacle> there = lookAlong(scene, tracer, layout, layout.texels, pairs);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < seams.size(); ++i)
    if (there[i].seen) seams[kept++] = seams[i];
  seams.resize(kept);
  return seams;
}

double seamJump(const LightMap& map, const std::vector<SeamPoint>& seams) {
  double sum = 0.0, length = 0.0;
  for (const SeamPoint& seam : seams) {
    const glm::dvec3 jump = lightMapValue(map, seam.first) - lightMapValue(map, seam.second);
    sum += seam.length * glm::dot(jump, jump) / 3.0;
    length += seam.length;
  }
  return length > 0.0 ? std::sqrt(sum / length) : 0.0;
}

void stitchSeams(const std::vector<SeamPoint>& seams, LightMap& map, const Progress& progress) {
  if (seams.empty()) return;
  const SeamSolver solver(seams);
  const auto columns = static_cast<std::size_t>(3 * map.coefficients);
  const auto stitch = [&](std::size_t column) {
    std::vector<double> values;
    for (const std::uint32_t texel : solver.texels()) values.push_back(map.values[texel * columns + column]);
    solver.solve(values);
    const bool irradiance = column % static_cast<std::size_t>(map.coefficients) == 0;
    for (std::size_t i = 0; i < values.size(); ++i)
      map.values[solver.texels()[i] * columns + column] =
          static_cast<float>(irradiance ? std::max(0.0, values[i]) : values[i]);
  };
  std::uint64_t done = 0;
  WorkPart part(progress, "seams", [&](auto& state) {
    state.value(done);
    state.growing(map.values, map.values.size(), done);
    state.requireFinite(map.values);
  });
  while (done < columns) {
    progress.check();
    const std::size_t count = std::min<std::size_t>(hardwareThreads(), columns - done);
    parallelRanges(count, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) stitch(done + i);
    });
    done += count;
    part.advance();
  }
  part.finish();
}

}  // namespace prelight
