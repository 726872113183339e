#include "viewer/techniques/screen/disks/disk_occlusion.h"

#include <algorithm>

#include "viewer/gl/framebuffer.h"

namespace prelight::viewer {
namespace {

constexpr double elementShare = 0.25;  ///< of the radius, where no size of elements is asked for
constexpr int rowLength = 1024;        ///< nodes in a row of the picture of their accessibility

}  // namespace

DiskOcclusion::DiskOcclusion(const CompiledScene& scene)
    : scene_(scene), program_("fullscreen.vert", "disk_accessibility.frag") {}

void DiskOcclusion::upload() {
  std::vector<glm::vec4> texels = tree_->texels();
  if (texels.empty()) texels.resize(DiskTree::texelsOfNode, glm::vec4(0.0f));  // nothing that occludes
  texels_ = gl::makeBufferTexture(texels, "elements that occlude");
}

void DiskOcclusion::setUniforms(const gl::Program& program, const ScreenOcclusionOptions& options,
                                double radius, GLuint unit) {
  program.set("disks", static_cast<int>(unit));
  program.set("opening", static_cast<float>(options.opening));
  program.set("reach", static_cast<float>(radius));
}

/// Weighs elements: those with something behind them occlude less, so that only one of several in a row
/// counts.
void DiskOcclusion::weigh(const ScreenOcclusionOptions& options, double radius, GLuint unit) {
  const int count = static_cast<int>(tree_->nodeCount());
  if (count == 0) return;
  const gl::Framebuffer target(std::min(count, rowLength), (count + rowLength - 1) / rowLength);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  for (int pass = 1; pass < options.passes; ++pass) {
    gl::bind(unit, GL_TEXTURE_BUFFER, texels_.texture);
    program_.use();
    setUniforms(program_, options, radius, unit);
    program_.set("rowLength", target.width());
    target.bind();
    glBindVertexArray(noVertices_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
    std::vector<float> open;
    for (const glm::vec4& pixel : target.read()) open.push_back(pixel.x);
    tree_->setAccessibility(std::span(open).first(tree_->nodeCount()));
    upload();
  }
}

void DiskOcclusion::prepare(const ScreenOcclusionOptions& options, double radius, GLuint unit) {
  const double size = options.elementSize > 0.0 ? options.elementSize : elementShare * radius;
  Ready wanted{size, 0.0, 0.0, options.passes};
  if (options.passes > 1) wanted.radius = radius, wanted.opening = options.opening;
  if (tree_ == nullptr || wanted != ready_ || moved_) {
    if (tree_ == nullptr || size != ready_.size || triangles_ != scene_.triangles) {
      tree_ = std::make_unique<DiskTree>(scene_, size);
      triangles_ = scene_.triangles;
    } else {
      tree_->refit(scene_);
    }
    upload();
    weigh(options, radius, unit);
    ready_ = wanted;
    moved_ = false;
    gl::check("occlusion by disks");
  }
  gl::bind(unit, GL_TEXTURE_BUFFER, texels_.texture);
}

}  // namespace prelight::viewer
