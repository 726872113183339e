#include "benchmarks/suites/bake/surface_error.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <random>

#include "basis/sh_evaluate.h"
#include "receivers/sampling.h"

namespace prelight::benchmarks {

namespace {

using device::Hit;
using device::Ray;

constexpr int order = 3;
constexpr std::size_t coefficients = 9;
constexpr double liftOverDiagonal = 1e-5;
constexpr std::size_t placesAtOnce = 256;

/// Random numbers in [0,1), the same on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double next() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  glm::dvec2 pair() {
    const double first = next();
    return {first, next()};
  }

 private:
  std::mt19937_64 engine_;
};

std::vector<SurfaceSample> spreadPlaces(const CompiledScene& scene, std::size_t count) {
  std::vector<double> sums;
  double sum = 0.0;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    sums.push_back(sum += glm::length(geometricNormal(scene, t)));
  Random random(1);
  std::vector<SurfaceSample> places;
  for (std::size_t i = 0; i < count; ++i) {
    const double at = sum * (static_cast<double>(i) + random.next()) / static_cast<double>(count);
    const auto t = static_cast<std::uint32_t>(std::min<std::ptrdiff_t>(
        std::upper_bound(sums.begin(), sums.end(), at) - sums.begin(), scene.triangleCount() - 1));
    const glm::dvec2 b = keptOffEdges(scene, t, sampling::uniformTriangle(random.pair()));
    places.push_back({t, static_cast<float>(b.x), static_cast<float>(b.y), 1.0f});
  }
  return places;
}

glm::dvec3 shadingNormal(const CompiledScene& scene, const SurfaceSample& at) {
  if (scene.triangleFlat[at.triangle]) return orientedNormal(scene, at.triangle);
  const glm::uvec3& t = scene.triangles[at.triangle];
  const auto [b0, b1, b2] = cornerWeights(at);
  return glm::normalize(b0 * glm::dvec3(scene.normals[t.x]) + b1 * glm::dvec3(scene.normals[t.y]) +
                        b2 * glm::dvec3(scene.normals[t.z]));
}

/// Traces paths from points of the surface, one block of points at a time.
class PathBlocks {
 public:
  PathBlocks(const CompiledScene& scene, RayPeer& peer, std::uint32_t side, std::uint64_t seed)
      : scene_(scene),
        peer_(peer),
        side_(side),
        random_(seed),
        lift_(liftOverDiagonal * glm::length(glm::dvec3(scene.boundsMax) - glm::dvec3(scene.boundsMin))) {}

  void add(std::span<const SurfaceSample> places, std::vector<double>& accessibility,
           std::vector<double>& transfer) {
    transfer_.assign(places.size() * 3 * coefficients, 0.0);
    open_.assign(places.size(), 0.0);
    rays_.clear();
    for (const SurfaceSample& place : places) addRays(place);
    hits_.resize(rays_.size());
    peer_.trace(rays_, hits_, {});
    bounces_.clear(), senders_.clear();
    const std::size_t paths = std::size_t{side_} * side_;
    for (std::size_t i = 0; i < rays_.size(); ++i)
      hits_[i].triangle == PRELIGHT_NO_TRIANGLE ? seeSky(rays_[i], i / paths)
                                                : bounce(rays_[i], hits_[i], i / paths);
    hits_.resize(bounces_.size());
    peer_.trace(bounces_, hits_, {.any = true});
    for (std::size_t i = 0; i < bounces_.size(); ++i)
      if (hits_[i].triangle == PRELIGHT_NO_TRIANGLE)
        addLight(bounces_[i], senders_[i].place, senders_[i].albedo);
    for (const double sum : open_) accessibility.push_back(sum / static_cast<double>(paths));
    for (const double sum : transfer_) transfer.push_back(sum / static_cast<double>(paths));
  }

 private:
  struct Sender {
    std::size_t place;
    glm::dvec3 albedo;
  };

  Ray rayFrom(const SurfaceSample& at, double sign, const glm::dvec3& direction) const {
    const glm::uvec3& t = scene_.triangles[at.triangle];
    const auto [b0, b1, b2] = cornerWeights(at);
    const glm::vec3 origin(b0 * glm::dvec3(scene_.positions[t.x]) + b1 * glm::dvec3(scene_.positions[t.y]) +
                           b2 * glm::dvec3(scene_.positions[t.z]) +
                           sign * lift_ * orientedNormal(scene_, at.triangle));
    const glm::vec3 d(direction);
    return {{origin.x, origin.y, origin.z}, at.triangle, {d.x, d.y, d.z}, std::numeric_limits<float>::max()};
  }

