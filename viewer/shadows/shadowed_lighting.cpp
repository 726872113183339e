#include "viewer/shadows/shadowed_lighting.h"

#include <string>

namespace prelight::viewer {
void ShadowedLighting::prepare(const PictureState& picture) {
  const std::size_t most = picture.pace.spread ? ShadowMaps::sampleViewsAPicture : ShadowMaps::everything;
  shadows_.update(scene_, compiled_, picture.light.lights, moved_, {most, picture.view.draft});
  moved_ = false;
  picture.passed({FramePass::ShadowMaps, shadows_.viewsDrawn(), shadows_.texelsDrawn()});
}

void ShadowedLighting::addPlan(const Illumination& light, std::vector<PlannedPass>& plan) const {
  const std::size_t views = shadows_.viewCount();
  plan.push_back({Pass::ShadowMaps, views > 0,
                  views > 0 ? std::to_string(light.lights.size()) + " lights and samples of large ones see " +
                                  std::to_string(views) + " views"
                            : "nothing gives light"});
}

}  // namespace prelight::viewer
