#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "benchmarks/peers/embree/embree_scene.h"
#include "benchmarks/peers/embree/vertex_baker.h"
#include "benchmarks/peers/embree/worker_pool.h"
#include "benchmarks/run/measure.h"
#include "benchmarks/run/timing.h"

namespace prelight::benchmarks {

namespace {

constexpr std::size_t verticesAtOnce = 64;  // vertices per task of a thread
constexpr std::size_t coefficients = 9;     // of order 3
constexpr float liftOverDiagonal = 1e-5f;   // distance of a ray's start from the surface
constexpr std::uint32_t nothing = ~0u;

using Coefficients = std::array<float, coefficients>;

/// A hit of a ray.
struct VertexRayHit {
  std::uint32_t triangle = nothing;
  float u = 0.0f, v = 0.0f;
};

/// Marsaglia's xorshift.
class Random {
 public:
  explicit Random(std::uint32_t seed) : state_(seed * 2654435761u + 1u) {}
  float next() {
    state_ ^= state_ << 13, state_ ^= state_ >> 17, state_ ^= state_ << 5;
    return static_cast<float>(state_ >> 8) * 0x1p-24f;
  }

 private:
  std::uint32_t state_;
};

/// Two unit vectors perpendicular to a third one (Duff et al. 2017).
struct Frame {
  explicit Frame(const glm::vec3& n) : normal(n) {
    const float sign = std::copysign(1.0f, n.z), a = -1.0f / (sign + n.z), b = n.x * n.y * a;
    tangent = {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x};
    bitangent = {b, sign + n.y * n.y * a, -n.y};
  }
  glm::vec3 cosineDirection(float u, float v) const {
    const float r = std::sqrt(u), angle = 2.0f * std::numbers::pi_v<float> * v;
    return r * std::cos(angle) * tangent + r * std::sin(angle) * bitangent +
           std::sqrt(std::max(0.0f, 1.0f - u)) * normal;
  }
  glm::vec3 tangent, bitangent, normal;
};

void addHarmonics(const glm::vec3& d, Coefficients& sum) {
  sum[0] += 0.28209479f;
  sum[1] += 0.48860251f * d.y, sum[2] += 0.48860251f * d.z, sum[3] += 0.48860251f * d.x;
  sum[4] += 1.09254843f * d.x * d.y, sum[5] += 1.09254843f * d.y * d.z;
  sum[6] += 0.31539157f * (3.0f * d.z * d.z - 1.0f);
  sum[7] += 1.09254843f * d.x * d.z, sum[8] += 0.54627422f * (d.x * d.x - d.y * d.y);
}

class VertexBaker {
 public:
  VertexBaker(const CompiledScene& scene, const VertexBakeRequest& request, std::size_t threads)
      : scene_(scene),
        side_(request.side),
        rays_(std::size_t{request.side} * request.side),
        lift_(liftOverDiagonal * glm::length(scene.boundsMax - scene.boundsMin)),
        pool_(threads),
        tree_(scene, PeerQuality::Medium, threads) {
    bake_.ao.resize(scene.vertexCount());
  }

  VertexBake bakeAo() {
    forVertices([&](std::uint32_t v, EmbreeQueries& embree) {
      std::size_t open = 0;
      forRays(v, [&](std::size_t, RTCRay& ray) {
        embree.occlude(tree_.get(), ray);
        open += ray.tfar >= 0.0f;
      });
      bake_.ao[v] = static_cast<float>(open) / static_cast<float>(rays_);
    });
    return std::move(bake_);
  }

  VertexBake bakeTransfer() {
    direct_.resize(scene_.vertexCount());
    hits_.resize(scene_.vertexCount() * rays_);
    forVertices([&](std::uint32_t v, EmbreeQueries& embree) { castVertex(v, embree); });
    bake_.transfer.resize(scene_.vertexCount() * 3 * coefficients);
    for (const std::uint32_t material : scene_.triangleMaterials)
      albedos_.push_back(scene_.materials[material].albedo / static_cast<float>(rays_));
    forVertices([&](std::uint32_t v, EmbreeQueries&) { gatherVertex(v); });
    return std::move(bake_);
  }

