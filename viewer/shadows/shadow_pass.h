#pragma once

#include <glm/glm.hpp>
#include <memory>

#include "viewer/gl/program.h"
#include "viewer/scene/render_scene.h"

namespace prelight::viewer {

/// Where a light looks from and how; rows of `axes` are x, y and z of its picture in scene coordinates.
struct ShadowEye {
  glm::mat3 axes{1.0f};
  glm::vec3 position{0.0f};
  float scale = 1.0f;       ///< half sides a tangent (perspective) or a metre
  float near = 0.0f;        ///< m; 0: orthographic
  float depthScale = 0.0f;  ///< orthographic: depths a metre

  bool operator==(const ShadowEye&) const = default;
};

/// Draws the depths of shadows/shadows.glsl of what stands in a light's way.
class ShadowPass {
 public:
  ShadowPass();

  /// Into the viewport of the framebuffer in use, whose depth test passes what is greater. `quick`: depths
  /// come from clip space where OpenGL lets it go from 0 to 1 (4.5 or ARB_clip_control), which takes no
  /// fragment shader where surfaces have no holes; they differ by rounding.
  void draw(const RenderScene& scene, const ShadowEye& eye, bool quick) const;

 private:
  /// With depths of clip space.
  struct ClipPrograms {
    gl::Program whole{"shadow_clip.vert", "depth.frag"};
    gl::Program holes{"shadow_clip.vert", "shadow_clip.frag"};
  };

  gl::Program program_;
  std::unique_ptr<ClipPrograms> clip_;  ///< nullptr: OpenGL lacks them
};

}  // namespace prelight::viewer
