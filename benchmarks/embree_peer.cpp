#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <vector>

#if defined(__SSE2__)
#include <pmmintrin.h>
#include <xmmintrin.h>
#endif

#include "benchmarks/ray_peer.h"
#include "benchmarks/worker_pool.h"
#include "prelight/error.h"

namespace prelight::benchmarks {

namespace {

using device::Hit;
using device::Ray;

constexpr std::size_t grain = 1024;  // rays that a thread takes at a time

/// Flushes denormals while it lives, as Embree asks for.
class DenormalsFlushed {
#if defined(__SSE2__)
 public:
  DenormalsFlushed() : before_(_mm_getcsr()) {
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
  }
  DenormalsFlushed(const DenormalsFlushed&) = delete;
  DenormalsFlushed& operator=(const DenormalsFlushed&) = delete;
  ~DenormalsFlushed() { _mm_setcsr(before_); }

 private:
  unsigned before_;
#endif
};

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DeviceHandle = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;

template <int Width>
struct Packet;

template <>
struct Packet<8> {
  using RayHits = RTCRayHit8;
  using Rays = RTCRay8;
  static constexpr auto intersect = rtcIntersect8;
  static constexpr auto occluded = rtcOccluded8;
};

template <>
struct Packet<16> {
  using RayHits = RTCRayHit16;
  using Rays = RTCRay16;
  static constexpr auto intersect = rtcIntersect16;
  static constexpr auto occluded = rtcOccluded16;
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

void intersectSingly(RTCScene scene, RTCIntersectContext& context, std::span<const Ray> rays, Hit* hits) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    RTCRayHit query;
    query.ray = embreeRay(rays[i]);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &query);
    hits[i] = query.hit.geomID == RTC_INVALID_GEOMETRY_ID
                  ? miss
                  : Hit{query.ray.tfar, query.hit.primID, query.hit.u, query.hit.v};
  }
}

void occludeSingly(RTCScene scene, RTCIntersectContext& context, std::span<const Ray> rays, Hit* hits) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    RTCRay query = embreeRay(rays[i]);
    rtcOccluded1(scene, &context, &query);
    hits[i] = query.tfar < 0.0f ? someHit : miss;
  }
}

/// Lanes beyond the last ray stay invalid.
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
void intersectPackets(RTCScene scene, RTCIntersectContext& context, std::span<const Ray> rays, Hit* hits) {
  typename Packet<Width>::RayHits query;
  alignas(64) int valid[Width];
  for (std::size_t first = 0; first < rays.size(); first += Width) {
    const std::size_t count = std::min<std::size_t>(Width, rays.size() - first);
    fillPacket<Width>(rays.subspan(first, count), query.ray, valid);
    std::fill_n(query.hit.geomID, Width, RTC_INVALID_GEOMETRY_ID);
    Packet<Width>::intersect(valid, scene, &context, &query);
    for (std::size_t lane = 0; lane < count; ++lane)
      hits[first + lane] =
          query.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID
              ? miss
              : Hit{query.ray.tfar[lane], query.hit.primID[lane], query.hit.u[lane], query.hit.v[lane]};
  }
}

template <int Width>
void occludePackets(RTCScene scene, RTCIntersectContext& context, std::span<const Ray> rays, Hit* hits) {
  typename Packet<Width>::Rays query;
  alignas(64) int valid[Width];
  for (std::size_t first = 0; first < rays.size(); first += Width) {
    const std::size_t count = std::min<std::size_t>(Width, rays.size() - first);
    fillPacket<Width>(rays.subspan(first, count), query, valid);
    Packet<Width>::occluded(valid, scene, &context, &query);
    for (std::size_t lane = 0; lane < count; ++lane)
      hits[first + lane] = query.tfar[lane] < 0.0f ? someHit : miss;
  }
}

using TraceRange = void (*)(RTCScene, RTCIntersectContext&, std::span<const Ray>, Hit*);

TraceRange rangeTracer(const PeerQuery& query) {
  if (query.width == 8) return query.any ? occludePackets<8> : intersectPackets<8>;
  if (query.width == 16) return query.any ? occludePackets<16> : intersectPackets<16>;
  return query.any ? occludeSingly : intersectSingly;
}

RTCBuildQuality embreeQuality(PeerQuality quality) {
  if (quality == PeerQuality::Low) return RTC_BUILD_QUALITY_LOW;
  return quality == PeerQuality::Medium ? RTC_BUILD_QUALITY_MEDIUM : RTC_BUILD_QUALITY_HIGH;
}

class EmbreePeer final : public RayPeer {
 public:
  EmbreePeer(const CompiledScene& scene, PeerQuality quality, std::size_t threads)
      : pool_(threads), device_(rtcNewDevice(fmt::format("threads={}", threads).c_str())) {
    const DenormalsFlushed flushed;
    if (!device_) fail(rtcGetDeviceError(nullptr));
    rtcSetDeviceMemoryMonitorFunction(device_.get(), countBytes, &bytes_);
    positions_ = scene.positions;
    positions_.emplace_back(0.0f);  // Embree reads four floats a vertex
    scene_.reset(rtcNewScene(device_.get()));
    rtcSetSceneBuildQuality(scene_.get(), embreeQuality(quality));
    attachTriangles(scene, quality);
    const auto start = std::chrono::steady_clock::now();
    rtcCommitScene(scene_.get());
    buildSeconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (const RTCError error = rtcGetDeviceError(device_.get()); error != RTC_ERROR_NONE) fail(error);
  }

  void trace(std::span<const Ray> rays, std::span<Hit> hits, const PeerQuery& query) override {
    const TraceRange traceRange = rangeTracer(query);
    pool_.run(rays.size(), grain, [&](std::size_t begin, std::size_t end) {
      const DenormalsFlushed flushed;
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      context.flags =
          query.coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
      traceRange(scene_.get(), context, rays.subspan(begin, end - begin), hits.data() + begin);
    });
  }

  double buildSeconds() const override { return buildSeconds_; }
  std::size_t bytes() const override { return static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, bytes_)); }

 private:
  static bool countBytes(void* counter, std::ptrdiff_t bytes, bool) {
    *static_cast<std::atomic<std::ptrdiff_t>*>(counter) += bytes;
    return true;
  }

  [[noreturn]] static void fail(RTCError error) {
    const bool memory = error == RTC_ERROR_OUT_OF_MEMORY;
    throw Error(memory ? ExitCode::OutOfMemory : ExitCode::RuntimeFailure, "Embree",
                fmt::format("error {} while its tree was built", static_cast<int>(error)));
  }

  void attachTriangles(const CompiledScene& scene, PeerQuality quality) {
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions_.data(), 0,
                               sizeof(glm::vec3), scene.positions.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, scene.triangles.data(),
                               0, sizeof(glm::uvec3), scene.triangles.size());
    rtcSetGeometryBuildQuality(geometry, embreeQuality(quality));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
  }

  WorkerPool pool_;
  std::vector<glm::vec3> positions_;
  std::atomic<std::ptrdiff_t> bytes_{0};
  double buildSeconds_ = 0.0;
  DeviceHandle device_;
  SceneHandle scene_;
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
