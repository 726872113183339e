#include "viewer/programs/draw_order.h"

#include <algorithm>

namespace prelight::viewer {
namespace {

constexpr std::size_t manyLights = 16;  ///< that shaders look at

}  // namespace

DrawOrder drawOrderOf(const RenderScene& scene, const glm::dvec3& eye, bool isFull, const LeftOut& leftOut) {
  DrawOrder order;
  for (const Batch& batch : scene.batches()) {
    if (leftOut.has(batch)) continue;
    const Surface& surface = scene.surfaces()[batch.surface];
    // Glass with an inside shows by itself what lies behind it, but for the share that it does not cover.
    const bool body = isFull && surface.isBody() && surface.material.alphaMode != AlphaMode::Blend;
    (surface.isBlended() && !body ? order.blended : order.opaque).push_back(&batch);
  }
  std::stable_sort(order.blended.begin(), order.blended.end(), [&](const Batch* a, const Batch* b) {
    return glm::distance(glm::dvec3(a->center), eye) > glm::distance(glm::dvec3(b->center), eye);
  });
  return order;
}

bool drawsDepthsFirst(Shading shading, std::size_t lights) {
  return showsAllLight(shading) || lights >= manyLights;
}

}  // namespace prelight::viewer
