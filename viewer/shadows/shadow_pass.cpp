#include "viewer/shadows/shadow_pass.h"

#include "viewer/gl/texture.h"
#include "viewer/programs/surface_uniforms.h"
#include "viewer/programs/texture_units.h"

namespace prelight::viewer {
namespace {

/// The alpha below which triangles of a surface have holes; < 0: nowhere. Of blended ones shadow_holes.glsl
/// has thresholds.
float cutoffOf(const Material& material) {
  if (material.alphaMode == AlphaMode::Opaque) return -1.0f;
  return material.alphaMode == AlphaMode::Mask ? material.alphaCutoff : 0.0f;
}

bool hasHoles(const Surface& surface) {
  return surface.material.alphaMode != AlphaMode::Opaque || surface.passes > 0.0f;
}

bool hasClipControl() { return epoxy_gl_version() >= 45 || epoxy_has_gl_extension("GL_ARB_clip_control"); }

/// Returns the clip matrix of shadow.vert, whose row of depths is 0: no triangle is left out by its depth.
glm::mat4 clipOf(const ShadowEye& eye) {
  const bool perspective = eye.near > 0.0f;
  const auto row = [&](const glm::vec3& axis, float w) {
    return glm::vec4(axis, w - glm::dot(axis, eye.position));
  };
  return glm::transpose(glm::mat4(row(eye.scale * eye.axes[0], 0.0f), row(eye.scale * eye.axes[1], 0.0f),
                                  glm::vec4(0.0f),
                                  perspective ? row(eye.axes[2], 0.0f) : glm::vec4(0.0f, 0.0f, 0.0f, 1.0f)));
}

void setEye(const gl::Program& program, const ShadowEye& eye) {
  program.use();
  program.set("axisX", glm::vec4(eye.axes[0], eye.scale));
  program.set("axisY", glm::vec4(eye.axes[1], eye.near));
  program.set("axisZ", glm::vec4(eye.axes[2], eye.depthScale));
  program.set("lightPosition", eye.position);
}

void setHoles(const gl::Program& program, const RenderScene& scene, const Surface& surface) {
  const float cutoff = cutoffOf(surface.material);
  const float blended = surface.material.alphaMode == AlphaMode::Blend ? 1.0f : 0.0f;
  program.set("alpha", glm::vec4(surface.material.baseColor.a, cutoff, blended, 0.0f));
  program.set("passes", surface.passes);
  program.set("baseColorTexture", static_cast<int>(baseColorUnit));
  if (cutoff < 0.0f) return;
  const SurfaceTexture& color = surface.at(TextureSlot::BaseColor);
  gl::bind(baseColorUnit, GL_TEXTURE_2D, color.texture != nullptr ? *color.texture : scene.white());
  program.set("baseColorU", textureRow(color.use, 0));
  program.set("baseColorV", textureRow(color.use, 1));
}

}  // namespace

ShadowPass::ShadowPass() : program_("shadow.vert", "shadow.frag") {
  if (hasClipControl()) clip_ = std::make_unique<ClipPrograms>();
}

void ShadowPass::draw(const RenderScene& scene, const ShadowEye& eye, bool quick) const {
  const ShownTriangles shown(scene.blocks(), clipOf(eye));
  if (!quick || clip_ == nullptr) {
    setEye(program_, eye);
    scene.drawOccluders(shown, [&](const Surface& surface) { setHoles(program_, scene, surface); });
    return;
  }
  setEye(clip_->holes, eye);
  setEye(clip_->whole, eye);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  scene.drawOccluders(shown, [&](const Surface& surface) {
    const bool holes = hasHoles(surface);
    (holes ? clip_->holes : clip_->whole).use();
    if (holes) setHoles(clip_->holes, scene, surface);
  });
  glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
}

}  // namespace prelight::viewer