 private:
  template <typename Work>
  void forVertices(const Work& work) {
    pool_.run(scene_.vertexCount(), verticesAtOnce, [&](std::size_t begin, std::size_t end) {
      const DenormalsFlushed flushed;
      EmbreeQueries embree;
      for (std::size_t v = begin; v < end; ++v) work(static_cast<std::uint32_t>(v), embree);
    });
  }

  template <typename Work>
  void forRays(std::uint32_t v, const Work& work) const {
    const Frame frame(scene_.normals[v]);
    const glm::vec3 origin = scene_.positions[v] + lift_ * frame.normal;
    Random random(v);
    for (std::size_t i = 0; i < rays_; ++i) {
      const float u = (static_cast<float>(i % side_) + random.next()) / static_cast<float>(side_);
      const float w = (static_cast<float>(i / side_) + random.next()) / static_cast<float>(side_);
      const glm::vec3 d = frame.cosineDirection(u, w);
      RTCRay ray{};
      ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
      ray.dir_x = d.x, ray.dir_y = d.y, ray.dir_z = d.z;
      ray.tfar = std::numeric_limits<float>::infinity();
      ray.mask = ~0u;
      work(i, ray);
    }
  }

  /// Finds the sky that a vertex sees directly, and the surfaces that hide the rest.
  void castVertex(std::uint32_t v, EmbreeQueries& embree) {
    Coefficients sum{};
    std::size_t open = 0;
    forRays(v, [&](std::size_t i, const RTCRay& ray) {
      RTCRayHit query;
      query.ray = ray;
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      embree.intersect(tree_.get(), query);
      if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        addHarmonics({ray.dir_x, ray.dir_y, ray.dir_z}, sum);
        ++open;
      } else {
        hits_[v * rays_ + i] = {query.hit.primID, query.hit.u, query.hit.v};
      }
    });
    const float scale = 1.0f / static_cast<float>(rays_);
    bake_.ao[v] = scale * static_cast<float>(open);
    for (float& value : sum) value *= scale;
    direct_[v] = sum;
  }

  /// Adds the light that the surfaces around a vertex send on to its transfer.
  void gatherVertex(std::uint32_t v) {
    std::array<Coefficients, 3> sum{direct_[v], direct_[v], direct_[v]};
    for (std::size_t i = v * rays_; i < (v + 1) * rays_; ++i) {
      const VertexRayHit& hit = hits_[i];
      if (hit.triangle == nothing) continue;
      const glm::uvec3& t = scene_.triangles[hit.triangle];
      const glm::vec3& albedo = albedos_[hit.triangle];
      const Coefficients &a = direct_[t.x], &b = direct_[t.y], &c = direct_[t.z];
      const float w = 1.0f - hit.u - hit.v;
      for (std::size_t k = 0; k < coefficients; ++k) {
        const float sent = w * a[k] + hit.u * b[k] + hit.v * c[k];
        sum[0][k] += albedo.x * sent, sum[1][k] += albedo.y * sent, sum[2][k] += albedo.z * sent;
      }
    }
    for (std::size_t c = 0; c < 3; ++c)
      std::copy(sum[c].begin(), sum[c].end(), &bake_.transfer[(3 * v + c) * coefficients]);
  }

  const CompiledScene& scene_;
  std::size_t side_;
  std::size_t rays_;
  float lift_;
  WorkerPool pool_;
  EmbreeScene tree_;
  std::vector<Coefficients> direct_;  ///< [vertex]
  std::vector<VertexRayHit> hits_;    ///< [vertex][ray]
  std::vector<glm::vec3> albedos_;    ///< [triangle], over the rays
  VertexBake bake_;
};

}  // namespace

std::optional<VertexBake> bakeAtVertices(const CompiledScene& scene, const VertexBakeRequest& request,
                                         std::size_t threads) {
  VertexBake bake;
  const double processor = processorSeconds();
  const double seconds = secondsOf([&] {
    VertexBaker baker(scene, request, threads);
    bake = request.transfer ? baker.bakeTransfer() : baker.bakeAo();
  });
  bake.seconds = seconds;
  bake.processorSeconds = processorSeconds() - processor;
  return bake;
}

}  // namespace prelight::benchmarks
