#include "viewer/lights/drawn_sky.h"

#include <algorithm>
#include <span>
#include <utility>

#include "viewer/lights/lobe_map.h"

namespace prelight::viewer {
namespace {

gl::Texture constantSky(float radiance) {
  const glm::vec3 texel(radiance);
  return gl::makeFloatTexture(1, 1, std::span(&texel, 1));
}

}  // namespace

std::vector<int> skyOrdersOf(const Bake* bake) {
  std::vector<int> orders = {ambientOrder};
  if (bake == nullptr) return orders;
  if (bake->sh) orders.push_back(bake->sh->order);
  if (bake->compressedSh) orders.push_back(bake->compressedSh->order);
  if (bake->chartTransfer) orders.push_back(bake->chartTransfer->order);
  if (bake->ch) orders.push_back(bake->ch->order);
  if (bake->glossy) orders.push_back(bake->glossy->order);
  return orders;
}

DrawnSky::DrawnSky(const RenderInputs& inputs, bool emits)
    : environment_(inputs.environment),
      emits_(emits),
      order_(std::ranges::max(skyOrdersOf(inputs.bake))),
      neutralMap_(constantEnvironment(glm::vec3(1.0f))),
      neutral_(neutralMap_, 1),
      neutralTexture_(constantSky(1.0f)),
      blackTexture_(constantSky(0.0f)) {
  if (environment_ == nullptr) return;
  coefficients_ = SkyCoefficients(*environment_, order_);
  texture_ = gl::makeFloatTexture(environment_->width, environment_->height, environment_->radiance);
}

bool DrawnSky::isNeutral(const View& view) const {
  return environment_ == nullptr && view.lights.empty() && !emits_ && !showsBakedLight(view.shading);
}

void DrawnSky::takeLampsOut() {
  if (triedLamps_ || environment_ == nullptr) return;
  triedLamps_ = true;
  LampsAndSky parts = prelight::takeLampsOut(*environment_);
  lamps_ = std::move(parts.lamps);
  if (!lamps_.empty()) withoutLamps_ = SkyCoefficients(parts.rest, order_);
}

void DrawnSky::makeLobes() {
  if (lobes_ || !isMap()) return;
  lobes_ = gl::makeFloatLevels(LobeMap::width, LobeMap::width, makeLobeMap(*environment_).levels);
}

SeenSky DrawnSky::seenBy(const View& view) const {
  if (!lamps_.empty() && infoOf(view.shading).traits.skyLampsApart)
    return {environment_, &withoutLamps_, &texture_, environment_->width, lamps_};
  if (environment_ != nullptr) return {environment_, &coefficients_, &texture_, environment_->width};
  if (isNeutral(view)) return {&neutralMap_, &neutral_, &neutralTexture_, 1};
  return {nullptr, &black_, &blackTexture_, 1};
}

}  // namespace prelight::viewer
