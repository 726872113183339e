#include "scene/compile/emission_parts.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <queue>
#include <tuple>

#include "base/colour.h"
#include "scene/compile/texture_means.h"
#include "scene/light_sources.h"
#include "scene/surface/image_lookup.h"

namespace prelight {

namespace {

/// Greatest number of cuts of triangles into four, over the whole scene.
constexpr std::size_t mostCuts = 4096;
constexpr int mostCutsInARow = 16;  ///< float32 represents the corners of smaller parts badly
/// A part is not cut if its brightest point exceeds its mean by at most this share of the mean.
constexpr double evenness = 0.1;
/// A part is not cut if that excess times its area is at most this share of the scene's power.
constexpr double leastUnevenness = 1.0 / 16384.0;
/// Factor of the urgency of a part when cutting its parent distinguished nothing.
constexpr double patience = 0.25;
/// Texels that outlines may cross: of parts that are still to be cut, and of all means together.
constexpr double roughOutline = 128.0, allOutlines = 1 << 21;
constexpr double blackBelow = 1e-7;  ///< share of the texture's white; below it is rounding
constexpr int coverageSamples = 12;  ///< per side of a triangle

/// The emission of a material.
struct Glow {
  TextureMeans* texture = nullptr;  ///< none: uniform emission
  bool covered = false;             ///< the material has holes or is blended
};

/// A triangle or a part of one.
struct Node {
  std::uint32_t triangle = 0;
  glm::dvec2 origin{0.0};
  double scale = 1.0;
  int cuts = 0;
  double area = 0.0;  ///< m2
  glm::dvec3 color{0.0};
  double most = 0.0;     ///< bound of the luminance of all points
  double factor = 0.0;   ///< luminance of the material's factor
  double urgency = 1.0;  ///< priority of its cut
  std::int64_t children = -1;

  double unevenness() const { return area * factor * (most - luminance(color)); }
  bool isEven() const { return most <= (1.0 + evenness) * luminance(color); }
};

class TriangleCutter {
 public:
  TriangleCutter(const CompiledScene& scene, const std::vector<Image>& images)
      : scene_(scene), images_(images) {
    for (const CompiledMaterial& m : scene.materials) glows_.push_back(glowOf(m));
  }

  EmissionParts run() {
    EmissionParts parts;
    const bool uneven = std::any_of(scene_.triangleMaterials.begin(), scene_.triangleMaterials.end(),
                                    [&](std::uint32_t m) { return isUneven(m); });
    if (!uneven) return parts;
    addTriangles();
    cut();
    return listParts();
  }

 private:
  Glow glowOf(const CompiledMaterial& m) {
    Glow glow;
    if (!shines(m.emission)) return glow;
    glow.covered = m.alphaCutoff >= 0.0f;
    const TextureRef& use = m.emissionTexture;
    if (use.image < 0) return glow;
    const Image& image = images_[static_cast<std::size_t>(use.image)];
    const auto key = std::tuple(use.image, use.wrapS, use.wrapT, use.filter);
    std::unique_ptr<TextureMeans>& means = means_[key];
    if (!means) means = std::make_unique<TextureMeans>(image, use);
    glow.texture = means.get();
    return glow;
  }

  bool isUneven(std::uint32_t material) const {
    return shines(scene_.materials[material].emission) &&
           (glows_[material].texture != nullptr || glows_[material].covered);
  }

  const CompiledMaterial& materialOf(const Node& node) const {
    return scene_.materials[scene_.triangleMaterials[node.triangle]];
  }

  /// Returns the weights of the triangle's vertices 1 and 2 for those of the part's own corners.
  static glm::dvec2 within(const Node& node, const glm::dvec2& weights) {
    return node.origin + node.scale * weights;
  }

  glm::dvec2 imagePlace(const TextureRef& use, std::uint32_t triangle, const glm::dvec2& weights) const {
    const std::vector<glm::vec2>& coords = use.texCoord == 1 ? scene_.texCoords1 : scene_.texCoords;
    const glm::uvec3& v = scene_.triangles[triangle];
    if (coords.empty()) return glm::dvec2(glm::vec2(use.transform * glm::vec3(0.0f, 0.0f, 1.0f)));
    const glm::dvec2 at = (1.0 - weights.x - weights.y) * glm::dvec2(coords[v.x]) +
                          weights.x * glm::dvec2(coords[v.y]) + weights.y * glm::dvec2(coords[v.z]);
    return glm::dvec2(glm::dmat3(use.transform) * glm::dvec3(at, 1.0));
  }

  ImageCorners cornersOf(const TextureRef& use, const Node& node) const {
    return {imagePlace(use, node.triangle, within(node, {0.0, 0.0})),
            imagePlace(use, node.triangle, within(node, {1.0, 0.0})),
            imagePlace(use, node.triangle, within(node, {0.0, 1.0}))};
  }

