#include "relight/shadowed_transfer.h"

#include <algorithm>

namespace prelight {

namespace {

/// Returns the first `count` values.
std::vector<float> firstRows(const std::vector<float>& values, std::size_t count) {
  return {values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count)};
}

/// Returns direct transfer. If no surface reflects, all transfer is direct and equal in all channels.
std::vector<float> directOf(const ObjectScene& light, const HarmonicTransfer& sh, std::size_t vertices) {
  if (!light.direct().empty()) return {light.direct().begin(), light.direct().end()};
  std::vector<float> direct;
  const auto columns = static_cast<std::ptrdiff_t>(sh.order * sh.order);
  for (std::ptrdiff_t v = 0; sh.bounces == 0 && v < static_cast<std::ptrdiff_t>(vertices); ++v) {
    const auto row = sh.coefficients.begin() + v * 3 * columns;
    direct.insert(direct.end(), row, row + columns);
  }
  return direct;
}

}  // namespace

ShadowedTransfer::ShadowedTransfer(const CompiledScene& scene, const VertexRange& baked, const Bake& bake,
                                   ObjectScene& light)
    : baked_(baked), light_(light) {
  const std::size_t channels = std::size_t{3} * baked.vertexCount;
  if (bake.sh) {
    order_ = bake.sh->order;
    sh_ = firstRows(bake.sh->coefficients, channels * static_cast<std::size_t>(order_ * order_));
    direct_ = directOf(light, *bake.sh, baked.vertexCount);
  }
  if (!bake.lightGroups) return;
  lights_ = firstRows(bake.lightGroups->coefficients, channels * bake.lightGroups->groups.size());
  lamps_ = light.lampsOn(scene, baked, false);
}

void ShadowedTransfer::writeSh(const ObjectShadow& shadow, HarmonicTransfer& sh) const {
  const auto columns = static_cast<std::size_t>(order_ * order_);
  for (std::size_t at = 0; at < sh_.size(); ++at) {
    const std::size_t vertex = at / (3 * columns), band = vertex * columns + at % columns;
    const float direct = direct_.empty() ? 0.0f : direct_[band];
    const float left = direct - shadow.sky[band] + (sh_[at] - direct) * (1.0f - shadow.surfaces[vertex]);
    sh.coefficients[at] = left + (shadow.sent.empty() ? 0.0f : shadow.sent[at]);
  }
}

void ShadowedTransfer::writeLights(const ObjectShadow& shadow, const std::vector<float>& lamps,
                                   LightGroupTransfer& lights) const {
  const std::size_t width = 3 * lights.groups.size();
  for (std::size_t at = 0; at < lights_.size(); ++at) {
    const float indirect = std::max(0.0f, lights_[at] - lamps_[at]);
    const float lost = lamps_[at] - lamps[at] + shadow.hidden[at / width] * indirect;
    lights.coefficients[at] = std::max(0.0f, lights_[at] - lost);
  }
}

void ShadowedTransfer::writeTo(const CompiledScene& scene, std::span<const VertexRange> objects, Bake& bake) {
  const ObjectShadow shadow = light_.shadowOf(scene, baked_, objects, order_);
  if (bake.sh) writeSh(shadow, *bake.sh);
  if (bake.lightGroups) writeLights(shadow, light_.lampsPast(scene, baked_, lamps_), *bake.lightGroups);
}

}  // namespace prelight