  void addRays(const SurfaceSample& place) {
    const glm::dvec3 normal = shadingNormal(scene_, place);
    for (std::uint32_t i = 0; i < side_ * side_; ++i) {
      const glm::dvec2 u = (glm::dvec2(i % side_, i / side_) + random_.pair()) / double(side_);
      rays_.push_back(rayFrom(place, 1.0, sampling::cosineHemisphere(u, normal)));
    }
  }

  void seeSky(const Ray& ray, std::size_t place) {
    open_[place] += 1.0;
    addLight(ray, place, glm::dvec3(1.0));
  }

  void addLight(const Ray& ray, std::size_t place, const glm::dvec3& albedo) {
    std::array<double, coefficients> harmonics{};
    sh::evaluate(glm::normalize(glm::dvec3(ray.direction[0], ray.direction[1], ray.direction[2])), order,
                 harmonics);
    for (int c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < coefficients; ++k)
        transfer_[(3 * place + static_cast<std::size_t>(c)) * coefficients + k] += albedo[c] * harmonics[k];
  }

  /// Continues a path on the side that was hit.
  void bounce(const Ray& ray, const Hit& hit, std::size_t place) {
    const glm::dvec3 albedo(scene_.materials[scene_.triangleMaterials[hit.triangle]].albedo);
    const SurfaceSample at{hit.triangle, hit.u, hit.v, 1.0f};
    const glm::dvec3 incoming(ray.direction[0], ray.direction[1], ray.direction[2]);
    const double sign = glm::dot(incoming, orientedNormal(scene_, hit.triangle)) < 0.0 ? 1.0 : -1.0;
    const glm::dvec3 normal = sign * shadingNormal(scene_, at);
    bounces_.push_back(rayFrom(at, sign, sampling::cosineHemisphere(random_.pair(), normal)));
    senders_.push_back({place, albedo});
  }

  const CompiledScene& scene_;
  RayPeer& peer_;
  std::uint32_t side_;
  Random random_;
  double lift_;
  std::vector<Ray> rays_, bounces_;
  std::vector<Hit> hits_;
  std::vector<Sender> senders_;  ///< surfaces that reflect light
  std::vector<double> open_, transfer_;
};

}  // namespace

SurfaceTruth findSurfaceTruth(const CompiledScene& scene, RayPeer& rays, std::size_t places,
                              std::uint32_t side, const Progress& progress) {
  assert(!scene.hasAlbedoTextures());
  SurfaceTruth truth;
  truth.places = spreadPlaces(scene, places);
  PathBlocks blocks(scene, rays, side, 2);
  const auto find = [&](std::vector<double>& accessibility, std::vector<double>& transfer) {
    for (std::size_t first = 0; first < places; first += placesAtOnce) {
      const std::size_t count = std::min(placesAtOnce, places - first);
      blocks.add(std::span(truth.places).subspan(first, count), accessibility, transfer);
      progress.check();
    }
  };
  find(truth.accessibility.first, truth.transfer.first);
  find(truth.accessibility.second, truth.transfer.second);
  return truth;
}

SurfaceError surfaceError(const CompiledScene& scene, const std::vector<SurfaceSample>& places,
                          const TwiceFound& truth, std::span<const float> values) {
  const std::size_t columns = truth.first.size() / places.size();
  assert(values.size() == scene.vertexCount() * columns);
  double squares = 0.0, size = 0.0;
  for (std::size_t p = 0; p < places.size(); ++p) {
    const glm::uvec3& t = scene.triangles[places[p].triangle];
    const auto [b0, b1, b2] = cornerWeights(places[p]);
    for (std::size_t c = 0; c < columns; ++c) {
      const double value = b0 * double(values[t.x * columns + c]) + b1 * double(values[t.y * columns + c]) +
                           b2 * double(values[t.z * columns + c]);
      const double a = truth.first[p * columns + c], b = truth.second[p * columns + c];
      squares += (value - a) * (value - b);
      size += a * b;
    }
  }
  const double scale = 1.0 / static_cast<double>(places.size());
  return {std::sqrt(std::max(0.0, squares) * scale), std::sqrt(std::max(0.0, size) * scale)};
}

TimeToError timeToError(std::span<const Point> curve, double error) {
  using Kind = TimeToError::Kind;
  constexpr double least = 1e-12;  // errors below the accuracy of the truth may come out as 0
  if (error >= curve.front().y) return {curve.front().x, Kind::AtMost};
  for (std::size_t i = 1; i < curve.size(); ++i) {
    if (curve[i].y > error) continue;
    const Point &from = curve[i - 1], &to = curve[i];
    const double share = std::log(std::max(error, least) / from.y) / std::log(std::max(to.y, least) / from.y);
    return {from.x * std::pow(to.x / from.x, share), Kind::Measured};
  }
  return {curve.back().x, Kind::AtLeast};
}

}  // namespace prelight::benchmarks
