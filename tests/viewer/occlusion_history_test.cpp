// Occlusion that is the mean of several pictures: what stands still, a camera that moves, an object that
// moves.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "viewer/corner_scene.h"
#include "viewer/gl/egl_context.h"
#include "viewer/view.h"

namespace prelight {
namespace {

using namespace test;
using viewer::OcclusionMethod;
using viewer::ScreenOcclusionOptions;

/// One slice a pixel, of so many pictures.
ScreenOcclusionOptions coarse(int frames, OcclusionMethod method = OcclusionMethod::Gtao) {
  ScreenOcclusionOptions options = within(0.5, method);
  options.slices = 1;
  options.steps = 6;
  options.frames = frames;
  return options;
}

ScreenOcclusionOptions fine(OcclusionMethod method = OcclusionMethod::Gtao) {
  ScreenOcclusionOptions options = within(0.5, method);
  options.slices = options.steps = 32;
  return options;
}

double rms(const Picture& a, const Picture& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    sum += std::pow(double{a.pixels[i].r} - b.pixels[i].r, 2.0);
  return std::sqrt(sum / static_cast<double>(a.pixels.size()));
}

TEST(OcclusionHistory, StillPicture_NearsThatOfManySlices) {
  const QuadScene card = cardOverFloor();
  for (const OcclusionMethod method : {OcclusionMethod::Gtao, OcclusionMethod::Ssdo}) {
    const Picture many = card.render(screenOptions(64, fine(method)));
    double last = 1.0;
    for (const int frames : {1, 4, 16, 64}) {
      const double error = rms(card.render(screenOptions(64, coarse(frames, method))), many);
      EXPECT_LT(error, 0.75 * last) << frames;
      last = error;
    }
  }
}

/// A renderer that keeps what it found.
struct Window {
  explicit Window(const viewer::RenderInputs& inputs) : renderer(inputs) { renderer.reuseOcclusion(true); }
  Picture draw(const viewer::View& view) { return viewer::renderView(renderer, view, 1); }

  viewer::gl::EglContext context;
  viewer::Renderer renderer;
};

TEST(OcclusionHistory, PicturesOneAfterTheOther_AreOneOfAllOfThem) {
  const QuadScene card = cardOverFloor();
  const viewer::RenderOptions options = screenOptions(64, coarse(8));
  const Picture whole = card.render(options);
  Window window(card.inputs());
  const viewer::View view = viewer::makeView(card.inputs(), options);
  Picture last;
  for (int i = 0; i < 8; ++i) {
    last = window.draw(view);
    EXPECT_EQ(window.renderer.isBehind(), i < 7) << i;
  }
  for (std::size_t i = 0; i < whole.pixels.size(); ++i)
    EXPECT_NEAR(last.pixels[i].r, whole.pixels[i].r, 1e-4f);
}

TEST(OcclusionHistory, CameraThatMoves_KeepsWhatItHasSeen) {
  QuadScene card = cardOverFloor();
  const ScreenOcclusionOptions options = coarse(16);
  Window window(card.inputs());
  Picture last;
  for (int i = 0; i < 16; ++i) {
    card.scene.cameras.clear();
    card.lookFrom({0.2 + 0.011 * i, -2.0, 2.0}, {0.005 * i, 0, 0});
    last = window.draw(viewer::makeView(card.inputs(), screenOptions(64, options)));
  }
  const Picture many = card.render(screenOptions(64, fine()));
  const Picture single = card.render(screenOptions(64, coarse(1)));
  EXPECT_LT(rms(last, many), 0.7 * rms(single, many));
}

TEST(OcclusionHistory, ObjectThatMoves_LeavesNoGhost) {
  QuadScene card = cardOverFloor();
  const viewer::View view = viewer::makeView(card.inputs(), screenOptions(96, coarse(16)));
  Window window(card.inputs());
  for (int i = 0; i < 16; ++i) window.draw(view);
  for (std::size_t v = 4; v < 8; ++v) card.compiled.positions[v].x += 0.35f;
  window.renderer.sceneMoved();
  const Picture kept = window.draw(view);
  viewer::RenderOptions options = screenOptions(96, fine());
  const Picture many = card.render(options);
  options.screenOcclusion = coarse(1);
  const Picture single = card.render(options);
  double worst = 0.0;
  for (std::size_t i = 0; i < many.pixels.size(); ++i)
    worst = std::max(worst, std::abs(double{kept.pixels[i].r} - many.pixels[i].r));
  EXPECT_LT(worst, 0.15);
  EXPECT_LT(rms(kept, many), 1.2 * rms(single, many));
}

TEST(OcclusionHistory, LightThatChanges_IsNotMixedWithThatBefore) {
  const QuadScene card = cardOverFloor();
  viewer::View view = viewer::makeView(card.inputs(), screenOptions(32, coarse(8, OcclusionMethod::Ssdo)));
  view.screenOcclusion.bounces = 0;
  view.lights = {makeLight(LightType::Directional, glm::vec3(3), {}, {0, 0, -1})};
  Window window(card.inputs());
  for (int i = 0; i < 8; ++i) window.draw(view);
  view.lights = {makeLight(LightType::Directional, glm::vec3(3), {}, {0.7, 0, -1})};
  const Picture kept = window.draw(view);
  Window fresh(card.inputs());
  const Picture anew = fresh.draw(view);
  for (std::size_t i = 0; i < anew.pixels.size(); ++i) EXPECT_NEAR(kept.pixels[i].r, anew.pixels[i].r, 1e-4f);
}

}  // namespace
}  // namespace prelight
