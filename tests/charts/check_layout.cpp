#include "charts/check_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace prelight::test {

namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

class LayoutChecker {
 public:
  LayoutChecker(const CompiledScene& scene, const LightMapLayout& layout, const std::string& name)
      : scene_(scene), layout_(layout), name_(name), texelAt_(layout.texelCount(), -1) {}

  void checkCorners() const {
    ASSERT_EQ(layout_.chartOf.size(), 2u * scene_.triangleCount()) << name_;
    ASSERT_EQ(layout_.corners.size(), 3 * layout_.chartOf.size()) << name_;
    for (std::size_t f = 0; f < layout_.chartOf.size(); ++f) {
      if (layout_.chartOf[f] == LightMapLayout::noChart) continue;
      ASSERT_LT(layout_.chartOf[f], layout_.chartCount);
      for (int c = 0; c < 3; ++c) {
        const glm::vec2 p = corner(f, c);
        ASSERT_TRUE(p.x >= 0.5f && p.y >= 0.5f && p.x <= float(layout_.width) - 0.5f &&
                    p.y <= float(layout_.height) - 0.5f)
            << name_ << ": face " << f << " at " << p.x << ", " << p.y;
      }
    }
  }

  void checkTexels() {
    const auto faces = static_cast<std::uint32_t>(layout_.chartOf.size());
    for (std::size_t i = 0; i < layout_.texels.size(); ++i) {
      const LightMapTexel& texel = layout_.texels[i];
      ASSERT_TRUE(i == 0 || layout_.texels[i - 1].texel < texel.texel) << name_;
      ASSERT_LT(texel.texel, layout_.texelCount()) << name_;
      ASSERT_LT(texel.face, faces) << name_;
      ASSERT_NE(layout_.chartOf[texel.face], LightMapLayout::noChart) << name_;
      ASSERT_TRUE(texel.b1 >= 0.0f && texel.b2 >= 0.0f && texel.b1 + texel.b2 <= 1.0f) << name_;
      texelAt_[texel.texel] = static_cast<std::int64_t>(i);
    }
  }

  /// Look-ups at random points of faces meet texels of the face's own chart.
  void checkLookUps() const {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const std::size_t stride = std::max<std::size_t>(1, layout_.chartOf.size() / 20000);
    for (std::size_t f = 0; f < layout_.chartOf.size(); f += stride) {
      if (layout_.chartOf[f] == LightMapLayout::noChart) continue;
      for (int k = 0; k < 8; ++k) {
        const double s = std::sqrt(uniform(random)), b1 = s * (1.0 - uniform(random)), b2 = s - b1;
        // Corners are tested too: there a chart comes nearest to others.
        const glm::dvec2 p = k < 3 ? glm::dvec2(corner(f, k)) : at(f, b1, b2);
        const glm::dvec2 low = glm::floor(p - 0.5), share = p - 0.5 - low;
        for (int i = 0; i < 4; ++i) {
          const double weight = (i % 2 ? share.x : 1.0 - share.x) * (i / 2 ? share.y : 1.0 - share.y);
          if (weight < 1e-3) continue;
          const auto x = static_cast<std::int64_t>(low.x) + i % 2,
                     y = static_cast<std::int64_t>(low.y) + i / 2;
          ASSERT_TRUE(x >= 0 && y >= 0 && x < layout_.width && y < layout_.height) << name_;
          const std::int64_t found = texelAt_[static_cast<std::size_t>(y * layout_.width + x)];
          ASSERT_GE(found, 0) << name_ << ": face " << f << " meets texel " << x << ", " << y
                              << " without a place, at " << p.x << ", " << p.y;
          ASSERT_EQ(layout_.chartOf[layout_.texels[static_cast<std::size_t>(found)].face], layout_.chartOf[f])
              << name_ << ": face " << f << " meets a texel of another chart";
        }
      }
    }
  }

  /// No face of a texel's chart is closer to the texel's centre than the texel's place is.
  void checkPlaces() const {
    std::vector<std::vector<std::uint32_t>> facesOf(layout_.chartCount);
    for (std::uint32_t f = 0; f < layout_.chartOf.size(); ++f)
      if (layout_.chartOf[f] != LightMapLayout::noChart) facesOf[layout_.chartOf[f]].push_back(f);
    const std::size_t stride = std::max<std::size_t>(1, layout_.texels.size() / 500);
    for (std::size_t i = 0; i < layout_.texels.size(); i += stride) {
      const LightMapTexel& texel = layout_.texels[i];
      const auto width = static_cast<std::uint32_t>(layout_.width);
      const glm::dvec2 centre(texel.texel % width + 0.5, texel.texel / width + 0.5);
      const double own = glm::distance(at(texel.face, texel.b1, texel.b2), centre);
      double nearest = own;
      for (const std::uint32_t f : facesOf[layout_.chartOf[texel.face]])
        nearest = std::min(nearest, distanceTo(f, centre));
      // Farther away, a nearer face may lie beside the square in which look-ups meet the texel.
      if (nearest < 1.0) {
        ASSERT_LE(own, nearest + keptOff(texel.face))
            << name_ << ": texel " << texel.texel << " of face " << texel.face;
      }
      ASSERT_LE(own, 1.5 + keptOff(texel.face)) << name_;
    }
  }