  /// Returns the coverage of the surface at a point.
  double coverageAt(const CompiledMaterial& m, std::uint32_t triangle, const glm::dvec2& weights) const {
    double alpha = m.alphaFactor;
    const TextureRef& use = m.baseColorTexture;
    if (use.image >= 0)
      alpha *= sampleImage(images_[static_cast<std::size_t>(use.image)], use,
                           glm::vec2(imagePlace(use, triangle, weights)))
                   .a;
    if (scene_.hasVertexColors()) {
      const glm::uvec3& v = scene_.triangles[triangle];
      alpha *= (1.0 - weights.x - weights.y) * scene_.colors[v.x].a + weights.x * scene_.colors[v.y].a +
               weights.y * scene_.colors[v.z].a;
    }
    return m.blended ? std::clamp(alpha, 0.0, 1.0) : (alpha >= m.alphaCutoff ? 1.0 : 0.0);
  }

  /// Returns the mean over the centres of equal parts: a product of textures with a cutoff has no closed
  /// form.
  glm::dvec3 coveredMean(const Node& node, const Glow& glow) const {
    const CompiledMaterial& m = materialOf(node);
    glm::dvec3 sum(0.0);
    constexpr int n = coverageSamples;
    for (int row = 0; row < n; ++row)
      for (int k = 0; k < 2 * (n - row) - 1; ++k) {
        const double third = k % 2 == 0 ? 1.0 / 3.0 : 2.0 / 3.0;
        const glm::dvec2 place = within(node, {(k / 2 + third) / n, (row + third) / n});
        const double coverage = coverageAt(m, node.triangle, place);
        if (coverage == 0.0) continue;
        const glm::dvec3 color = glow.texture == nullptr
                                     ? glm::dvec3(1.0)
                                     : glow.texture->at(imagePlace(m.emissionTexture, node.triangle, place));
        sum += coverage * color;
      }
    return sum / double(n * n);
  }

  /// Computes the brightness of a node. `outline`: as in TextureMeans::mean().
  void look(Node& node, double outline) const {
    const CompiledMaterial& m = materialOf(node);
    const Glow& glow = glows_[scene_.triangleMaterials[node.triangle]];
    node.factor = luminance(glm::dvec3(m.emission));
    node.color = glm::dvec3(1.0);
    node.most = 1.0;
    if (glow.texture != nullptr) {
      const ImageCorners corners = cornersOf(m.emissionTexture, node);
      node.most = glow.texture->mostLuminance(corners);
      node.color = node.most > 0.0 && !glow.covered ? glow.texture->mean(corners, outline) : glm::dvec3(0.0);
    }
    if (glow.covered && node.most > 0.0) node.color = coveredMean(node, glow);
    if (std::max({node.color.x, node.color.y, node.color.z}) < blackBelow) node.color = glm::dvec3(0.0);
  }

  bool isBlack(const Node& node) const {
    return node.color == glm::dvec3(0.0) && !(mayHide(node) && node.most > 0.0 && node.cuts < 4);
  }

  /// Returns true when samples of coverage may miss visible texels.
  bool mayHide(const Node& node) const { return glows_[scene_.triangleMaterials[node.triangle]].covered; }

  void addTriangles() {
    roots_.assign(scene_.triangleCount(), -1);
    for (std::uint32_t t = 0; t < scene_.triangleCount(); ++t) {
      Node node;
      node.triangle = t;
      if (!shines(materialOf(node).emission)) continue;
      node.area = 0.5 * glm::length(geometricNormal(scene_, t));
      look(node, roughOutline);
      power_ += node.area * node.factor * luminance(node.color);
      if (isBlack(node)) continue;
      roots_[t] = static_cast<std::int64_t>(nodes_.size());
      nodes_.push_back(node);
    }
  }

  /// Returns the four parts of a node: those at its corners, then the central one, which is rotated by half a
  /// turn.
  std::array<Node, 4> partsOf(const Node& node) const {
    std::array<Node, 4> parts;
    const std::array<glm::dvec2, 4> origins = {glm::dvec2(0.0, 0.0), {0.5, 0.0}, {0.0, 0.5}, {0.5, 0.5}};
    for (std::size_t k = 0; k < 4; ++k) {
      Node& part = parts[k];
      part.triangle = node.triangle;
      part.origin = within(node, origins[k]);
      part.scale = (k == 3 ? -0.5 : 0.5) * node.scale;
      part.area = 0.25 * node.area;
      part.cuts = node.cuts + 1;
      part.urgency = node.urgency;
      look(part, roughOutline);
    }
    return parts;
  }

  double priority(const Node& node) const { return node.urgency * node.unevenness(); }

