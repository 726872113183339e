#include "viewer/screen/occlusion_pass.h"

#include <string>
#include <utility>

#include "viewer/disks/disk_occlusion.h"
#include "viewer/fields/field_occlusion.h"
#include "viewer/gl/texture.h"
#include "viewer/uniform_blocks.h"

namespace prelight::viewer {
namespace {

enum OcclusionUnit : GLuint { firstLayerUnit = 0, secondLayerUnit = 1, opennessUnit = 2 };

constexpr std::array<const char*, 5> methodFiles = {
    "screen_ssao.frag", "screen_hbao.frag", "screen_gtao.frag", "screen_disks.frag", "screen_fields.frag"};

void prepare(const gl::Program& program) {
  program.bindBlock("Frame", frameBinding);
  program.use();
  program.set("firstLayer", static_cast<int>(firstLayerUnit));
  program.set("secondLayer", static_cast<int>(secondLayerUnit));
  program.set("openness", static_cast<int>(opennessUnit));
}

gl::Framebuffer withMargin(const OcclusionPicture& picture, int margin) {
  return {picture.width + 2 * margin, picture.height + 2 * margin};
}

}  // namespace

OcclusionPass::Targets::Targets(const OcclusionPicture& picture)
    : layers{withMargin(picture, picture.margin), withMargin(picture, picture.margin)},
      found(withMargin(picture, filterReach)),
      filtered(picture.width, picture.height) {}

OcclusionPass::OcclusionPass() : filterProgram_("fullscreen.vert", "screen_filter.frag") {
  prepare(filterProgram_);
  gl::check("preparing screen-space occlusion");
}

const gl::Framebuffer& OcclusionPass::layer(int index, const OcclusionPicture& picture) {
  const auto fits = [&](const gl::Framebuffer& target, int margin) {
    return target.width() == picture.width + 2 * margin && target.height() == picture.height + 2 * margin;
  };
  if (targets_ == nullptr || !fits(targets_->filtered, 0) || !fits(targets_->layers[0], picture.margin))
    targets_ = std::make_unique<Targets>(picture);
  return targets_->layers[static_cast<std::size_t>(index)];
}

const gl::Program& OcclusionPass::programOf(const Variant& variant) {
  const auto found = programs_.find(variant);
  if (found != programs_.end()) return found->second;
  const std::string text = "const int layers = " + std::to_string(variant.layers) +
                           ";\nconst bool hasThickness = " + (variant.hasThickness ? "true" : "false") +
                           ";\n";
  gl::Program program("fullscreen.vert", methodFiles[static_cast<std::size_t>(variant.method)],
                      {{"screen_variant.glsl", text}});
  prepare(program);
  return programs_.emplace(variant, std::move(program)).first->second;
}

void OcclusionPass::setPicture(const gl::Program& program, const OcclusionPicture& picture,
                               int around) const {
  program.use();
  const gl::Framebuffer& layers = targets_->layers[0];
  program.set("screen", glm::vec4(layers.width(), layers.height(), picture.radius, picture.margin));
  const int corner = picture.margin - around;
  // Patterns repeat every four samples.
  const glm::ivec2 origin = (picture.origin - around) & 3;
  program.set("corner", glm::ivec4(corner, corner, origin.x, origin.y));
}

void OcclusionPass::drawInto(const gl::Framebuffer& target) const {
  target.bind();
  glBindVertexArray(noVertices_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
}

void OcclusionPass::draw(const OcclusionPicture& picture, const ScreenOcclusionOptions& options) {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  gl::bind(firstLayerUnit, GL_TEXTURE_2D, targets_->layers[0].color());
  gl::bind(secondLayerUnit, GL_TEXTURE_2D, targets_->layers[1].color());
  const int layers = layersOf(options);
  const gl::Program& program = programOf({options.method, layers, layers > 1 && options.thickness > 0.0});
  setPicture(program, picture, filterReach);
  program.set("slices", options.slices);
  program.set("steps", options.steps);
  program.set("samples", options.samples);
  program.set("thickness", static_cast<float>(options.thickness));
  DiskOcclusion::setUniforms(program, options, picture.radius, disksUnit);
  FieldOcclusion::setUniforms(program, fieldsUnit);
  drawInto(targets_->found);
  gl::bind(opennessUnit, GL_TEXTURE_2D, targets_->found.color());
  setPicture(filterProgram_, picture, 0);
  filterProgram_.set("reach", filterReach);
  filterProgram_.set("averages", isFiltered(options) ? 1 : 0);
  drawInto(targets_->filtered);
  glEnable(GL_DEPTH_TEST);
  gl::check("drawing screen-space occlusion");
}

}  // namespace prelight::viewer
