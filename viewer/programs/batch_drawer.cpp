#include "viewer/programs/batch_drawer.h"

#include <algorithm>

#include "viewer/programs/draw_order.h"
#include "viewer/programs/surface_uniforms.h"

namespace prelight::viewer {

void useSurfaceState() {
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glFrontFace(GL_CCW);
  glCullFace(GL_BACK);
}

BatchDrawer::BatchDrawer(const RenderScene& scene, const Encoding* encoding)
    : scene_(scene), programs_(encoding) {
  materialsChanged();
}

void BatchDrawer::materialsChanged() {
  surfaceFeatures_.clear();
  for (const Surface& surface : scene_.surfaces()) surfaceFeatures_.push_back(featuresOf(surface));
  sharedFeatures_ = sharedFeatures(surfaceFeatures_);
}

bool BatchDrawer::anySurfaceHas(Feature feature) const {
  return std::any_of(surfaceFeatures_.begin(), surfaceFeatures_.end(),
                     [&](Features features) { return features.has(feature); });
}

void BatchDrawer::draw(const std::vector<const Batch*>& batches, const BatchLook& look) {
  glBindVertexArray(scene_.vertexArray().name());
  setAttributeDefaults();
  const gl::Program* used = nullptr;
  for (const Batch* batch : batches) {
    ShaderVariant variant = look.variant;
    const std::vector<Features>& features = look.sharesPrograms ? sharedFeatures_ : surfaceFeatures_;
    variant.features = variant.features | (features[batch->surface] & look.ofSurfaces);
    if (batch->reflectingNode < 0) variant.features.remove(Feature::LocalReflections);
    const gl::Program& program = programs_.of(look.shader, variant);
    if (used != &program) {
      program.use();
      program.set("causticCorner", look.causticCorner);
      program.set("layer", look.layer);
      if (variant.showsParts) program.set("partFactors", std::span<const float>(look.factors));
      program.set("knowsThrough", 0);
      for (const SurfaceInput* input : look.inputs) input->bind(program);
      used = &program;
    }
    setSurface(scene_.surfaces()[batch->surface], variant.features, scene_.white(), program);
    if (look.layer > 0) glDisable(GL_CULL_FACE);
    for (const SurfaceInput* input : look.inputs) input->set(program, *batch);
    const auto drawRange = [&](const TriangleRange& range) {
      program.set("firstTriangle", static_cast<int>(range.first));
      drawTriangles(range);
    };
    if (look.shown != nullptr)
      look.shown->forEach(batch->triangles(), drawRange);
    else
      drawRange(batch->triangles());
  }
  glBindVertexArray(0);
}

void BatchDrawer::drawInto(const gl::Framebuffer& target, const std::vector<const Batch*>& batches,
                           const BatchLook& look) {
  target.bind();
  glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  draw(batches, look);
}

void BatchDrawer::drawDepths(const std::vector<const Batch*>& batches, const ShownTriangles& shown) {
  glBindVertexArray(scene_.vertexArray().name());
  programs_.depth().use();
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  for (const Batch* batch : batches) {
    const Surface& surface = scene_.surfaces()[batch->surface];
    if (surface.material.alphaMode == AlphaMode::Mask) continue;
    cullBacksOf(surface);
    shown.forEach(batch->triangles(), drawTriangles);
  }
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glBindVertexArray(0);
}

void BatchDrawer::drawBackground(const ShaderVariant& variant, float factor) {
  glDisable(GL_CULL_FACE);
  ShaderVariant needed;
  for (const Feature feature : {Feature::SkyLight, Feature::SkyMap})
    needed.features.add(feature, variant.features.has(feature));
  if (!needed.features.has(Feature::SkyMap)) return;
  const gl::Program& program = programs_.background(needed);
  program.use();
  program.set("emitted", factor);
  glBindVertexArray(noVertices_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace prelight::viewer
