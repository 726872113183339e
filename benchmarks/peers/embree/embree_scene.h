#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

#if defined(__SSE2__)
#include <pmmintrin.h>
#include <xmmintrin.h>
#endif

#include "benchmarks/peers/embree/embree_queries.h"
#include "benchmarks/peers/embree/ray_peer.h"
#include "prelight/compiled_scene.h"

/// Only of builds with Embree.
namespace prelight::benchmarks {

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

/// Embree's tree over the triangles of a scene, which it must not outlive. Its geometry has their numbers.
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
