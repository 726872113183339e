#include "benchmarks/peers/embree/embree_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "prelight/error.h"

namespace prelight::benchmarks {

namespace {

RTCBuildQuality embreeQuality(PeerQuality quality) {
  if (quality == PeerQuality::Low) return RTC_BUILD_QUALITY_LOW;
  return quality == PeerQuality::Medium ? RTC_BUILD_QUALITY_MEDIUM : RTC_BUILD_QUALITY_HIGH;
}

bool countBytes(void* counter, std::ptrdiff_t bytes, bool) {
  *static_cast<std::atomic<std::ptrdiff_t>*>(counter) += bytes;
  return true;
}

[[noreturn]] void fail(RTCError error) {
  const bool memory = error == RTC_ERROR_OUT_OF_MEMORY;
  throw Error(memory ? ExitCode::OutOfMemory : ExitCode::RuntimeFailure, "Embree",
              fmt::format("error {} while its tree was built", static_cast<int>(error)));
}

}  // namespace

EmbreeScene::EmbreeScene(const CompiledScene& scene, PeerQuality quality, std::size_t threads)
    : device_(rtcNewDevice(fmt::format("threads={}", threads).c_str())) {
  const DenormalsFlushed flushed;
  if (!device_) fail(rtcGetDeviceError(nullptr));
  rtcSetDeviceMemoryMonitorFunction(device_.get(), countBytes, &bytes_);
  positions_ = scene.positions;
  positions_.emplace_back(0.0f);  // Embree reads four floats per vertex
  scene_.reset(rtcNewScene(device_.get()));
  rtcSetSceneBuildQuality(scene_.get(), embreeQuality(quality));
  attachTriangles(scene, quality);
  const auto start = std::chrono::steady_clock::now();
  rtcCommitScene(scene_.get());
  buildSeconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (const RTCError error = rtcGetDeviceError(device_.get()); error != RTC_ERROR_NONE) fail(error);
}

std::size_t EmbreeScene::bytes() const {
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, bytes_));
}

void EmbreeScene::attachTriangles(const CompiledScene& scene, PeerQuality quality) {
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions_.data(), 0,
                             sizeof(glm::vec3), scene.positions.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, scene.triangles.data(), 0,
                             sizeof(glm::uvec3), scene.triangles.size());
  rtcSetGeometryBuildQuality(geometry, embreeQuality(quality));
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
}

}  // namespace prelight::benchmarks
