#include "relight/neighbourhood.h"

#include <algorithm>
#include <cmath>

#include "base/colour.h"
#include "base/parallel.h"
#include "basis/sh_evaluate.h"
#include "basis/sh_zonal.h"
#include "occluders/rigid_motion.h"
#include "relight/vertex_lights.h"
#include "scene/surface/image_lookup.h"

namespace prelight {

namespace {

/// Positions of planes: within the object relative to its half extent, and beyond it in radii of its ball.
constexpr std::array<double, 2> sharesWithin = {0.4, 0.8};
constexpr std::array<double, 8> beyond = {0.03, 0.18, 0.4, 0.75, 1.3, 2.2, 3.8, 6.5};

std::vector<double> planesOf(double half, double radius) {
  std::vector<double> above;
  for (const double share : sharesWithin) above.push_back(share * half);
  for (const double more : beyond) above.push_back(half + more * radius);
  std::vector<double> planes;
  for (auto plane = above.rbegin(); plane != above.rend(); ++plane) planes.push_back(-*plane);
  planes.push_back(0.0);
  planes.insert(planes.end(), above.begin(), above.end());
  return planes;
}

}  // namespace

NeighbourhoodGrid::NeighbourhoodGrid(const glm::dvec3& centre, const glm::dvec3& halves, double radius)
    : centre_(centre) {
  // Flat objects have planes within them, too.
  for (int a = 0; a < 3; ++a)
    planes_[static_cast<std::size_t>(a)] = planesOf(std::max(halves[a], 0.01 * radius), radius);
}

std::size_t NeighbourhoodGrid::count() const {
  return planes_[0].size() * planes_[1].size() * planes_[2].size();
}

glm::dvec3 NeighbourhoodGrid::placeOf(std::size_t index) const {
  const std::size_t x = planes_[0].size(), y = planes_[1].size();
  return centre_ + glm::dvec3(planes_[0][index % x], planes_[1][index / x % y], planes_[2][index / (x * y)]);
}

std::array<NeighbourhoodGrid::Corner, 8> NeighbourhoodGrid::cornersAt(const glm::dvec3& point) const {
  glm::dvec3 from = point - centre_;
  double shrink = 1.0;
  for (std::size_t a = 0; a < 3; ++a)
    shrink = std::min(shrink, planes_[a].back() / std::max(std::abs(from[static_cast<int>(a)]), 1e-300));
  from *= shrink;
  std::array<std::size_t, 3> first{};
  std::array<double, 3> share{};
  for (std::size_t a = 0; a < 3; ++a) {
    const std::vector<double>& planes = planes_[a];
    const double at = from[static_cast<int>(a)];
    const auto next = std::upper_bound(planes.begin() + 1, planes.end() - 1, at);
    first[a] = static_cast<std::size_t>(next - planes.begin()) - 1;
    share[a] = std::clamp((at - *(next - 1)) / (*next - *(next - 1)), 0.0, 1.0);
  }
  std::array<Corner, 8> corners;
  for (std::size_t k = 0; k < 8; ++k) {
    Corner& corner = corners[k];
    corner.weight = 1.0;
    for (std::size_t a = 3; a-- > 0;) {
      const std::size_t step = k >> a & 1;
      corner.weight *= step == 1 ? share[a] : 1.0 - share[a];
      corner.place = corner.place * planes_[a].size() + first[a] + step;
    }
  }
  return corners;
}

namespace {

using namespace device;

constexpr std::uint32_t raysAPlace = 256;
constexpr std::size_t placesAtOnce = 256, placeGrain = 8, neighbourGrain = 128;
/// Root of 4 pi: first coefficient of a uniform sky of radiance 1.
constexpr double evenSky = 3.5449077018110318;
constexpr double mostBacks = 0.5;  ///< largest share of back hits at a place outside the object

glm::dvec3 halvesOf(const CompiledScene& scene, const VertexRange& range) {
  const ObjectBounds bounds = boundsOf(scene, range);
  return 0.5 * glm::dvec3(bounds.upper - bounds.lower);
}

glm::dvec3 weightsOf(const Hit& hit) { return {1.0 - double{hit.u} - double{hit.v}, hit.u, hit.v}; }

bool isBack(const CompiledScene& scene, const Hit& hit, const glm::dvec3& way) {
  const glm::uvec3& v = scene.triangles[hit.triangle];
  const glm::dvec3 a(scene.positions[v.x]), b(scene.positions[v.y]), c(scene.positions[v.z]);
  return glm::dot(glm::cross(b - a, c - a), way) > 0.0 &&
         !scene.materials[scene.triangleMaterials[hit.triangle]].doubleSided;
}

glm::dvec3 albedoOf(const CompiledScene& scene, const Hit& hit) {
  const CompiledMaterial& material = scene.materials[scene.triangleMaterials[hit.triangle]];
  const TextureRef& texture = material.baseColorTexture;
  glm::dvec3 albedo(material.albedo);
  if (texture.image < 0 || scene.images[static_cast<std::size_t>(texture.image)].rgba.empty()) return albedo;
  const std::vector<glm::vec2>& set = texture.texCoord == 1 ? scene.texCoords1 : scene.texCoords;
  const glm::uvec3& v = scene.triangles[hit.triangle];
  const glm::dvec3 w = weightsOf(hit);
  const glm::vec2 uv(w.x * glm::dvec2(set[v.x]) + w.y * glm::dvec2(set[v.y]) + w.z * glm::dvec2(set[v.z]));
  const glm::vec4 texel = sampleImage(scene.images[static_cast<std::size_t>(texture.image)], texture,
                                      glm::vec2(texture.transform * glm::vec3(uv, 1.0f)));
  for (int c = 0; c < 3; ++c) albedo[c] *= linearOfSrgb(double(texel[c]));
  return albedo;
}

bool reflects(const CompiledScene& scene, const VertexRange& range) {
  for (std::uint32_t t = range.firstTriangle; t < range.firstTriangle + range.triangleCount; ++t)
    if (scene.materials[scene.triangleMaterials[t]].albedo != glm::vec3(0.0f)) return true;
  return false;
}

}  // namespace

Neighbourhood::Neighbourhood(const CompiledScene& scene, const VertexRange& range,
                             const HarmonicTransfer& own, const Tracer& whole, int order)
    : range_(range),
      order_(std::min({order, own.order, mostOrder})),
      columns_(static_cast<std::size_t>(order_ * order_)),
      rest_(scene.positions.begin() + range.firstVertex,
            scene.positions.begin() + range.firstVertex + range.vertexCount),
      around_(ballAroundObject(scene, range)),
      grid_(around_.centre, halvesOf(scene, range), around_.radius),
      inside_(grid_.count(), 0),
      parts_(reflects(scene, range) ? 4 : 1),
      matrices_(grid_.count() * parts_ * size(), 0.0f),
      there_(order_, glm::dmat3(1.0)),
      back_(order_, glm::dmat3(1.0)) {
  Tracer alone(whole, scene, trianglesOf(range));
  cast(scene, own, alone);
}

void Neighbourhood::cast(const CompiledScene& scene, const HarmonicTransfer& own, Tracer& alone) {
  for (std::size_t first = 0; first < grid_.count(); first += placesAtOnce) {
    const std::size_t count = std::min(placesAtOnce, grid_.count() - first);
    std::vector<Ray> rays;
    for (std::size_t place = first; place < first + count; ++place) {
      const std::vector<Ray> some =
          raysAtBall(around_, grid_.placeOf(place), raysAPlace, static_cast<std::uint32_t>(place));
      rays.insert(rays.end(), some.begin(), some.end());
    }
    const std::vector<Hit> hits = alone.traceClosest(std::span<const Ray>(rays));
    parallelRanges(count, placeGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k)
        addPlace(scene, own, first + k, std::span(rays).subspan(k * raysAPlace, raysAPlace),
                 std::span(hits).subspan(k * raysAPlace, raysAPlace));
    });
  }
}

