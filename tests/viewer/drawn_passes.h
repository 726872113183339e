#pragma once

#include <map>

#include "viewer/frame/renderer.h"

namespace prelight::test {

/// What a renderer drew anew for its last picture, as it tells observers.
class DrawnPasses {
 public:
  /// The renderer keeps referring to it.
  explicit DrawnPasses(viewer::Renderer& renderer) {
    renderer.observePasses([this](const viewer::DrawnPass& drawn) { last_[drawn.pass] = drawn; });
  }
  DrawnPasses(const DrawnPasses&) = delete;
  DrawnPasses& operator=(const DrawnPasses&) = delete;

  std::size_t shadowViews() const { return of(viewer::FramePass::ShadowMaps).count; }
  std::size_t shadowTexels() const { return of(viewer::FramePass::ShadowMaps).texels; }
  std::size_t virtualLightViews() const { return of(viewer::FramePass::VirtualLights).count; }
  std::size_t faces() const { return of(viewer::FramePass::EnvironmentMaps).count; }

 private:
  /// Throws std::out_of_range for a pass that no picture has had.
  const viewer::DrawnPass& of(viewer::FramePass pass) const { return last_.at(pass); }

  std::map<viewer::FramePass, viewer::DrawnPass> last_;
};

}  // namespace prelight::test
