#pragma once

#if PRELIGHT_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

#if defined(__SSE2__)
#include <pmmintrin.h>
#include <xmmintrin.h>
#endif

#include <atomic>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

#include "benchmarks/peers/embree/ray_peer.h"
#include "prelight/compiled_scene.h"

/// Used only in builds with Embree. PRELIGHT_EMBREE is its major version.
namespace prelight::benchmarks {

/// Embree's queries for single rays and for packets. Versions 3 and 4 take their settings in different ways.
/// `coherent`: rays next to each other have similar directions.
class EmbreeQueries {
 public:
#if PRELIGHT_EMBREE == 3
  explicit EmbreeQueries(bool coherent = false) {
    rtcInitIntersectContext(&context_);
    context_.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }

  void intersect(RTCScene scene, RTCRayHit& ray) { rtcIntersect1(scene, &context_, &ray); }
  void intersect(const int* valid, RTCScene scene, RTCRayHit8& rays) {
    rtcIntersect8(valid, scene, &context_, &rays);
  }
  void intersect(const int* valid, RTCScene scene, RTCRayHit16& rays) {
    rtcIntersect16(valid, scene, &context_, &rays);
  }

  void occlude(RTCScene scene, RTCRay& ray) { rtcOccluded1(scene, &context_, &ray); }
  void occlude(const int* valid, RTCScene scene, RTCRay8& rays) {
    rtcOccluded8(valid, scene, &context_, &rays);
  }
  void occlude(const int* valid, RTCScene scene, RTCRay16& rays) {
    rtcOccluded16(valid, scene, &context_, &rays);
  }

 private:
  RTCIntersectContext context_;
#else
  explicit EmbreeQueries(bool coherent = false) {
    rtcInitIntersectArguments(&intersect_);
    rtcInitOccludedArguments(&occluded_);
    intersect_.flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
    occluded_.flags = intersect_.flags;
  }

  void intersect(RTCScene scene, RTCRayHit& ray) { rtcIntersect1(scene, &ray, &intersect_); }
  void intersect(const int* valid, RTCScene scene, RTCRayHit8& rays) {
    rtcIntersect8(valid, scene, &rays, &intersect_);
  }
  void intersect(const int* valid, RTCScene scene, RTCRayHit16& rays) {
    rtcIntersect16(valid, scene, &rays, &intersect_);
  }

  void occlude(RTCScene scene, RTCRay& ray) { rtcOccluded1(scene, &ray, &occluded_); }
  void occlude(const int* valid, RTCScene scene, RTCRay8& rays) {
    rtcOccluded8(valid, scene, &rays, &occluded_);
  }
  void occlude(const int* valid, RTCScene scene, RTCRay16& rays) {
    rtcOccluded16(valid, scene, &rays, &occluded_);
  }

 private:
  RTCIntersectArguments intersect_;
  RTCOccludedArguments occluded_;
#endif
};

/// Flushes denormals to zero during its lifetime, as Embree recommends.
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

/// Embree's tree over the triangles of a scene, which must outlive it. Its primitives have the scene's
/// triangle numbers.
class EmbreeScene {
 public:
  EmbreeScene(const CompiledScene& scene, PeerQuality quality, std::size_t threads);

  RTCScene get() const { return scene_.get(); }
  double buildSeconds() const { return buildSeconds_; }
  std::size_t bytes() const;

 private:
  void attachTriangles(const CompiledScene& scene, PeerQuality quality);

  std::vector<glm::vec3> positions_;
  std::atomic<std::ptrdiff_t> bytes_{0};
  double buildSeconds_ = 0.0;
  DeviceHandle device_;
  SceneHandle scene_;
};

}  // namespace prelight::benchmarks