/// Returns the factor by which matrices are stored to make them similar at all distances: the object covers
/// less from farther away, and for a disk in front of its centre exactly by this factor.
double Neighbourhood::nearness(const glm::dvec3& point) const {
  const glm::dvec3 way = point - around_.centre;
  return 1.0 + glm::dot(way, way) / (around_.radius * around_.radius);
}

void Neighbourhood::addPlace(const CompiledScene& scene, const HarmonicTransfer& own, std::size_t place,
                             std::span<const Ray> rays, std::span<const Hit> hits) {
  const glm::dvec3 at = grid_.placeOf(place);
  const double weight = coneTowards(around_, at).solidAngle() / double{raysAPlace} * nearness(at);
  const std::span<float> matrices = std::span(matrices_).subspan(place * parts_ * size(), parts_ * size());
  std::vector<double> values(columns_);
  double met = 0.0, backs = 0.0;
  for (std::size_t r = 0; r < rays.size(); ++r) {
    if (hits[r].triangle == PRELIGHT_NO_TRIANGLE) continue;
    const glm::dvec3 way = glm::normalize(wayOf(rays[r]));
    met += 1.0;
    if (isBack(scene, hits[r], way)) backs += 1.0;
    sh::evaluate(way, order_, values);
    for (std::size_t i = 0; i < columns_; ++i)
      for (std::size_t j = 0; j < columns_; ++j)
        matrices[i * columns_ + j] += static_cast<float>(weight * values[i] * values[j]);
    if (parts_ > 1) addSent(scene, own, hits[r], weight, values, matrices.subspan(size()));
  }
  // From within a closed object nothing is open; one-sided sheets are also seen from behind.
  const bool isClosed = met == static_cast<double>(rays.size()) && coneTowards(around_, at).cosine < 0.0;
  inside_[place] = isClosed && backs > mostBacks * met ? 1 : 0;
}

