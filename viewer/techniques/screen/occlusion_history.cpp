#include "viewer/techniques/screen/occlusion_history.h"

#include <string>

#include "viewer/techniques/screen/occlusion_target.h"

namespace prelight::viewer {
namespace {

constexpr int mostTurns = 1 << 20;  ///< then they begin anew

bool sameCamera(const FrameBlock& a, const FrameBlock& b) {
  return a.clipFromScene == b.clipFromScene && a.eye == b.eye;
}

}  // namespace

const gl::Program& OcclusionHistory::programOf(int outputs) {
  const auto found = programs_.find(outputs);
  if (found != programs_.end()) return found->second;
  gl::Program program("fullscreen.vert", "screen_history.frag",
                      {{"screen_variant.glsl", "const int outputs = " + std::to_string(outputs) + ";\n"}});
  program.bindBlock("Frame", frameBinding);
  program.use();
  program.set("firstLayer", static_cast<int>(firstLayerUnit));
  setSamplers(program, "now", outputs, foundUnit);
  setSamplers(program, "past", outputs, pastUnit);
  program.set("pastSurface", static_cast<int>(pastUnit) + outputs);
  return programs_.emplace(outputs, std::move(program)).first->second;
}

void OcclusionHistory::setPast(const gl::Program& program) const {
  program.set("pastClipFromScene", frame_.clipFromScene);
  program.set("pastEye", frame_.eye);
  program.set("pastForward", frame_.forward);
  program.set("pastRight", frame_.pixelRight);
  program.set("pastUp", frame_.pixelUp);
  program.set("pastScreen", screen_);
}

const gl::Framebuffer& OcclusionHistory::join(const gl::Framebuffer& found, const gl::Framebuffer& layer,
                                              const OcclusionPicture& picture, const Joining& joining) {
  const int outputs = found.colors();
  const auto fits = [&](const std::optional<gl::Framebuffer>& past) {
    return past && past->width() == found.width() && past->height() == found.height() &&
           past->colors() == outputs + 1;
  };
  if (!fits(joined_[static_cast<std::size_t>(last_)])) drop();
  const int next = 1 - last_;
  const gl::Framebuffer& target =
      fitted(joined_[static_cast<std::size_t>(next)], found.width(), found.height(), outputs + 1);
  const glm::vec4 screen(layer.width(), layer.height(), picture.margin, picture.radius);
  still_ = pictures_ > 0 && !joining.moves && sameCamera(joining.frame, frame_) ? still_ + 1 : 1;

  const gl::Program& program = programOf(outputs);
  program.use();
  program.set("screen", glm::vec4(layer.width(), layer.height(), picture.radius, picture.margin));
  program.set("corner", glm::ivec4(picture.margin, picture.margin, 0, 0));
  program.set("stride", 1);
  // Without a past one picture counts, whatever lies in its target.
  program.set("most", pictures_ > 0 ? joining.most : 1);
  program.set("moves", joining.moves ? 1 : 0);
  setPast(program);
  bindColors(found, outputs, foundUnit);
  const auto& past = joined_[static_cast<std::size_t>(last_)];
  bindColors(pictures_ > 0 ? *past : found, pictures_ > 0 ? outputs + 1 : outputs, pastUnit);
  drawOver(target, noVertices_);
  gl::check("joining screen-space occlusion");

  last_ = next;
  pictures_ = pictures_ + 1 < mostTurns ? pictures_ + 1 : 1;
  frame_ = joining.frame;
  screen_ = screen;
  return target;
}

}  // namespace prelight::viewer
