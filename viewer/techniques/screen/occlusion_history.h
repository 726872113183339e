#pragma once

#include <array>
#include <map>
#include <optional>

#include "viewer/core/uniform_blocks.h"
#include "viewer/gl/framebuffer.h"
#include "viewer/gl/program.h"
#include "viewer/techniques/screen/occlusion_pass.h"

namespace prelight::viewer {

/// Joins the occlusion of pictures one after the other: the mean of what each place of a surface
/// had in them, wherever the camera has gone meanwhile.
class OcclusionHistory {
 public:
  /// Forgets all pictures.
  void drop() {
    pictures_ = 0;
    still_ = 0;
  }

  /// Number of the next picture, for OcclusionPass::draw().
  int turn() const { return pictures_; }

  /// How the next picture is joined with those before.
  struct Joining {
    const FrameBlock& frame;  ///< in use: of the picture with its margin
    int most = 1;             ///< pictures whose mean is taken
    bool moves = false;       ///< the scene is not where it was
  };

  /// Joins what was found of a picture, whose first layer is bound where OcclusionPass has it, and returns
  /// the outcome, as OcclusionPass::draw() does. A picture of another size or with other outputs than the
  /// last is the first.
  const gl::Framebuffer& join(const gl::Framebuffer& found, const gl::Framebuffer& layer,
                              const OcclusionPicture& picture, const Joining& joining);

  /// Pictures since the last that the camera or the scene moved for, or the first.
  int stillPictures() const { return still_; }

 private:
  const gl::Program& programOf(int outputs);
  void setPast(const gl::Program& program) const;

  std::map<int, gl::Program> programs_;  ///< [outputs]
  gl::VertexArray noVertices_;
  std::array<std::optional<gl::Framebuffer>, 2> joined_;  ///< the last picture's, and that before
  int last_ = 0;                                          ///< which of them is the last
  int pictures_ = 0;
  int still_ = 0;
  FrameBlock frame_{};      ///< of the last
  glm::vec4 screen_{0.0f};  ///< as pastScreen in screen_history.frag
};

}  // namespace prelight::viewer