void Neighbourhood::addSent(const CompiledScene& scene, const HarmonicTransfer& own, const Hit& hit,
                            double weight, std::span<const double> values, std::span<float> sent) const {
  const glm::dvec3 albedo = albedoOf(scene, hit), shares = weightsOf(hit);
  const auto ownColumns = static_cast<std::size_t>(own.order * own.order);
  const auto channels = static_cast<std::size_t>(own.channels);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t j = 0; j < columns_; ++j) {
      double received = 0.0;
      for (int k = 0; k < 3; ++k) {
        const std::size_t v = scene.triangles[hit.triangle][k] - range_.firstVertex;
        const std::size_t row = v * channels + std::min(c, channels - 1);
        received += shares[k] * double(own.coefficients[row * ownColumns + j]);
      }
      const double radiance = weight * albedo[static_cast<int>(c)] * received;
      for (std::size_t i = 0; i < columns_; ++i)
        sent[(c * columns_ + i) * columns_ + j] += static_cast<float>(radiance * values[i]);
    }
}

void Neighbourhood::follow(const CompiledScene& scene) {
  motion_ =
      fitMotion(rest_, std::span(scene.positions).subspan(range_.firstVertex, range_.vertexCount)).motion;
  there_ = sh::ShRotation(order_, motion_.rotation);
  back_ = sh::ShRotation(order_, glm::transpose(motion_.rotation));
}

/// Returns the corners without places inside the object, with weights rescaled.
Neighbourhood::Corners Neighbourhood::cornersAt(const glm::dvec3& point) const {
  Corners corners = grid_.cornersAt(point);
  double sum = 0.0;
  for (NeighbourhoodGrid::Corner& corner : corners) {
    if (inside_[corner.place] != 0) corner.weight = 0.0;
    sum += corner.weight;
  }
  for (NeighbourhoodGrid::Corner& corner : corners) corner.weight = sum > 0.0 ? corner.weight / sum : 0.125;
  return corners;
}

/// Returns interpolated matrices, [part][i][j].
std::span<const float> Neighbourhood::matricesAt(const glm::dvec3& point,
                                                 std::vector<float>& matrices) const {
  const std::size_t length = parts_ * size();
  matrices.assign(length, 0.0f);
  const double scale = 1.0 / nearness(point);
  for (const NeighbourhoodGrid::Corner& corner : cornersAt(point)) {
    const auto weight = static_cast<float>(corner.weight * scale);
    const float* from = &matrices_[corner.place * length];
    for (std::size_t k = 0; k < length; ++k) matrices[k] += weight * from[k];
  }
  return matrices;
}

void Neighbourhood::change(const glm::dvec3& point, const glm::dvec3& normal, std::span<const double> direct,
                           Change& change) const {
  const std::span<const float> matrices = matricesAt(motion_.pointBefore(point), change.work);
  std::vector<double> received(columns_), open(columns_), all(parts_ * columns_, 0.0);
  back_.apply(direct, received);
  sh::openTransfer(glm::transpose(motion_.rotation) * normal, order_, open);
  change.factor = 0.0;
  for (std::size_t i = 0; i < columns_; ++i)
    change.factor += evenSky * open[i] * double(matrices[i * columns_]);
  for (std::size_t part = 0; part < parts_; ++part)
    for (std::size_t i = 0; i < columns_; ++i)
      for (std::size_t j = 0; j < columns_; ++j)
        all[part * columns_ + j] += received[i] * double(matrices[(part * columns_ + i) * columns_ + j]);
  there_.apply(all, all);
  const auto end = all.begin() + static_cast<std::ptrdiff_t>(columns_);
  change.hidden.assign(all.begin(), end);
  change.sent.assign(end, all.end());
}

