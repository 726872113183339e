#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "benchmarks/peers/embree/embree_scene.h"
#include "benchmarks/peers/embree/ray_peer.h"
#include "benchmarks/peers/embree/worker_pool.h"

namespace prelight::benchmarks {

namespace {

using device::Hit;
using device::Ray;

constexpr std::size_t grain = 1024;  // rays per task of a thread

template <int Width>
struct Packet;

template <>
struct Packet<8> {
  using RayHits = RTCRayHit8;
  using Rays = RTCRay8;
};

template <>
struct Packet<16> {
  using RayHits = RTCRayHit16;
  using Rays = RTCRay16;
};

constexpr Hit miss{0.0f, PRELIGHT_NO_TRIANGLE, 0.0f, 0.0f};
constexpr Hit someHit{0.0f, 0, 0.0f, 0.0f};

RTCRay embreeRay(const Ray& ray) {
  RTCRay r{};
  r.org_x = ray.origin[0], r.org_y = ray.origin[1], r.org_z = ray.origin[2];
  r.dir_x = ray.direction[0], r.dir_y = ray.direction[1], r.dir_z = ray.direction[2];
  r.tfar = ray.tMax;
  r.mask = ~0u;
  return r;
}

void intersectSingly(RTCScene scene, EmbreeQueries& embree, std::span<const Ray> rays, Hit* hits) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    RTCRayHit query;
    query.ray = embreeRay(rays[i]);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    embree.intersect(scene, query);
    hits[i] = query.hit.geomID == RTC_INVALID_GEOMETRY_ID
                  ? miss
                  : Hit{query.ray.tfar, query.hit.primID, query.hit.u, query.hit.v};
  }
}

void occludeSingly(RTCScene scene, EmbreeQueries& embree, std::span<const Ray> rays, Hit* hits) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    RTCRay query = embreeRay(rays[i]);
    embree.occlude(scene, query);
    hits[i] = query.tfar < 0.0f ? someHit : miss;
  }
}

/// Traces packets of rays. Lanes beyond the last ray are marked invalid.
template <int Width, typename Rays>
void fillPacket(std::span<const Ray> rays, Rays& packet, int* valid) {
  for (std::size_t lane = 0; lane < Width; ++lane) {
    valid[lane] = lane < rays.size() ? -1 : 0;
    const Ray& ray = rays[std::min(lane, rays.size() - 1)];
    packet.org_x[lane] = ray.origin[0], packet.org_y[lane] = ray.origin[1],
    packet.org_z[lane] = ray.origin[2];
    packet.dir_x[lane] = ray.direction[0], packet.dir_y[lane] = ray.direction[1];
    packet.dir_z[lane] = ray.direction[2];
    packet.tnear[lane] = 0.0f, packet.tfar[lane] = ray.tMax, packet.time[lane] = 0.0f;
    packet.mask[lane] = ~0u, packet.id[lane] = 0, packet.flags[lane] = 0;
  }
}

template <int Width>
void intersectPackets(RTCScene scene, EmbreeQueries& embree, std::span<const Ray> rays, Hit* hits) {
  typename Packet<Width>::RayHits query;
  alignas(64) int valid[Width];
  for (std::size_t first = 0; first < rays.size(); first += Width) {
    const std::size_t count = std::min<std::size_t>(Width, rays.size() - first);
    fillPacket<Width>(rays.subspan(first, count), query.ray, valid);
    std::fill_n(query.hit.geomID, Width, RTC_INVALID_GEOMETRY_ID);
    embree.intersect(valid, scene, query);
    for (std::size_t lane = 0; lane < count; ++lane)
      hits[first + lane] =
          query.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID
              ? miss
              : Hit{query.ray.tfar[lane], query.hit.primID[lane], query.hit.u[lane], query.hit.v[lane]};
  }
}

template <int Width>
void occludePackets(RTCScene scene, EmbreeQueries& embree, std::span<const Ray> rays, Hit* hits) {
  typename Packet<Width>::Rays query;
  alignas(64) int valid[Width];
  for (std::size_t first = 0; first < rays.size(); first += Width) {
    const std::size_t count = std::min<std::size_t>(Width, rays.size() - first);
    fillPacket<Width>(rays.subspan(first, count), query, valid);
    embree.occlude(valid, scene, query);
    for (std::size_t lane = 0; lane < count; ++lane)
      hits[first + lane] = query.tfar[lane] < 0.0f ? someHit : miss;
  }
}

using TraceRange = void (*)(RTCScene, EmbreeQueries&, std::span<const Ray>, Hit*);

TraceRange rangeTracer(const PeerQuery& query) {
  if (query.width == 8) return query.any ? occludePackets<8> : intersectPackets<8>;
  if (query.width == 16) return query.any ? occludePackets<16> : intersectPackets<16>;
  return query.any ? occludeSingly : intersectSingly;
}

class EmbreePeer final : public RayPeer {
 public:
  EmbreePeer(const CompiledScene& scene, PeerQuality quality, std::size_t threads)
      : pool_(threads), scene_(scene, quality, threads) {}

  void trace(std::span<const Ray> rays, std::span<Hit> hits, const PeerQuery& query) override {
    const TraceRange traceRange = rangeTracer(query);
    pool_.run(rays.size(), grain, [&](std::size_t begin, std::size_t end) {
      const DenormalsFlushed flushed;
      EmbreeQueries embree(query.coherent);
      traceRange(scene_.get(), embree, rays.subspan(begin, end - begin), hits.data() + begin);
    });
  }

  double buildSeconds() const override { return scene_.buildSeconds(); }
  std::size_t bytes() const override { return scene_.bytes(); }

 private:
  WorkerPool pool_;
  EmbreeScene scene_;
};

}  // namespace

std::unique_ptr<RayPeer> makeEmbreePeer(const CompiledScene& scene, PeerQuality quality,
                                        std::size_t threads) {
  return std::make_unique<EmbreePeer>(scene, quality, threads);
}

std::string embreeVersion() {
  return fmt::format("Embree {}.{}.{}", RTC_VERSION_MAJOR, RTC_VERSION_MINOR, RTC_VERSION_PATCH);
}

}  // namespace prelight::benchmarks
