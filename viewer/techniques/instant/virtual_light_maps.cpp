#include "viewer/techniques/instant/virtual_light_maps.h"

#include <algorithm>

#include "viewer/programs/drawn_transfer.h"

namespace prelight::viewer {
namespace {

constexpr std::size_t leastSpareSlots =
    8;  ///< and an eighth of those in use: paths come to leave more lights

bool shinesThrough(const device::VirtualLight& light) {
  return std::max({light.through[0], light.through[1], light.through[2]}) > 0.0f;
}

glm::vec4 texel(const float (&xyz)[3], float w) { return {xyz[0], xyz[1], xyz[2], w}; }

}  // namespace

VirtualLightMaps::Eye VirtualLightMaps::eyeOf(const device::VirtualLight& light) {
  return {light.position[0],  light.position[1],  light.position[2],
          light.geometric[0], light.geometric[1], light.geometric[2]};
}

/// One that no light uses; makes more where there is none.
std::size_t VirtualLightMaps::takeSlot() {
  const auto unused =
      std::find_if(slots_.begin(), slots_.end(), [](const Slot& slot) { return !slot.isUsed; });
  const auto index = static_cast<std::size_t>(unused - slots_.begin());
  if (unused == slots_.end()) {
    const std::size_t needed = std::max(set_.lights.size(), index + 1);
    slots_.resize(needed + std::max(leastSpareSlots, needed / 8));
  }
  slots_[index].isUsed = true;
  return index;
}

void VirtualLightMaps::set(const VirtualLightSet& set) {
  set_ = set;
  isStale_ = true;
  twoSided_ = twoSided_ || std::any_of(set_.lights.begin(), set_.lights.end(), shinesThrough);
  const std::map<Eye, std::size_t> before = std::move(slotOf_);
  slotOf_.clear();
  for (Slot& slot : slots_) slot.isUsed = false;
  for (const device::VirtualLight& light : set_.lights)
    if (const auto kept = before.find(eyeOf(light)); kept != before.end()) {
      slotOf_.insert(*kept);
      slots_[kept->second].isUsed = true;
    }
  for (const device::VirtualLight& light : set_.lights) {
    const Eye eye = eyeOf(light);
    if (slotOf_.contains(eye)) continue;
    const std::size_t index = takeSlot();
    slotOf_.emplace(eye, index);
    ShadedLight& seen = slots_[index].eye;
    seen.kind = LightKind::Emitter;
    seen.intensity = glm::vec3(1.0f);
    seen.position = glm::vec3(eye[0], eye[1], eye[2]);
    seen.direction = glm::vec3(eye[3], eye[4], eye[5]);
    seen.isSample = true;
    slots_[index].isBehind = false;  // the next update draws it
    slots_[index].drawnAt = updates_ + 1;
  }
  for (Slot& slot : slots_) slot.eye.twoSided = twoSided_;
}

void VirtualLightMaps::sceneMoved() {
  for (Slot& slot : slots_) slot.isBehind = true;
}

bool VirtualLightMaps::isBehind() const {
  return std::any_of(slots_.begin(), slots_.end(),
                     [](const Slot& slot) { return slot.isUsed && slot.isBehind; });
}

void VirtualLightMaps::renewOldest(std::size_t most) {
  std::vector<std::size_t> behind;
  for (std::size_t i = 0; i < slots_.size(); ++i)
    if (slots_[i].isUsed && slots_[i].isBehind) behind.push_back(i);
  std::stable_sort(behind.begin(), behind.end(),
                   [&](std::size_t a, std::size_t b) { return slots_[a].drawnAt < slots_[b].drawnAt; });
  if (behind.size() > most) behind.resize(most);
  for (const std::size_t i : behind) {
    maps_.redraw(i);
    slots_[i].isBehind = false;
    slots_[i].drawnAt = updates_;
  }
}

void VirtualLightMaps::update(const RenderScene& scene, const CompiledScene& compiled, std::size_t renewals) {
  ++updates_;
  const auto fresh = static_cast<std::size_t>(std::count_if(
      slots_.begin(), slots_.end(), [&](const Slot& s) { return s.isUsed && s.drawnAt == updates_; }));
  std::vector<ShadedLight> eyes;
  for (const Slot& slot : slots_) eyes.push_back(slot.eye);
  renewOldest(renewals > fresh ? renewals - fresh : 0);
  maps_.update(scene, compiled, eyes, false, {});
  if (isStale_) upload();
  isStale_ = false;
}

/// Uploads the lights as readVirtualLight() of the shader takes them.
void VirtualLightMaps::upload() {
  const std::vector<ShadowBlock> blocks = maps_.blocks();
  std::vector<glm::vec4> texels;
  for (const device::VirtualLight& light : set_.lights) {
    const ShadowBlock& shadow = blocks[slotOf_.at(eyeOf(light))];
    for (const glm::vec4& row : {shadow.axisX, shadow.axisY, shadow.axisZ, shadow.place})
      texels.push_back(row);
    texels.push_back(texel(light.intensity, light.layerF0));
    texels.push_back(texel(light.normal, light.layerF90));
    texels.push_back(texel(light.through, light.layerLater));
    texels.push_back(texel(light.geometric, light.roughness));
    texels.emplace_back(light.nearby, 0.0f, 0.0f, 0.0f);
  }
  if (texels.empty()) texels.emplace_back(0.0f);
  texels_ = gl::makeBufferTexture(texels, "virtual lights");
}

void VirtualLightMaps::bind(const gl::Program& program) const {
  gl::bind(virtualLightsUnit, GL_TEXTURE_BUFFER, texels_.texture);
  gl::bind(virtualMapsUnit, GL_TEXTURE_2D_ARRAY, maps_.depths());
  gl::bind(virtualViewsUnit, GL_TEXTURE_BUFFER, maps_.views());
  program.set("virtualCount", static_cast<int>(set_.lights.size()));
  program.set("virtualLeastSquare", set_.leastSquare);
}

}  // namespace prelight::viewer