namespace {

/// Adds the effect of an object to a vertex that sees it.
void addChange(const Neighbourhood::Change& change, std::span<const float> direct, std::size_t vertex,
               bool isSeen, ObjectShadow& shadow) {
  const std::size_t bands = direct.size(), known = change.hidden.size();
  const double factor = isSeen ? std::clamp(change.factor, 0.0, 1.0) : 0.0;
  const double sky = evenSky * change.hidden[0];
  shadow.hidden[vertex] += static_cast<float>(factor);
  shadow.surfaces[vertex] += static_cast<float>(std::clamp(factor - sky, 0.0, 1.0));
  // Bands that the matrices lack are reduced by the share of the first band.
  const double share = direct[0] > 0.0f ? std::clamp(change.hidden[0] / double(direct[0]), 0.0, 1.0) : 0.0;
  for (std::size_t i = 0; i < bands; ++i)
    shadow.sky[vertex * bands + i] +=
        static_cast<float>(i < known ? change.hidden[i] : share * double(direct[i]));
  for (std::size_t c = 0; c < 3 && !change.sent.empty(); ++c)
    for (std::size_t i = 0; i < known; ++i)
      shadow.sent[(3 * vertex + c) * bands + i] += static_cast<float>(change.sent[c * known + i]);
}

/// Vertices that an object may affect, and the hits of rays through the scene without objects to its centre.
struct Neighbours {
  std::vector<std::uint32_t> vertices;
  std::vector<Hit> hits;
};

Neighbours neighboursOf(const CompiledScene& scene, const VertexRange& baked, const ObjectBall& ball,
                        Tracer& walls) {
  Neighbours neighbours;
  std::vector<Ray> rays;
  for (std::uint32_t v = 0; v < baked.vertexCount; ++v) {
    const glm::dvec3 normal(scene.normals[v]);
    const glm::dvec3 from = glm::dvec3(scene.positions[v]) + rayLift * ball.radius * normal;
    const glm::dvec3 way = ball.centre - from;
    const double sine2 = ball.radius * ball.radius / std::max(glm::dot(way, way), 1e-300);
    if (sine2 < leastHidden || glm::dot(way, normal) < -ball.radius) continue;
    neighbours.vertices.push_back(v);
    rays.push_back(rayAlong(from, way));
  }
  neighbours.hits = walls.traceClosest(std::span<const Ray>(rays));
  return neighbours;
}

}  // namespace

ObjectShadow shadowByNeighbourhoods(const CompiledScene& scene, const VertexRange& baked,
                                    std::span<const Neighbourhood> objects, std::span<const float> direct,
                                    Tracer& walls, int order) {
  const std::size_t vertices = baked.vertexCount, bands = static_cast<std::size_t>(order * order);
  ObjectShadow shadow{std::vector<float>(vertices), std::vector<float>(vertices * bands),
                      std::vector<float>(vertices), std::vector<float>(vertices * 3 * bands)};
  for (const Neighbourhood& object : objects) {
    const Neighbours neighbours = neighboursOf(scene, baked, object.ball(), walls);
    const auto known = static_cast<std::size_t>(object.order() * object.order());
    parallelRanges(neighbours.vertices.size(), neighbourGrain, [&](std::size_t begin, std::size_t end) {
      Neighbourhood::Change change;
      for (std::size_t k = begin; k < end; ++k) {
        const std::uint32_t v = neighbours.vertices[k];
        const std::span own = direct.subspan(v * bands, bands);
        const std::vector<double> received(own.begin(), own.begin() + static_cast<std::ptrdiff_t>(known));
        object.change(glm::dvec3(scene.positions[v]), glm::dvec3(scene.normals[v]), received, change);
        const Hit& hit = neighbours.hits[k];
        addChange(change, own, v, hit.triangle == PRELIGHT_NO_TRIANGLE || hit.t >= 1.0f, shadow);
      }
    });
  }
  return shadow;
}

}  // namespace prelight
