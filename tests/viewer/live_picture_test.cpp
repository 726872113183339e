// The picture of a window: drafts, and slices of the still picture.
#include "viewer/window/live_picture.h"

#include <gtest/gtest.h>

#include <vector>

#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"
#include "viewer/picture_checks.h"
#include "viewer/window_scene.h"

namespace prelight::viewer {
namespace {

using namespace test;

Picture pictureOf(const gl::Framebuffer& shown) {
  Picture picture{shown.width(), shown.height(),
                  std::vector<glm::vec3>(static_cast<std::size_t>(shown.width()) * shown.height())};
  resolve(shown, 1, {0, 0, shown.width(), shown.height()}, picture);
  return picture;
}

/// Draws a still view of a shading slice by slice, and in one piece by another renderer.
void expectSameAsInOnePiece(Shading shading, int samples, const ScreenOcclusionOptions& occlusion = {}) {
  const gl::EglContext context;
  const QuadScene quad = windowScene();
  const RenderInputs inputs = quad.inputs();
  Renderer renderer(inputs), other(inputs);
  View view = makeView(inputs, windowOptions());
  view.width = 120;
  view.height = 90;
  view.shading = shading;
  view.screenOcclusion = occlusion;
  LivePicture picture(renderer, samples);
  picture.update(view, 1, false);
  EXPECT_FALSE(picture.isFinal(1));
  picture.finish(view, 1);
  EXPECT_TRUE(picture.isFinal(1));
  EXPECT_FALSE(picture.isFinal(2));
  const Picture expected = renderView(other, view, samples);
  EXPECT_EQ(largestDifference(pictureOf(picture.shown()), expected), 0.0) << shadingName(shading);
}

TEST(LivePicture, OfAViewThatRests_IsTheOneDrawnInOnePiece) {
  for (const Shading shading : {Shading::Phong, Shading::Ao, Shading::Sh, Shading::Screen})
    expectSameAsInOnePiece(shading, 2);
  expectSameAsInOnePiece(Shading::Phong, 1);
}

TEST(LivePicture, OfEveryWayToFindOcclusion_IsTheOneDrawnInOnePiece) {
  for (const OcclusionMethod method :
       {OcclusionMethod::Ssao, OcclusionMethod::Hbao, OcclusionMethod::Ssdo, OcclusionMethod::Disks})
    expectSameAsInOnePiece(Shading::Screen, 2, {.method = method});
  expectSameAsInOnePiece(Shading::Screen, 2, {.method = OcclusionMethod::Gtao, .stride = 2});
}

TEST(LivePicture, WhileTheViewMoves_IsADraft_AndSlicesBeginWhenItRests) {
  const gl::EglContext context;
  const QuadScene quad = windowScene();
  const RenderInputs inputs = quad.inputs();
  Renderer renderer(inputs);
  View view = makeView(inputs, windowOptions());
  view.shading = Shading::Screen;
  LivePicture picture(renderer, 2);
  picture.update(view, 1, false);
  EXPECT_TRUE(picture.isDraft());
  EXPECT_EQ(picture.shown().width(), view.width);
  const Picture draft = pictureOf(picture.shown());
  EXPECT_GT(largest(draft), 0.1);
  picture.update(view, 1, true);
  EXPECT_TRUE(picture.isDraft());
  view.skyRotation = 0.5;
  picture.update(view, 2, true);  // a change abandons the slices
  EXPECT_TRUE(picture.isDraft());
  picture.finish(view, 2);
  Renderer other(inputs);
  EXPECT_EQ(largestDifference(pictureOf(picture.shown()), renderView(other, view, 2)), 0.0);
}

TEST(LivePicture, RefinedAgain_IsDrawnAgain) {
  const gl::EglContext context;
  const QuadScene quad = windowScene();
  const RenderInputs inputs = quad.inputs();
  Renderer renderer(inputs);
  const View view = makeView(inputs, windowOptions());
  LivePicture picture(renderer, 2);
  picture.finish(view, 1);
  const Picture first = pictureOf(picture.shown());
  picture.refineAgain();
  EXPECT_FALSE(picture.isFinal(1));
  picture.finish(view, 1);
  EXPECT_EQ(largestDifference(pictureOf(picture.shown()), first), 0.0);
}

}  // namespace
}  // namespace prelight::viewer
