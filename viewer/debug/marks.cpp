#include "viewer/debug/marks.h"

#include <span>
#include <utility>

#include "viewer/core/uniform_blocks.h"
#include "viewer/debug/picture_fill.h"
#include "viewer/gl/buffer.h"
#include "viewer/gl/program.h"

namespace prelight::viewer {
namespace {

constexpr float dimmed = 0.35f;        ///< factor of the picture below marks
constexpr float behindOpacity = 0.3f;  ///< of marks that are hidden by surfaces
constexpr float liftedShare = 2e-3f;   ///< of the distance to the eye
constexpr float nearestShare = 1e-4f;  ///< of the scene's radius

void attachVector(GLuint location, std::size_t stride, std::size_t offset, GLuint divisor) {
  glEnableVertexAttribArray(location);
  glVertexAttribPointer(location, 3, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride),
                        reinterpret_cast<const void*>(offset));
  glVertexAttribDivisor(location, divisor);
}

class MarkDrawing final : public DebugDrawing {
 public:
  MarkDrawing(Marks marks, const CompiledScene& scene);

  void draw(const DebugTile& tile) override;
  std::string legend() const override { return marks_.legend; }

 private:
  void drawAll(const DebugTile& tile, float opacity) const;

  Marks marks_;
  float radius_;  ///< of the scene, m
  PictureFill fill_;
  gl::Program pointProgram_, lineProgram_;
  gl::Buffer points_, lines_;
  gl::VertexArray pointArray_, lineArray_;
};

MarkDrawing::MarkDrawing(Marks marks, const CompiledScene& scene)
    : marks_(std::move(marks)),
      radius_(0.5f * glm::length(scene.boundsMax - scene.boundsMin)),
      fill_("debug_fill.frag"),
      pointProgram_("debug_points.vert", "debug_marks.frag"),
      lineProgram_("debug_lines.vert", "debug_marks.frag") {
  pointProgram_.bindBlock("Frame", frameBinding);
  lineProgram_.bindBlock("Frame", frameBinding);
  glBindVertexArray(pointArray_.name());
  points_.fill(GL_ARRAY_BUFFER, std::span<const Mark>(marks_.points), GL_STATIC_DRAW);
  attachVector(0, sizeof(Mark), offsetof(Mark, position), 0);
  attachVector(1, sizeof(Mark), offsetof(Mark, color), 0);
  glBindVertexArray(lineArray_.name());
  lines_.fill(GL_ARRAY_BUFFER, std::span<const Mark>(marks_.lines), GL_STATIC_DRAW);
  for (GLuint end = 0; end < 2; ++end) {
    attachVector(2 * end, 2 * sizeof(Mark), end * sizeof(Mark) + offsetof(Mark, position), 1);
    attachVector(2 * end + 1, 2 * sizeof(Mark), end * sizeof(Mark) + offsetof(Mark, color), 1);
  }
  glBindVertexArray(0);
}

void MarkDrawing::drawAll(const DebugTile& tile, float opacity) const {
  const auto samples = static_cast<float>(tile.samples());
  const glm::vec2 shown(1.0 / tile.view.debug.exposure, opacity), lift(liftedShare, liftedShare * radius_);
  pointProgram_.use();
  pointProgram_.set("shown", shown);
  pointProgram_.set("lift", lift);
  pointProgram_.set("pointSize", samples * marks_.pointSize);
  glBindVertexArray(pointArray_.name());
  glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(marks_.points.size()));
  lineProgram_.use();
  lineProgram_.set("shown", shown);
  lineProgram_.set("lift", lift);
  lineProgram_.set("halfWidth", 0.5f * samples * marks_.lineWidth);
  lineProgram_.set("halfViewport", 0.5f * glm::vec2(tile.target.width(), tile.target.height()));
  lineProgram_.set("nearest", nearestShare * radius_);
  glBindVertexArray(lineArray_.name());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(marks_.lines.size() / 2));
  glBindVertexArray(0);
}

void MarkDrawing::draw(const DebugTile& tile) {
  fill_.use().set("color", glm::vec4(0.0f, 0.0f, 0.0f, dimmed));
  fill_.draw(GL_ZERO, GL_SRC_ALPHA);
  glDisable(GL_CULL_FACE);
  glDepthMask(GL_FALSE);
  glEnable(GL_PROGRAM_POINT_SIZE);
  glEnable(GL_DEPTH_CLAMP);  // lifted marks may come before the nearest depth
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  if (marks_.shineThrough) {
    glDepthFunc(GL_GREATER);
    drawAll(tile, behindOpacity);
  }
  glDepthFunc(GL_LEQUAL);
  drawAll(tile, 1.0f);
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_CLAMP);
  glDisable(GL_PROGRAM_POINT_SIZE);
  glDepthMask(GL_TRUE);
}

}  // namespace

void Marks::addBox(const glm::vec3& lower, const glm::vec3& upper, const glm::vec3& color) {
  const auto corner = [&](int bits) {
    return glm::vec3((bits & 1) != 0 ? upper.x : lower.x, (bits & 2) != 0 ? upper.y : lower.y,
                     (bits & 4) != 0 ? upper.z : lower.z);
  };
  for (int axis = 1; axis < 8; axis *= 2)
    for (int bits = 0; bits < 8; ++bits)
      if ((bits & axis) == 0) addLine(corner(bits), corner(bits | axis), color);
}

std::unique_ptr<DebugDrawing> drawMarks(Marks marks, const CompiledScene& scene) {
  return std::make_unique<MarkDrawing>(std::move(marks), scene);
}

}  // namespace prelight::viewer