  void cut() {
    using Entry = std::pair<double, std::int64_t>;  // equal ones in the order of their numbers
    std::priority_queue<Entry> queue;
    const auto enqueue = [&](std::size_t i) {
      const Node& node = nodes_[i];
      if (node.cuts < mostCutsInARow && !node.isEven() && priority(node) > leastUnevenness * power_)
        queue.push({priority(node), -static_cast<std::int64_t>(i)});
    };
    for (std::size_t i = 0; i < nodes_.size(); ++i) enqueue(i);
    for (std::size_t cuts = 0; cuts < mostCuts && !queue.empty(); ++cuts) {
      const auto at = static_cast<std::size_t>(-queue.top().second);
      queue.pop();
      std::array<Node, 4> parts = partsOf(nodes_[at]);
      double unevenness = 0.0;
      for (const Node& part : parts) unevenness += isBlack(part) ? 0.0 : part.unevenness();
      const bool told = unevenness < 0.9 * nodes_[at].unevenness();
      nodes_[at].children = static_cast<std::int64_t>(nodes_.size());
      for (Node& part : parts) {
        part.urgency = told ? 1.0 : patience * part.urgency;
        nodes_.push_back(part);
        if (!isBlack(part)) enqueue(nodes_.size() - 1);
      }
    }
  }

  /// Adds a node and its parts; returns the reference to it.
  std::uint32_t add(const Node& node, double outline, EmissionParts& parts) const {
    if (node.children >= 0) {
      const std::size_t at = parts.nodes.size();
      parts.nodes.emplace_back();
      for (std::size_t k = 0; k < 4; ++k) {
        const std::uint32_t child = add(nodes_[static_cast<std::size_t>(node.children) + k], outline, parts);
        parts.nodes[at][k] = child;
      }
      return static_cast<std::uint32_t>(at);
    }
    Node exact = node;
    if (!isBlack(node)) look(exact, outline);
    if (exact.color == glm::dvec3(0.0)) return EmissionParts::dark;
    parts.parts.push_back({glm::vec2(node.origin), static_cast<float>(node.scale), glm::vec3(exact.color)});
    return EmissionParts::leaf | static_cast<std::uint32_t>(parts.parts.size() - 1);
  }

  EmissionParts listParts() const {
    EmissionParts parts;
    const double outline =
        std::clamp(allOutlines / static_cast<double>(std::max<std::size_t>(1, nodes_.size())), roughOutline,
                   TextureMeans::exactOutline);
    parts.roots.assign(scene_.triangleCount(), EmissionParts::dark);
    for (std::uint32_t t = 0; t < scene_.triangleCount(); ++t)
      if (roots_[t] >= 0) parts.roots[t] = add(nodes_[static_cast<std::size_t>(roots_[t])], outline, parts);
    return parts;
  }

  const CompiledScene& scene_;
  const std::vector<Image>& images_;
  std::map<std::tuple<int, WrapMode, WrapMode, TextureFilter>, std::unique_ptr<TextureMeans>> means_;
  std::vector<Glow> glows_;          ///< [material]
  std::vector<std::int64_t> roots_;  ///< [triangle], -1: it emits nothing
  std::vector<Node> nodes_;
  double power_ = 0.0;  ///< power of the scene, m2 times luminance
};

}  // namespace

namespace {

/// Returns the mean colour of the parts of a primitive's triangles.
glm::vec3 meanColor(const EmissionParts& parts, const CompiledScene& scene, const PrimitiveRange& range) {
  glm::dvec3 sum(0.0);
  double area = 0.0;
  for (std::uint32_t t = range.firstTriangle; t < range.firstTriangle + range.triangleCount; ++t) {
    const double own = glm::length(geometricNormal(scene, t));
    area += own;
    forEachPart(parts, parts.roots[t], [&](std::uint32_t index) {
      const EmissionParts::Part& part = parts.parts[index];
      sum += double(part.scale) * double(part.scale) * own * glm::dvec3(part.color);
    });
  }
  return area > 0.0 ? glm::vec3(sum / area) : glm::vec3(0.0f);
}

}  // namespace

EmissionParts followEmission(EmissionParts parts, const CompiledScene& before, const CompiledScene& now) {
  if (parts.roots.empty() || before.triangleMaterials == now.triangleMaterials) return parts;
  const std::vector<std::uint32_t> roots = parts.roots;
  EmissionParts moved = parts;
  moved.roots.assign(now.triangleCount(), EmissionParts::dark);
  for (std::size_t p = 0; p < now.primitives.size(); ++p) {
    const PrimitiveRange &from = before.primitives[p], &to = now.primitives[p];
    if (from.triangleCount == to.triangleCount) {
      std::copy_n(roots.begin() + from.firstTriangle, from.triangleCount,
                  moved.roots.begin() + to.firstTriangle);
      continue;
    }
    const glm::vec3 mean = meanColor(parts, before, from);
    if (!shines(mean)) continue;
    std::fill_n(moved.roots.begin() + to.firstTriangle, to.triangleCount,
                EmissionParts::leaf | static_cast<std::uint32_t>(moved.parts.size()));
    moved.parts.push_back({glm::vec2(0.0f), 1.0f, mean});
  }
  return moved;
}

EmissionParts findEmissionParts(const CompiledScene& compiled, const std::vector<Image>& images) {
  return TriangleCutter(compiled, images).run();
}

}  // namespace prelight
