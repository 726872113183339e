#include "gpu/self_test.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "device/layout.h"
#include "gpu/tracer.h"

namespace prelight {

namespace {

/// Returns a unit square in the plane y = 0, made of two triangles that share a diagonal.
CompiledScene unitSquare() {
  CompiledScene scene;
  scene.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}};
  scene.normals.assign(4, glm::vec3(0, 1, 0));
  scene.texCoords.assign(4, glm::vec2(0));
  scene.triangles = {{0, 2, 1}, {0, 3, 2}};
  scene.triangleMaterials = {0, 0};
  scene.triangleFlat = {0, 0};
  scene.materials.resize(1);
  scene.boundsMax = glm::vec3(1, 0, 1);
  return scene;
}

std::string layoutsAgree(DeviceContext& device) {
  const auto host = hostLayouts();
  const auto other = deviceLayouts(device);
  for (std::size_t i = 0; i < host.size(); ++i)
    if (!(host[i] == other[i]))
      return fmt::format("{} is {} bytes on the device, {} on the host", host[i].name, other[i].size,
                         host[i].size);
  return {};
}

/// Traces vertical rays onto a grid of points on the square, including its border, diagonal and corners: all
/// must hit at their starting height; rays beside the square must miss.
std::string raysHitTheSquare(const Device& device, BvhLayout layout) {
  Tracer tracer(unitSquare(), device, layout);
  std::vector<device::Ray> rays;
  constexpr int side = 65;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i)
      rays.push_back(
          {{float(i) / (side - 1), 2.0f, float(j) / (side - 1)}, PRELIGHT_NO_TRIANGLE, {0, -1, 0}, 1e30f});
  const std::size_t inside = rays.size();
  rays.push_back({{1.5f, 2.0f, 0.5f}, PRELIGHT_NO_TRIANGLE, {0, -1, 0}, 1e30f});
  rays.push_back({{0.5f, 2.0f, 0.5f}, PRELIGHT_NO_TRIANGLE, {0, 1, 0}, 1e30f});
  const auto closest = tracer.traceClosest(rays);
  const auto any = tracer.traceAny(rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool hit = closest[i].triangle != PRELIGHT_NO_TRIANGLE;
    if (hit != (i < inside) || hit != (any[i].triangle != PRELIGHT_NO_TRIANGLE))
      return fmt::format("ray {} of {} {}", i, rays.size(),
                         hit ? "hits nothing that is there" : "leaks through");
    if (hit && std::abs(closest[i].t - 2.0f) > 1e-6f)
      return fmt::format("ray {} hits at {} instead of 2", i, closest[i].t);
  }
  return {};
}

SelfTestResult check(const std::string& name, const std::function<std::string()>& test) {
  try {
    const std::string failure = test();
    return {name, failure.empty(), failure};
  } catch (const std::exception& error) {
    return {name, false, error.what()};
  }
}

}  // namespace

std::vector<SelfTestResult> selfTest(const Device& device) {
  return {
      check("struct layouts", [&] { return layoutsAgree(device.context()); }),
      check("tracing, wide tree", [&] { return raysHitTheSquare(device, BvhLayout::Wide); }),
      check("tracing, narrow tree", [&] { return raysHitTheSquare(device, BvhLayout::Narrow); }),
  };
}

}  // namespace prelight