  LayoutFigures figures(double texelSize) const {
    LayoutFigures result;
    result.used = double(layout_.texels.size()) / double(std::max<std::size_t>(1, layout_.texelCount()));
    std::vector<glm::vec2> low(layout_.chartCount, glm::vec2(1e9f)),
        high(layout_.chartCount, glm::vec2(-1e9f));
    for (std::size_t f = 0; f < layout_.chartOf.size(); ++f) {
      if (layout_.chartOf[f] == LightMapLayout::noChart) continue;
      for (int c = 0; c < 3; ++c) {
        low[layout_.chartOf[f]] = glm::min(low[layout_.chartOf[f]], corner(f, c));
        high[layout_.chartOf[f]] = glm::max(high[layout_.chartOf[f]], corner(f, c));
      }
    }
    double all = 0.0, stretched = 0.0;
    for (std::size_t f = 0; f < layout_.chartOf.size(); ++f) {
      const std::uint32_t chart = layout_.chartOf[f];
      if (chart == LightMapLayout::noChart) continue;
      const double area =
          0.5 * glm::length(geometricNormal(scene_, static_cast<std::uint32_t>(f % scene_.triangleCount())));
      const double texels = 0.5 * std::abs(cross(glm::dvec2(corner(f, 1) - corner(f, 0)),
                                                 glm::dvec2(corner(f, 2) - corner(f, 0))));
      const double ratio = texels * texelSize * texelSize / area;
      all += area;
      if (ratio < 0.5 || ratio > 2.0) stretched += area;
      const glm::vec2 size = high[chart] - low[chart];
      if (std::min(size.x, size.y) < 4.0f || texels < 0.5) continue;
      result.leastRatio = std::min(result.leastRatio, ratio);
      result.mostRatio = std::max(result.mostRatio, ratio);
    }
    result.stretched = stretched / std::max(all, 1e-300);
    return result;
  }

 private:
  glm::vec2 corner(std::size_t face, int c) const {
    return layout_.corners[3 * face + static_cast<std::size_t>(c)];
  }

  glm::dvec2 at(std::size_t face, double b1, double b2) const {
    return (1.0 - b1 - b2) * glm::dvec2(corner(face, 0)) + b1 * glm::dvec2(corner(face, 1)) +
           b2 * glm::dvec2(corner(face, 2));
  }

  /// How far keptOffEdges may move a place at most, in texels.
  double keptOff(std::size_t face) const {
    double longest = 0.0;
    for (int c = 0; c < 3; ++c)
      longest = std::max(longest, double(glm::distance(corner(face, c), corner(face, (c + 1) % 3))));
    const double area =
        glm::length(geometricNormal(scene_, static_cast<std::uint32_t>(face % scene_.triangleCount())));
    const auto& t = scene_.triangles[face % scene_.triangleCount()];
    double side = 0.0, largest = 0.0;
    for (int c = 0; c < 3; ++c) {
      side = std::max(side, double(glm::distance(scene_.positions[t[c]], scene_.positions[t[(c + 1) % 3]])));
      for (int a = 0; a < 3; ++a) largest = std::max(largest, double(std::abs(scene_.positions[t[c]][a])));
    }
    // Places move by a thousandth of the way to the centroid, and by more where the triangle is nearly as
    // thin as rounding errors.
    return 1e-3 + std::min(1.0, 1e-3 + 1e-5 * largest * side / area) * longest;
  }

  double distanceTo(std::size_t face, const glm::dvec2& p) const {
    const glm::dvec2 a(corner(face, 0)), b(corner(face, 1)), c(corner(face, 2));
    const double area = cross(b - a, c - a);
    if (std::abs(area) > 1e-9) {
      const double second = cross(p - a, c - a) / area, third = cross(b - a, p - a) / area;
      if (std::min({second, third, 1.0 - second - third}) >= 0.0) return 0.0;
    }
    double best = 1e30;
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      const glm::dvec2 edge = to - from;
      const double s = std::clamp(glm::dot(p - from, edge) / std::max(glm::dot(edge, edge), 1e-30), 0.0, 1.0);
      best = std::min(best, glm::distance(p, from + s * edge));
    }
    return best;
  }

  const CompiledScene& scene_;
  const LightMapLayout& layout_;
  const std::string& name_;
  std::vector<std::int64_t> texelAt_;  ///< [texel], an index into layout.texels, or -1.
};

}  // namespace

LayoutFigures checkLayout(const CompiledScene& scene, const LightMapLayout& layout, double texelSize,
                          const std::string& name) {
  LayoutChecker checker(scene, layout, name);
  checker.checkCorners();
  if (::testing::Test::HasFatalFailure()) return {};
  checker.checkTexels();
  if (::testing::Test::HasFatalFailure()) return {};
  checker.checkLookUps();
  checker.checkPlaces();
  return checker.figures(texelSize);
}

}  // namespace prelight::test
