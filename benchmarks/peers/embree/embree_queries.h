#pragma once

#if PRELIGHT_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

/// Only of builds with Embree. PRELIGHT_EMBREE is its major version.
namespace prelight::benchmarks {

/// Embree's queries of single rays and of packets, which versions 3 and 4 tell in different ways what they
/// should know besides the rays. `coherent` says that rays near each other go the same way.
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

}  // namespace prelight::benchmarks
